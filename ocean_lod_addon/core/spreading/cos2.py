# SPDX-License-Identifier: GPL-3.0-or-later
"""The plain cosine-squared law, the same for all waves: D = (2 / pi) cos^2 theta, |theta| <= pi/2."""

import numpy as np

from .double_angle import DoubleAngleSpreading


def cosine_squared() -> DoubleAngleSpreading:
    """2 cos^2 theta = 1 + cos 2 theta: p = 1, q = 0."""
    return DoubleAngleSpreading(lambda omega: (np.ones_like(omega), np.zeros_like(omega)), 0.5 * np.pi)
