# SPDX-License-Identifier: GPL-3.0-or-later
"""Longuet-Higgins, Cartwright and Smith 1963: D ~ cos^2s(theta / 2), with s constant or Mitsuyasu's.

THEORY section 3.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..constants import GRAVITY
from ..special import incomplete_beta, log_gamma


@dataclass(frozen=True)
class Cos2s:
    """D = Gamma(s+1) / (2 sqrt(pi) Gamma(s+1/2)) cos^2s(theta/2); `exponent` gives s at omega in rad/s."""

    exponent: Callable[[np.ndarray], np.ndarray]

    def density(self, omega, theta) -> np.ndarray:
        """D in 1/rad at theta in rad from the mean direction, |theta| <= pi."""
        s = self.exponent(omega)
        norm = np.exp(log_gamma(s + 1.0) - log_gamma(s + 0.5)) / (2.0 * np.sqrt(np.pi))
        return norm * np.abs(np.cos(0.5 * theta)) ** (2.0 * s)

    def cumulative(self, omega, theta) -> np.ndarray:
        """int D from -pi to theta: with x = sin^2(theta/2) it is 1/2 (1 + I_x(1/2, s + 1/2)) for theta > 0."""
        x = np.sin(0.5 * theta) ** 2
        return 0.5 + 0.5 * np.sign(theta) * incomplete_beta(0.5, self.exponent(omega) + 0.5, x)

    def cos2_integral(self, omega, half_width: float) -> np.ndarray:
        """int cos^2 theta D over |theta| <= half_width.

        cos^2 theta = 1 - 4 x + 4 x^2 with x = sin^2(theta/2), and int x^n D is a beta integral again:
        <x> = a / (a + b), <x^2> = <x> (a + 1) / (a + b + 1), a = 1/2, b = s + 1/2.
        """
        b = self.exponent(omega) + 0.5
        x = np.sin(0.5 * half_width) ** 2
        mean_x = 0.5 / (0.5 + b)
        mean_x2 = mean_x * 1.5 / (1.5 + b)
        parts = [incomplete_beta(0.5 + n, b, x) for n in range(3)]
        return parts[0] - 4.0 * mean_x * parts[1] + 4.0 * mean_x2 * parts[2]


def constant_cos2s(s: float) -> Cos2s:
    """The law with the same s for all waves."""
    return Cos2s(lambda omega: np.full_like(omega, s, dtype=np.float64))


def mitsuyasu_largest_exponent(wind_speed: float, peak_frequency: float) -> float:
    """s_max = 11.5 (omega_p U10 / g)^-2.5 (Mitsuyasu et al. 1975); m/s, rad/s."""
    return 11.5 * (peak_frequency * wind_speed / GRAVITY) ** -2.5


def mitsuyasu_exponent(omega, wind_speed: float, peak_frequency: float) -> np.ndarray:
    """s = s_max (omega/omega_p)^5 below the peak, s_max (omega/omega_p)^-2.5 above it."""
    ratio = np.asarray(omega, dtype=np.float64) / peak_frequency
    return mitsuyasu_largest_exponent(wind_speed, peak_frequency) * np.minimum(ratio**5.0, ratio**-2.5)


def mitsuyasu(wind_speed: float, peak_frequency: float) -> Cos2s:
    """The law with Mitsuyasu's s: sharpest at the peak of the spectrum."""
    return Cos2s(lambda omega: mitsuyasu_exponent(omega, wind_speed, peak_frequency))
