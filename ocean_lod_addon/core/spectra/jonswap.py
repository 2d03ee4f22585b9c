# SPDX-License-Identifier: GPL-3.0-or-later
"""Hasselmann et al. 1973, the Joint North Sea Wave Project: a wind sea that is still growing. THEORY section 3."""

import math
from dataclasses import dataclass, replace

import numpy as np

from ..constants import GRAVITY
from .moments import mean_period, spectrum_moments, zero_crossing_period

PEAK_WIDTH_BELOW = 0.07
PEAK_WIDTH_ABOVE = 0.09


@dataclass(frozen=True)
class Jonswap:
    """S = alpha g^2 omega^-5 exp(-5/4 (omega_p/omega)^4) gamma^r, omega_p in rad/s."""

    alpha: float
    peak_frequency: float
    gamma: float
    gravity: float = GRAVITY

    def density(self, omega) -> np.ndarray:
        """Variance density S in m^2 s/rad for omega > 0 in rad/s."""
        base = self.alpha * self.gravity**2 * omega**-5.0 * np.exp(-1.25 * (self.peak_frequency / omega) ** 4.0)
        return base * self.gamma ** self.peak_shape(omega)

    def peak_shape(self, omega) -> np.ndarray:
        """r = exp(-(omega - omega_p)^2 / (2 s^2 omega_p^2)), s 0.07 below the peak and 0.09 above it."""
        relative = omega / self.peak_frequency - 1.0
        s = np.where(relative <= 0.0, PEAK_WIDTH_BELOW, PEAK_WIDTH_ABOVE)
        return np.exp(-0.5 * (relative / s) ** 2)


def jonswap_from_wind(wind_speed: float, fetch: float, gamma: float, gravity: float = GRAVITY) -> Jonswap:
    """The sea that the wind U10 in m/s raises over the fetch in m.

    alpha = 0.076 (U^2 / (F g))^0.22, omega_p = 22 (g^2 / (U F))^(1/3).
    """
    U, F, g = wind_speed, fetch, gravity
    return Jonswap(0.076 * (U**2 / (F * g)) ** 0.22, 22.0 * (g**2 / (U * F)) ** (1.0 / 3.0), gamma, g)


def jonswap_from_height(significant_wave_height: float, peak_frequency: float, gamma: float) -> Jonswap:
    """The spectrum of this height in m and peak in rad/s: alpha such that m0 = Hs^2 / 16 exactly."""
    unit = Jonswap(1.0, peak_frequency, gamma)
    return replace(unit, alpha=significant_wave_height**2 / (16.0 * spectrum_moments(unit)[0]))


def peak_frequency_of_period(period: float, period_kind: str, gamma: float) -> float:
    """omega_p in rad/s of a JONSWAP spectrum with this period in s of the kind peak, mean or zero_crossing."""
    m0, m1, m2 = spectrum_moments(Jonswap(1.0, 1.0, gamma))
    period_at_unit_peak = {
        "peak": 2.0 * math.pi,
        "mean": mean_period(m0, m1),
        "zero_crossing": zero_crossing_period(m0, m2),
    }
    return period_at_unit_peak[period_kind] / period


def fully_developed_fetch(wind_speed: float, fully_developed_peak: float, gravity: float = GRAVITY) -> float:
    """The fetch in m at which omega_p has come down to `fully_developed_peak` in rad/s and growth ends."""
    return gravity**2 / wind_speed * (22.0 / fully_developed_peak) ** 3
