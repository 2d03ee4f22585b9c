# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals of the displaced surface from its five derivatives (the corrected Eqs. 3 to 5, THEORY section 2)."""

import numpy as np

from .contraction import in_threads, shares
from .gerstner import UPWARD


def surface_normals(tangents: np.ndarray, out: np.ndarray) -> None:
    """Write unit normals into `out`, (vertices, 3) float32, from column_blocks.TANGENTS, (vertices, 5) float32."""
    in_threads(lambda share: _normals(tangents[share], out[share]), shares(len(tangents)))


def _normals(tangents, out):
    """N = B x T with B = (Jxx, Jxy, Zx) and T = (Jxy, Jyy, Zy); its third component is the Jacobian J.

    In place, on arrays that lie side by side: three times as fast as the plain expressions.
    """
    Jxx, Jxy, Jyy, Zx, Zy = np.array(tangents.T, order="C")
    product = np.empty_like(Jxx)
    x = Jxy * Zy
    x -= np.multiply(Jyy, Zx, out=product)
    y = Jxy * Zx
    y -= np.multiply(Jxx, Zy, out=product)
    z = Jxx * Jyy
    z -= np.multiply(Jxy, Jxy, out=product)
    length = x * x
    length += np.multiply(y, y, out=product)
    length += np.multiply(z, z, out=product)
    np.sqrt(length, out=length)
    cusps = length == 0.0
    scale = out_of_water(z) / at_cusp_one(length)
    for component, column in zip((x, y, z), out.T, strict=True):
        np.multiply(component, scale, out=column)
    out[cusps] = UPWARD


def out_of_water(jacobian):
    """-1 where the surface is folded over (J < 0), so that N = B x T points into the water; else 1."""
    return np.where(jacobian < 0.0, np.float32(-1.0), np.float32(1.0))


def at_cusp_one(length):
    """The length of N, or 1 at a cusp, where it is 0 and N / |N| would be no number."""
    return np.where(length == 0.0, np.float32(1.0), length)
