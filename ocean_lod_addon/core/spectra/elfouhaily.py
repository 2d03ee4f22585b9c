# SPDX-License-Identifier: GPL-3.0-or-later
"""Elfouhaily, Chapron, Katsaros and Vandemark 1997 (J. Geophys. Res. 102, 15781): one spectrum for all wind waves,
from the longest to capillary ripples, tuned to the slope variances that Cox and Munk measured.

Their symbols and equation numbers. S(k) = (B_l + B_h) / k^3 is the variance density over the wavenumber, in m^3.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..constants import GRAVITY
from ..dispersion import DEEP_WATER, Water, angular_frequency, group_speed, wavenumber
from .moments import spectrum_moments

K_M = 370.0
"""Wavenumber of the slowest waves, rad/m (Eq. 24)."""

C_M = math.sqrt(2.0 * GRAVITY / K_M)
"""Their phase speed, 0.23 m/s."""

FETCH_SCALE = 2.2e4
"""X_0 of Eq. 37, in units of U10^2 / g."""

FULLY_DEVELOPED = 0.84
YOUNGEST = 5.0
"""Inverse wave age Omega_c: range over which the model was fitted."""


def inverse_wave_age(wind_speed: float, fetch: float) -> float:
    """Omega_c = 0.84 tanh((X / X_0)^0.4)^-0.75, X = g F / U10^2 (Eq. 37), held at 5; m/s and m."""
    X = GRAVITY * fetch / wind_speed**2
    return min(FULLY_DEVELOPED * math.tanh((X / FETCH_SCALE) ** 0.4) ** -0.75, YOUNGEST)


def friction_velocity(wind_speed: float) -> float:
    """u* in m/s from U10 in m/s: u*^2 = C_10 U10^2, C_10 = (0.8 + 0.065 U10) 1e-3 (Eq. 61, after Wu)."""
    return math.sqrt((0.8 + 0.065 * wind_speed) * 1e-3) * wind_speed


def deep_phase_speed(k) -> np.ndarray:
    """c = sqrt(g / k (1 + (k / k_m)^2)) in m/s (Eq. 24)."""
    return np.sqrt(GRAVITY / k * (1.0 + (k / K_M) ** 2))


@dataclass(frozen=True)
class Elfouhaily:
    """The spectrum of a wind U10 in m/s and an inverse wave age Omega_c, in this water."""

    wind_speed: float
    inverse_wave_age: float
    water: Water = DEEP_WATER

    @property
    def peak_wavenumber(self) -> float:
        """k_p = k_0 Omega_c^2, k_0 = g / U10^2 (Eq. 3 and below), rad/m."""
        return GRAVITY / self.wind_speed**2 * self.inverse_wave_age**2

    @cached_property
    def peak_frequency(self) -> float:
        """The frequency of k_p in this water, rad/s."""
        return float(angular_frequency(self.peak_wavenumber, self.water))

    def density(self, omega) -> np.ndarray:
        """Variance density over the frequency, S(k) dk / d omega, in m^2 s/rad for omega > 0 in rad/s."""
        k = wavenumber(omega, self.water)
        return self.wavenumber_density(k) / group_speed(k, self.water)

    def wavenumber_density(self, k) -> np.ndarray:
        """S(k) = (B_l + B_h) / k^3 (Eq. 30), m^3, for k > 0 in rad/m."""
        return (self._long_wave_curvature(k) + self._short_wave_curvature(k)) * k**-3.0

    def _long_wave_curvature(self, k):
        """B_l = alpha_p / 2 (c_p / c) F_p (Eqs. 31, 32), alpha_p = 0.006 sqrt(Omega) (Eq. 34)."""
        c_p = deep_phase_speed(self.peak_wavenumber)
        Omega = self.wind_speed / c_p
        decay = np.exp(-Omega / math.sqrt(10.0) * (np.sqrt(k / self.peak_wavenumber) - 1.0))
        F_p = self._low_cutoff(k) * self._peak_enhancement(k) * decay
        return 0.5 * 0.006 * np.sqrt(Omega) * c_p / deep_phase_speed(k) * F_p

    def _short_wave_curvature(self, k):
        """B_h = alpha_m / 2 (c_m / c) F_m (Eq. 40).

        F_m = L_PM exp(-(k / k_m - 1)^2 / 4): Eq. 41 with the low cut-off L_PM of Eq. 32, without which waves
        longer than the peak would keep energy (McDaniel 2001, as in most later use).
        """
        F_m = self._low_cutoff(k) * np.exp(-0.25 * (k / K_M - 1.0) ** 2)
        return 0.5 * self._short_wave_level() * C_M / deep_phase_speed(k) * F_m

    def _low_cutoff(self, k):
        """L_PM = exp(-5/4 (k_p / k)^2) (Eq. 2)."""
        return np.exp(-1.25 * (self.peak_wavenumber / k) ** 2)

    def _peak_enhancement(self, k):
        """J_p = gamma^Gamma (Eq. 3), gamma 1.7 in old seas, more in young; sigma = 0.08 (1 + 4 Omega_c^-3)."""
        Omega_c = self.inverse_wave_age
        gamma = 1.7 + 6.0 * math.log10(max(Omega_c, 1.0))
        sigma = 0.08 * (1.0 + 4.0 * Omega_c**-3)
        return gamma ** np.exp(-0.5 * ((np.sqrt(k / self.peak_wavenumber) - 1.0) / sigma) ** 2)

    def _short_wave_level(self):
        """alpha_m = 0.01 [1 + ln(u*/c_m)], or 0.01 [1 + 3 ln(u*/c_m)] for u* > c_m (Eq. 44); 0 where negative."""
        u = math.log(friction_velocity(self.wind_speed) / C_M)
        return 0.01 * max(1.0 + (3.0 * u if u > 0.0 else u), 0.0)


def elfouhaily_from_wind(wind_speed: float, fetch: float, water: Water) -> Elfouhaily:
    """The spectrum of the wind U10 in m/s after the fetch in m."""
    return Elfouhaily(wind_speed, inverse_wave_age(wind_speed, fetch), water)


_WIND_BRACKET = (0.5, 200.0)
_BISECTIONS = 50


def elfouhaily_from_height(significant_wave_height: float, fetch: float, water: Water) -> Elfouhaily:
    """The spectrum after the fetch in m of the wind that raises this significant wave height in m.

    Wave height grows with the wind, so bisection finds it; a height that no wind raises gets the nearest.
    """
    low, high = _WIND_BRACKET
    for _ in range(_BISECTIONS):
        middle = math.sqrt(low * high)
        m0 = spectrum_moments(elfouhaily_from_wind(middle, fetch, water))[0]
        low, high = (middle, high) if 16.0 * m0 < significant_wave_height**2 else (low, middle)
    return elfouhaily_from_wind(math.sqrt(low * high), fetch, water)


def upwind_crosswind_ratio(k, wind_speed: float, peak_wavenumber: float) -> np.ndarray:
    """Delta(k) = tanh(a_0 + a_p (c / c_p)^2.5 + a_m (c_m / c)^2.5) (Eq. 57), for k > 0 in rad/m.

    a_0 = ln 2 / 4, a_p = 4, a_m = 0.13 u* / c_m (Eqs. 58, 59).
    """
    c, c_p = deep_phase_speed(k), deep_phase_speed(peak_wavenumber)
    a_m = 0.13 * friction_velocity(wind_speed) / C_M
    return np.tanh(0.25 * math.log(2.0) + 4.0 * (c / c_p) ** 2.5 + a_m * (C_M / c) ** 2.5)
