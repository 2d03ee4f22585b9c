# SPDX-License-Identifier: GPL-3.0-or-later
"""Cote et al. 1960, the Stereo Wave Observation Project: THEORY section 3."""

import numpy as np

from .double_angle import DoubleAngleSpreading


def swop_coefficients(omega_over_omega0) -> tuple[np.ndarray, np.ndarray]:
    """p = 0.50 + 0.82 e and q = 0.32 e, e = exp(-(omega/omega0)^4 / 2)."""
    e = np.exp(-0.5 * np.asarray(omega_over_omega0, dtype=np.float64) ** 4.0)
    return 0.50 + 0.82 * e, 0.32 * e


def swop(omega0: float) -> DoubleAngleSpreading:
    """The SWOP law with omega0 = g / U5 in rad/s, U5 the wind 5 m above the sea."""
    return DoubleAngleSpreading(lambda omega: swop_coefficients(omega / omega0), 0.5 * np.pi)
