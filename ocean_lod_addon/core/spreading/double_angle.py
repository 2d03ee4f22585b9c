# SPDX-License-Identifier: GPL-3.0-or-later
"""Spreading laws that are short Fourier series in the direction.

D(omega, theta) = [1 + p cos 2 theta + q cos 4 theta] / (2 R) for |theta| <= R, with p and q functions of the
frequency and R pi/2 (nothing travels upwind) or pi.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class DoubleAngleSpreading:
    """A law of this form; `coefficients` gives p and q at omega in rad/s."""

    coefficients: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
    reach: float

    def density(self, omega, theta) -> np.ndarray:
        """D in 1/rad at theta in rad from the mean direction, |theta| <= pi."""
        p, q = self.coefficients(omega)
        series = 1.0 + p * np.cos(2.0 * theta) + q * np.cos(4.0 * theta)
        return np.where(np.abs(theta) <= self.reach, series / (2.0 * self.reach), 0.0)

    def cumulative(self, omega, theta) -> np.ndarray:
        """int D from -pi to theta."""
        p, q = self.coefficients(omega)
        t = np.clip(theta, -self.reach, self.reach)
        return 0.5 + (t + 0.5 * p * np.sin(2.0 * t) + 0.25 * q * np.sin(4.0 * t)) / (2.0 * self.reach)

    def cos2_integral(self, omega, half_width: float) -> np.ndarray:
        """int cos^2 theta D over |theta| <= half_width."""
        p, q = self.coefficients(omega)
        w = min(half_width, self.reach)
        # cos^2 t (1 + p cos 2t + q cos 4t) = c0 + c2 cos 2t + c4 cos 4t + c6 cos 6t
        c0, c2, c4, c6 = 0.5 + 0.25 * p, 0.5 + 0.5 * p + 0.25 * q, 0.25 * p + 0.5 * q, 0.25 * q
        sines = c2 * np.sin(2.0 * w) / 2.0 + c4 * np.sin(4.0 * w) / 4.0 + c6 * np.sin(6.0 * w) / 6.0
        return (c0 * w + sines) / self.reach
