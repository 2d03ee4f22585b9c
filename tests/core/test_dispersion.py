# SPDX-License-Identifier: GPL-3.0-or-later
"""The dispersion relation and its solver."""

import numpy as np
import pytest

from ocean_lod_addon.core.constants import GRAVITY, SURFACE_TENSION_OVER_DENSITY
from ocean_lod_addon.core.dispersion import (
    DEEP_WATER,
    Water,
    angular_frequency,
    coth_kh,
    group_speed,
    phase_speed,
    wavenumber,
)

TENSION = SURFACE_TENSION_OVER_DENSITY


@pytest.mark.parametrize("depth", [0.05, 1.0, 30.0, 1e5, np.inf])
@pytest.mark.parametrize("tension", [0.0, TENSION])
def test_wavenumber_inverts_the_dispersion_relation_from_kh_1e_minus_6_to_1e6(depth, tension):
    """Truth: wavenumber(angular_frequency(k)) = k. 1e-12: both are a few rounded operations on O(1) exponents."""
    scale = 1.0 if np.isinf(depth) else depth
    k = np.logspace(-6.0, 6.0, 1201) / scale
    water = Water(depth, tension)
    np.testing.assert_allclose(wavenumber(angular_frequency(k, water), water), k, rtol=1e-12)


def test_limits_of_shallow_and_deep_water():
    """Truth: long waves travel at sqrt(g h), as does their energy; in deep water omega^2 = g k and c_g = c/2.

    1e-9: the first corrections are (kh)^2/6 = 2e-13 and exp(-2kh).
    """
    shallow = Water(10.0)
    np.testing.assert_allclose(phase_speed(1e-7, shallow), np.sqrt(GRAVITY * 10.0), rtol=1e-9)
    np.testing.assert_allclose(group_speed(1e-7, shallow), np.sqrt(GRAVITY * 10.0), rtol=1e-9)
    np.testing.assert_allclose(wavenumber(2.0, Water(1e5)), 4.0 / GRAVITY, rtol=1e-9)
    np.testing.assert_allclose(group_speed(3.0, Water(1e5)), 0.5 * phase_speed(3.0), rtol=1e-9)
    assert coth_kh(0.3, np.inf) == 1.0


@pytest.mark.parametrize("water", [DEEP_WATER, Water(4.0), Water(np.inf, TENSION), Water(0.05, TENSION)])
def test_group_speed_is_the_derivative_of_frequency(water):
    """Truth: c_g = d omega / d k. 1e-7: central differences of relative step 1e-4 err by its square."""
    k = np.logspace(-3.0, 3.5, 60)
    step = 1e-4 * k
    difference = (angular_frequency(k + step, water) - angular_frequency(k - step, water)) / (2.0 * step)
    np.testing.assert_allclose(group_speed(k, water), difference, rtol=1e-7)


def test_slowest_ripple():
    """Truth: deep gravity-capillary waves are slowest at k = sqrt(g / T), where c^2 = 2 sqrt(g T)."""
    k = np.sqrt(GRAVITY / TENSION)
    water = Water(np.inf, TENSION)
    np.testing.assert_allclose(phase_speed(k, water) ** 2, 2.0 * np.sqrt(GRAVITY * TENSION), rtol=1e-14)
    assert np.all(phase_speed(k * np.array([0.5, 0.9, 1.1, 2.0]), water) > phase_speed(k, water))


def test_no_frequency_no_wavenumber():
    """Truth: omega = 0 means k = 0, in every water, without a warning."""
    for water in (DEEP_WATER, Water(3.0), Water(3.0, TENSION)):
        np.testing.assert_array_equal(wavenumber([0.0], water), [0.0])
