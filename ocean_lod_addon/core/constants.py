# SPDX-License-Identifier: GPL-3.0-or-later
"""Physical constants, SI units."""

GRAVITY = 9.81
"""Standard acceleration of gravity as used throughout the paper, m/s^2."""

SURFACE_TENSION_OVER_DENSITY = 7.3e-5
"""Kinematic surface tension of sea water, m^3/s^2."""

WATER_REFRACTIVE_INDEX = 1.333
"""Refractive index of water in visible light."""

EARTH_RADIUS = 6.371e6
"""Mean radius of the Earth, m."""
