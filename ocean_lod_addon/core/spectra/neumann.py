# SPDX-License-Identifier: GPL-3.0-or-later
"""Neumann 1953: a fully developed sea from visual records. THEORY section 3."""

import math
from dataclasses import dataclass

import numpy as np

from ..constants import GRAVITY

NEUMANN_CONSTANT = 3.05
"""m^2 s^-5, of the doubled spectrum (Kinsman 1965, 8.14:15); S here is the variance density, hence pi/4."""


@dataclass(frozen=True)
class Neumann:
    """S = (3.05 pi / 4) omega^-6 exp(-2 (g / (U omega))^2), U the wind 7.5 m above the sea in m/s."""

    wind_speed: float
    gravity: float = GRAVITY

    @property
    def peak_frequency(self) -> float:
        """Where S is largest, sqrt(2/3) g / U, rad/s."""
        return math.sqrt(2.0 / 3.0) * self.gravity / self.wind_speed

    def density(self, omega) -> np.ndarray:
        """Variance density S in m^2 s/rad for omega > 0 in rad/s."""
        decay = 2.0 * (self.gravity / (self.wind_speed * omega)) ** 2.0
        return 0.25 * math.pi * NEUMANN_CONSTANT * omega**-6.0 * np.exp(-decay)

    @property
    def variance(self) -> float:
        """m0 in m^2."""
        return UNIT_VARIANCE * (self.wind_speed / self.gravity) ** 5


UNIT_VARIANCE = 0.25 * math.pi * NEUMANN_CONSTANT * 0.5 * 2.0**-2.5 * math.gamma(2.5)
"""m0 / (U/g)^5 in m^2 s^-5: int omega^-6 exp(-b omega^-2) d omega = b^(-5/2) Gamma(5/2) / 2."""


def neumann_from_height(significant_wave_height: float) -> Neumann:
    """The spectrum of this significant wave height in m: U such that m0 = Hs^2 / 16."""
    return Neumann(GRAVITY * (significant_wave_height**2 / (16.0 * UNIT_VARIANCE)) ** 0.2)
