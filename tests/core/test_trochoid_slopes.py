# SPDX-License-Identifier: GPL-3.0-or-later
"""Slope variance of trochoids (Eq. 26): means over real profiles, splits, sums and axes."""

import numpy as np
import pytest

from ocean_lod_addon.core.optics.trochoid_slopes import (
    mean_square_slope,
    mean_square_slope_by_undisturbed_position,
    mean_square_slope_linear,
    residual_mean_square_slope,
    slope_covariance,
)
from ocean_lod_addon.core.waves import WaveSet

PSI = np.linspace(0.0, 2.0 * np.pi, 4096, endpoint=False)


def wave_set(amplitude, wavenumber, direction, orbit_ratio=1.0):
    amplitude = np.atleast_1d(np.asarray(amplitude, dtype=float))
    wavenumber = np.broadcast_to(wavenumber, amplitude.shape)
    return WaveSet(
        amplitude,
        wavenumber,
        np.sqrt(9.81 * wavenumber),
        np.broadcast_to(direction, amplitude.shape),
        np.zeros_like(amplitude),
        np.broadcast_to(orbit_ratio, amplitude.shape),
        np.zeros(len(amplitude)),
    )


@pytest.mark.parametrize("Q", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("e", [0.01, 0.3, 0.8])
def test_f_is_the_mean_square_slope_of_the_profile(e, Q):
    # x = x0 - Q A sin psi, z = A cos psi: slope -e sin/(1 - Q e cos), horizontal area (1 - Q e cos) dx0.
    stretch = 1.0 - Q * e * np.cos(PSI)
    slope = -e * np.sin(PSI) / stretch
    # A periodic mean converges geometrically with ratio (Qe)/(1 + sqrt(1-(Qe)^2)) < 0.5: rounding remains.
    assert mean_square_slope(e, Q) == pytest.approx(np.mean(slope**2 * stretch), rel=1e-13)
    if Q == 1.0:
        assert mean_square_slope_by_undisturbed_position(e) == pytest.approx(np.mean(slope**2), rel=1e-12)
    if Q == 0.0:
        assert mean_square_slope_linear(e) == pytest.approx(np.mean(slope**2), rel=1e-13)


def test_ripples_keep_their_digits_in_float32():
    e = np.float32([1e-6, 1e-4, 1e-3])
    f = mean_square_slope(e, np.float32(1.0))
    assert f.dtype == np.float32
    np.testing.assert_allclose(f, e.astype(float) ** 2 / 2, rtol=5e-7)  # f/(e^2/2) = 1 + e^2/4


def test_a_looping_trochoid_counts_as_the_steepest_one_that_does_not():
    np.testing.assert_allclose(mean_square_slope([1.0, 1.5, 40.0]), 1.0, rtol=1e-15)
    np.testing.assert_allclose(mean_square_slope([2.0, 3.0], 0.5), 4.0, rtol=1e-15)  # 1/Q^2
    assert np.all(np.isfinite(mean_square_slope_by_undisturbed_position([0.0, 0.99])))
    assert mean_square_slope_by_undisturbed_position(1.0) == np.inf


def test_drawn_and_left_variance_add_up_at_every_weight():
    e, w = np.meshgrid(np.linspace(0.0, 0.95, 20), np.linspace(0.0, 1.0, 21))
    drawn = mean_square_slope(w * e)
    np.testing.assert_allclose(drawn + residual_mean_square_slope(e, w), mean_square_slope(e), rtol=1e-14)
    assert np.all(residual_mean_square_slope(e, w) >= 0.0)


def test_one_wave_puts_its_variance_along_its_direction():
    waves = wave_set(0.5, 0.4, np.pi / 3)
    f = mean_square_slope(0.2)
    covariance = slope_covariance(waves)
    assert covariance == pytest.approx((f / 4, 3 * f / 4, np.sqrt(3) * f / 4), rel=1e-14)


def test_an_even_fan_of_waves_is_isotropic():
    waves = wave_set(np.full(8, 0.2), 0.5, np.arange(8) * np.pi / 4)
    total = 8 * mean_square_slope(0.1)
    assert slope_covariance(waves) == pytest.approx((total / 2, total / 2, 0.0), rel=1e-14, abs=1e-17)


def test_weights_per_point_give_a_covariance_per_point():
    waves = wave_set([0.5, 0.1], [0.2, 2.0], [0.0, 0.5], orbit_ratio=[1.0, 1.3])
    weight = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    covariance = slope_covariance(waves, weight)
    nothing_drawn, swell_drawn, all_drawn = covariance.xx
    assert nothing_drawn == pytest.approx(slope_covariance(waves).xx, rel=1e-15)
    assert swell_drawn == pytest.approx(mean_square_slope(0.2, 1.3) * np.cos(0.5) ** 2, rel=1e-14)
    assert all_drawn == 0.0


def test_looping_trochoids_have_a_slope_variance_whatever_the_rounding():
    """Truth: the steepest wave that does not loop, Q e = 1, has f = 1/Q^2; 1e-7: the root of a rounding of 1."""
    random = np.random.default_rng(3)
    orbit_ratio = random.uniform(0.5, 100.0, 100_000)
    steepness = random.uniform(1.0, 50.0, 100_000) / orbit_ratio
    found = mean_square_slope(steepness, orbit_ratio)
    np.testing.assert_allclose(found, 1.0 / orbit_ratio**2, rtol=1e-7)
