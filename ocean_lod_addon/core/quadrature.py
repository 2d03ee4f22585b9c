# SPDX-License-Identifier: GPL-3.0-or-later
"""Integrals over frequency bins, accurate enough to serve as exact ones."""

from dataclasses import dataclass

import numpy as np

LARGEST_PANEL = 0.05
"""A panel spans at most this much of ln omega: JONSWAP's sharpest peak (7 % wide, gamma 20) then converges to
rounding. Twice as much leaves 3e-10."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, eq=False)
class BinNodes:
    """Points at which to sample functions of omega so as to integrate them over consecutive bins.

    omega    (panels, 8) angular frequencies, rad/s
    weight   (panels, 8) what to multiply samples by
    first    (bins,) the index of each bin's first panel
    """

    omega: np.ndarray
    weight: np.ndarray
    first: np.ndarray

    def integrate(self, samples: np.ndarray) -> np.ndarray:
        """Integrals over the bins, shape (bins,), of a function sampled at `omega`.

        Each depends on its own bin's samples alone, down to the last bit.
        """
        return np.add.reduceat((samples * self.weight).sum(axis=1), self.first)


def bin_nodes(edges, kink: float) -> BinNodes:
    """Gauss-Legendre panels in ln omega for the bins between the increasing positive `edges`.

    No panel reaches across `kink`, a frequency where the integrand is not smooth (JONSWAP's peak).
    """
    edges = np.asarray(edges, dtype=np.float64)
    inner = np.clip(kink, edges[:-1], edges[1:])
    pieces = np.stack([edges[:-1], inner, edges[1:]], axis=1)
    low, high = pieces[:, :-1].ravel(), pieces[:, 1:].ravel()
    width = np.log(high / low)
    panels = np.ceil(width / LARGEST_PANEL).astype(np.int64)
    piece = np.repeat(np.arange(len(panels)), panels)
    start = np.cumsum(panels) - panels
    position = np.arange(len(piece)) - start[piece]
    half = 0.5 * width[piece] / panels[piece]
    middle = np.log(low[piece]) + (2.0 * position + 1.0) * half
    omega = np.exp(middle[:, None] + half[:, None] * _NODES)
    return BinNodes(omega, omega * half[:, None] * _WEIGHTS, start[::2])
