# SPDX-License-Identifier: GPL-3.0-or-later
"""The dispersion relation of surface waves: which frequency belongs to which wavelength, and what follows.

omega^2 = (g k + T k^3) tanh(k h), with T the kinematic surface tension (0 leaves it out) and h the depth
(infinite by default). THEORY section 2. All functions take scalars or arrays that broadcast.
"""

from dataclasses import dataclass

import numpy as np

from .constants import GRAVITY, SURFACE_TENSION_OVER_DENSITY

DEEP_KH = 20.0
"""From here on tanh(k h) is 1 in float64."""

SHALLOW_Y = 1e-8
"""Below this omega^2 h / g the series k h = sqrt(y) (1 + y/6) is exact; Newton would divide by almost 0."""

LARGEST_SINH_ARGUMENT = 700.0
"""x / sinh x is below 1e-300 from here on; exp of a larger number overflows."""

_NEWTON_STEPS = 4
_CAPILLARY_NEWTON_STEPS = 12


@dataclass(frozen=True)
class Water:
    """The water a sea moves in: depth in m (inf: deep) and kinematic surface tension in m^3/s^2 (or 0)."""

    depth: float = np.inf
    surface_tension: float = 0.0


DEEP_WATER = Water()
DEEP_WATER_WITH_RIPPLES = Water(surface_tension=SURFACE_TENSION_OVER_DENSITY)


def wavenumber(omega, water: Water = DEEP_WATER, gravity: float = GRAVITY) -> np.ndarray:
    """Wavenumber k in rad/m of waves of angular frequency omega >= 0 in rad/s. k(0) is 0."""
    omega = np.asarray(omega, dtype=np.float64)
    k = _gravity_wavenumber(omega, water.depth, gravity)
    if water.surface_tension > 0.0:
        k = _with_surface_tension(omega, k, water, gravity)
    return k


def _gravity_wavenumber(omega, depth, g):
    """Solve omega^2 = g k tanh k h by Newton's rule from y / sqrt(tanh y). THEORY section 2."""
    if np.isinf(depth):
        return omega * omega / g
    y = omega * omega * depth / g
    middle = np.clip(y, SHALLOW_Y, DEEP_KH)
    x = middle / np.sqrt(np.tanh(middle))
    for _ in range(_NEWTON_STEPS):
        t = np.tanh(x)
        x = x - (x * t - middle) / (t + x * (1.0 - t * t))
    series = np.sqrt(y) * (1.0 + y / 6.0)
    return np.where(y < SHALLOW_Y, series, np.where(y > DEEP_KH, y, x)) / depth


def _with_surface_tension(omega, k_gravity, water, g):
    """Solve omega^2 = (g k + T k^3) tanh k h for ln k by Newton's rule, from the nearer of its two limits."""
    T = water.surface_tension
    positive = omega > 0.0
    target = np.log(np.where(positive, omega, 1.0))
    k = np.minimum(np.where(positive, k_gravity, 1.0), np.exp(2.0 / 3.0 * target - np.log(T) / 3.0))
    for _ in range(_CAPILLARY_NEWTON_STEPS):
        excess = np.log(angular_frequency(k, water, g)) - target
        k = k * np.exp(-excess / _frequency_exponent(k, water, g))
    return np.where(positive, k, 0.0)


def angular_frequency(k, water: Water = DEEP_WATER, gravity: float = GRAVITY) -> np.ndarray:
    """Angular frequency omega in rad/s of waves of wavenumber k >= 0 in rad/m."""
    k = np.asarray(k, dtype=np.float64)
    tanh_kh = 1.0 if np.isinf(water.depth) else np.tanh(k * water.depth)
    return np.sqrt(k * (gravity + water.surface_tension * k * k) * tanh_kh)


def phase_speed(k, water: Water = DEEP_WATER, gravity: float = GRAVITY) -> np.ndarray:
    """Speed of a crest, omega / k, in m/s, for k > 0 in rad/m."""
    return angular_frequency(k, water, gravity) / k


def group_speed(k, water: Water = DEEP_WATER, gravity: float = GRAVITY) -> np.ndarray:
    """Speed of wave energy, d omega / d k, in m/s, for k > 0 in rad/m."""
    return phase_speed(k, water, gravity) * _frequency_exponent(k, water, gravity)


def _frequency_exponent(k, water, g):
    """d ln omega / d ln k = [(g + 3 T k^2) / (g + T k^2) + 2kh / sinh 2kh] / 2, between 1/2 and 2."""
    tension = water.surface_tension * k * k
    return 0.5 * ((g + 3.0 * tension) / (g + tension) + two_kh_over_sinh(k, water.depth))


def two_kh_over_sinh(k, depth: float) -> np.ndarray:
    """2kh / sinh 2kh: 1 in shallow water, 0 in deep water; no overflow."""
    x = np.minimum(2.0 * np.asarray(k, dtype=np.float64) * depth, LARGEST_SINH_ARGUMENT)
    positive = np.where(x > 0.0, x, 1.0)
    return np.where(x > 0.0, 2.0 * positive * np.exp(-positive) / -np.expm1(-2.0 * positive), 1.0)


def coth_kh(k, depth: float) -> np.ndarray:
    """Horizontal over vertical radius of the orbits at the surface, coth(k h), for k > 0. THEORY section 2."""
    k = np.asarray(k, dtype=np.float64)
    return np.ones_like(k) if np.isinf(depth) else 1.0 / np.tanh(k * depth)
