# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals of the displaced surface from its five derivatives (the corrected Eqs. 3 to 5, THEORY section 2)."""

import numpy as np

from .contraction import in_threads
from .gerstner import UPWARD

_CHUNK = 1 << 16
"""Vertices at a time, a few milliseconds of work: the intermediate arrays stay in the processor's cache."""


def surface_normals(tangents: np.ndarray, out: np.ndarray) -> None:
    """Write unit normals into `out`, (vertices, 3) float32, from column_blocks.TANGENTS, (vertices, 5) float32."""
    chunks = [slice(start, start + _CHUNK) for start in range(0, len(tangents), _CHUNK)]
    in_threads(lambda chunk: _normals(tangents[chunk], out[chunk]), chunks)


def _normals(tangents, out):
    """N = B x T with B = (Jxx, Jxy, Zx) and T = (Jxy, Jyy, Zy); its third component is the Jacobian J."""
    Jxx, Jxy, Jyy, Zx, Zy = tangents.T
    out[:, 0] = Jxy * Zy - Jyy * Zx
    out[:, 1] = Jxy * Zx - Jxx * Zy
    out[:, 2] = Jxx * Jyy - Jxy * Jxy
    length = np.sqrt(np.einsum("ij,ij->i", out, out))
    out *= (out_of_water(out[:, 2]) / at_cusp_one(length))[:, None]
    out[length == 0.0] = UPWARD


def out_of_water(jacobian):
    """-1 where the surface is folded over (J < 0), so that N = B x T points into the water; else 1."""
    return np.where(jacobian < 0.0, np.float32(-1.0), np.float32(1.0))


def at_cusp_one(length):
    """The length of N, or 1 at a cusp, where it is 0 and N / |N| would be no number."""
    return np.where(length == 0.0, np.float32(1.0), length)
