# SPDX-License-Identifier: GPL-3.0-or-later
"""The float64 reference surface: derivatives, exactness of Gerstner's wave, mean level, unresolved cases."""

import numpy as np
import pytest

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.gerstner import gerstner_particle, mean_level, sum_steepness, surface_points
from ocean_lod_addon.core.sea import Sea
from ocean_lod_addon.core.waves import TWO_PI, WaveSet

X0, Y0 = np.array([0.0, 12.5, -340.0, 7.0]), np.array([3.0, -8.25, 55.0, -1.0])


def one_wave(amplitude, wavenumber, orbit_ratio=1.0):
    omega = np.sqrt(GRAVITY * wavenumber)
    return WaveSet(amplitude, wavenumber, omega, 0.0, 0.0, orbit_ratio, 0)


@pytest.mark.parametrize("choppiness", [0.0, 0.7, 1.0])
def test_derivatives(choppiness):
    """Truth: tangents and velocity are derivatives of the position. 1e-7: central differences of step 1e-4."""
    waves = discretise(Sea(choppiness=choppiness, finite_depth=True, depth=12.0), 1.0)
    step = 1e-4
    points = surface_points(waves, X0, Y0, 5.0)
    for name, before, after in (
        ("tangent_x", (X0 - step, Y0, 5.0), (X0 + step, Y0, 5.0)),
        ("tangent_y", (X0, Y0 - step, 5.0), (X0, Y0 + step, 5.0)),
        ("velocity", (X0, Y0, 5.0 - step), (X0, Y0, 5.0 + step)),
    ):
        difference = surface_points(waves, *after).position - surface_points(waves, *before).position
        np.testing.assert_allclose(getattr(points, name), difference / (2.0 * step), atol=1e-7)


def test_normal_and_slope_belong_together():
    """Truth: the normal is (-slope, 1) normalised, and the Jacobian the area of the tangents' horizontal parts."""
    points = surface_points(discretise(Sea(), 1.0), X0, Y0, 5.0)
    expected = np.concatenate([-points.slope, np.ones((len(X0), 1))], axis=1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    np.testing.assert_allclose(points.normal, expected, rtol=1e-12)
    area = np.linalg.det(np.stack([points.tangent_x[:, :2], points.tangent_y[:, :2]], axis=1))
    np.testing.assert_allclose(points.jacobian, area, rtol=1e-12)


def test_gerstner_wave_is_an_exact_solution():
    """Truth: along the surface of a deep Gerstner wave the pressure is constant: x_tt x_a + (z_tt + g) z_a = 0.

    Accelerations by central differences of the velocity, 1e-6 of g.
    """
    waves, step = one_wave(2.0, 0.15), 1e-4
    x = np.linspace(0.0, TWO_PI / 0.15, 50)
    points = surface_points(waves, x, 0.0, 1.0)
    later, earlier = (surface_points(waves, x, 0.0, 1.0 + s).velocity for s in (step, -step))
    acceleration = (later - earlier) / (2.0 * step) + np.array([0.0, 0.0, GRAVITY])
    np.testing.assert_allclose(np.sum(acceleration * points.tangent_x, axis=1), 0.0, atol=1e-6 * GRAVITY)


def test_eq_1_at_the_surface_is_eq_2():
    """Truth: the water at depth 0 of Eq. 1 is the surface of Eq. 2 for one wave. 1e-12: rounding."""
    waves, x = one_wave(1.5, 0.2), np.linspace(0.0, 30.0, 20)
    dx, dz, jacobian = gerstner_particle(1.5, 0.2, 0.0, 0.2 * x)
    points = surface_points(waves, x, 0.0, 0.0)
    np.testing.assert_allclose(points.position[:, 0] - x, dx, atol=1e-12)
    np.testing.assert_allclose(points.position[:, 2], dz, atol=1e-12)
    assert jacobian == pytest.approx(1.0 - 0.3**2, rel=1e-14)


def test_crests_are_sharp_and_the_mean_level_is_down():
    """Truth: averaged over horizontal area (weight J) Z is -k A^2 / 2, for one wave exactly. 1e-12: trapezoid."""
    waves = one_wave(1.5, 0.2)
    x = np.arange(2000) * (TWO_PI / 0.2 / 2000)
    points = surface_points(waves, x, 0.0, 0.0)
    assert np.mean(points.position[:, 2] * points.jacobian) == pytest.approx(mean_level(waves), rel=1e-12)
    assert mean_level(waves) == pytest.approx(-0.5 * 0.2 * 1.5**2, rel=1e-14)
    above = np.sum(points.jacobian[points.position[:, 2] > 0.0])
    assert above < 0.5 * np.sum(points.jacobian)  # crests are shorter than troughs


def test_the_sum_of_steepnesses_below_one_forbids_folding():
    """Truth: J > 0 everywhere if sum C k A < 1; a single wave of k A = 1.2 folds at its crest."""
    gentle, steep = one_wave(4.9, 0.2), one_wave(6.0, 0.2)
    assert sum_steepness(gentle) < 1.0 < sum_steepness(steep)
    x = np.linspace(0.0, TWO_PI / 0.2, 400)
    assert np.all(surface_points(gentle, x, 0.0, 0.0).jacobian > 0.0)
    folded = surface_points(steep, x, 0.0, 0.0)
    assert folded.jacobian.min() < 0.0
    assert np.all(np.isfinite(folded.slope))


def test_a_flat_sea_is_flat():
    """Truth: without waves every point stays where it is, the normal is up and nothing moves."""
    points = surface_points(discretise(Sea(()), 1.0), X0, Y0, 5.0)
    np.testing.assert_array_equal(points.position, np.stack([X0, Y0, np.zeros(4)], axis=1))
    np.testing.assert_array_equal(points.normal, np.tile([0.0, 0.0, 1.0], (4, 1)))
    np.testing.assert_array_equal(points.velocity, np.zeros((4, 3)))
