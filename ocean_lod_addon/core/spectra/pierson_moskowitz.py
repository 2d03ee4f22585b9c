# SPDX-License-Identifier: GPL-3.0-or-later
"""Pierson and Moskowitz 1964: the fully developed wind sea, and the form shared by the two-parameter spectra.

S(omega) = A omega^-5 exp(-B omega^-4), THEORY section 3. Its moments are closed forms.
"""

import math
from dataclasses import dataclass

import numpy as np

from ..constants import GRAVITY
from ..special import exponential_integral_e1

PHILLIPS_ALPHA = 8.1e-3
PIERSON_MOSKOWITZ_BETA = 0.74


@dataclass(frozen=True)
class ExponentialFifth:
    """S(omega) = A omega^-5 exp(-B omega^-4), with A in m^2 s^-4 and B in s^-4."""

    A: float
    B: float

    @property
    def peak_frequency(self) -> float:
        """Where S is largest, (4 B / 5)^(1/4), rad/s."""
        return (0.8 * self.B) ** 0.25

    def density(self, omega) -> np.ndarray:
        """Variance density S in m^2 s/rad for omega > 0 in rad/s."""
        return self.A * omega**-5.0 * np.exp(-self.B * omega**-4.0)

    def moment(self, n: int) -> float:
        """m_n = int omega^n S d omega over all frequencies, n = 0 to 3; m_4 diverges.

        int = A / 4 B^(n/4 - 1) Gamma(1 - n/4).
        """
        return 0.25 * self.A * self.B ** (0.25 * n - 1.0) * math.gamma(1.0 - 0.25 * n)

    def energy_between(self, low, high) -> np.ndarray:
        """int S d omega from `low` to `high` > 0, m^2."""
        return self.moment(0) * (np.exp(-self.B / high**4.0) - np.exp(-self.B / low**4.0))

    def deep_slope_variance_between(self, low, high, gravity: float = GRAVITY) -> np.ndarray:
        """int k^2 S d omega from `low` to `high` > 0 in deep water, k = omega^2 / g: E1 terms."""
        below_high = exponential_integral_e1(self.B / high**4.0)
        below_low = exponential_integral_e1(self.B / low**4.0)
        return self.A / (4.0 * gravity**2) * (below_high - below_low)

    def deep_slope_variance_below(self, cutoff, gravity: float = GRAVITY) -> np.ndarray:
        """Slope variance of the waves slower than `cutoff` in rad/s, deep water: A / (4 g^2) E1(B / cutoff^4)."""
        return self.A / (4.0 * gravity**2) * exponential_integral_e1(self.B / cutoff**4.0)

    def frequency_below_which(self, energy_share) -> np.ndarray:
        """The frequency below which the share `energy_share` (0 to 1, exclusive) of the energy lies, rad/s."""
        return (self.B / -np.log(energy_share)) ** 0.25


def pierson_moskowitz_from_wind(wind_speed_19_5: float, gravity: float = GRAVITY) -> ExponentialFifth:
    """The spectrum of a fully developed sea under the wind, in m/s, 19.5 m above it."""
    g, U = gravity, wind_speed_19_5
    return ExponentialFifth(PHILLIPS_ALPHA * g**2, PIERSON_MOSKOWITZ_BETA * (g / U) ** 4)


def pierson_moskowitz_from_height(significant_wave_height: float, gravity: float = GRAVITY) -> ExponentialFifth:
    """The fully developed sea of the significant wave height in m: B such that m0 = Hs^2 / 16."""
    A = PHILLIPS_ALPHA * gravity**2
    return ExponentialFifth(A, 4.0 * A / significant_wave_height**2)
