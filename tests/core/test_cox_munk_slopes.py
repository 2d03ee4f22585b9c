# SPDX-License-Identifier: GPL-3.0-or-later
"""Slope statistics from the wind, and what they leave to the BRDF."""

import numpy as np
import pytest

from ocean_lod_addon.core.optics import cox_munk
from ocean_lod_addon.core.optics.slope_density import slope_deviation
from tests.core.optics_helpers import OPS


def test_the_total_variance_is_cox_and_munks_own_fit():
    # Their separate fit to the total, sigma^2 = 0.003 + 0.00512 U, is the sum of the two to 0.8 % of the slope.
    U = np.linspace(1.0, 14.0, 14)
    total = cox_munk.slope_variance_along(U) + cox_munk.slope_variance_across(U)
    np.testing.assert_allclose(total, 0.003 + 0.00512 * U, rtol=0.008)


def test_a_breeze_is_rougher_across_and_a_wind_along_it():
    # sigma_x^2 = sigma_y^2 at U = 0.003/(0.00316 - 0.00192) = 2.419 m/s.
    equal = 0.003 / 0.00124
    for U, along_is_rougher in ((0.9 * equal, False), (1.1 * equal, True)):
        assert (cox_munk.slope_variance_along(U) > cox_munk.slope_variance_across(U)) == along_is_rougher


def test_steep_slopes_rise_into_the_wind_from_1_21_metres_per_second():
    # E[X^3] = -c03 with X rising into the wind.
    assert cox_munk.skewness_c03(1.25) < 0.0 < cox_munk.skewness_c03(1.20)


def test_a_calm_is_a_mirror_under_a_sun_of_finite_size_and_not_a_division_by_zero():
    assert cox_munk.slope_variance_along(0.0) == 0.0
    sigma = slope_deviation(OPS, np.array([cox_munk.slope_variance_along(0.0), -1e-9, 0.04]))
    half_angle = 4.65e-3
    assert sigma[0] == sigma[1] == pytest.approx(half_angle / 4.0, rel=0.02)
    assert sigma[2] == pytest.approx(0.2, rel=1e-15)
