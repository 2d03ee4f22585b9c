# SPDX-License-Identifier: GPL-3.0-or-later
"""What wind does to the slopes of a sea: Cox and Munk's measurements (1954; Eqs. 9 to 12).

U is the wind speed in m/s at 12.5 m above the water. The measurements cover 1 to 14 m/s.
"""

SLOPE_VARIANCE_FLOOR = 1.4e-6
"""The slope variance of a mirror under a sun of finite size (r^2/16, r = 4.65 mrad): a calm sea divides by it."""

C40, C22, C04 = 0.40, 0.12, 0.23
"""Peakedness coefficients, crosswind, mixed and upwind (Eq. 12); they do not depend on the wind."""


def slope_variance_along(U):
    """sigma_x^2 = 0.00316 U, up- and downwind (Eq. 9), +- 0.004."""
    return 0.00316 * U


def slope_variance_across(U):
    """sigma_y^2 = 0.003 + 0.00192 U, crosswind (Eq. 10), +- 0.002."""
    return 0.003 + 0.00192 * U


def skewness_c21(U):
    """c21 = 0.01 - 0.0086 U (Eq. 11), +- 0.03."""
    return 0.01 - 0.0086 * U


def skewness_c03(U):
    """c03 = 0.04 - 0.033 U (Eq. 11), +- 0.12; negative: steep slopes rise towards the wind."""
    return 0.04 - 0.033 * U
