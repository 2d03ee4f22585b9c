# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaussian and Gram-Charlier slope densities: moments, sign, clamp and visibility normaliser."""

import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import cox_munk, ross, smith
from ocean_lod_addon.core.optics.mean_fresnel import visible_slopes
from ocean_lod_addon.core.optics.slope_density import (
    GRAM_CHARLIER_WIND_MAX,
    GaussianSlopes,
    GramCharlierSlopes,
    gaussian,
    gram_charlier_factor,
    gram_charlier_masked_area,
    negative_mass,
)
from tests.core.optics_helpers import OPS, cox_munk_sigmas, direction

STEP = 0.02
"""The trapezoidal rule is exact to rounding for a Gaussian times a polynomial at this spacing."""

AXIS = np.arange(-12.0, 12.0 + STEP / 2, STEP)
X, Y = AXIS[:, np.newaxis], AXIS[np.newaxis, :]


def standard_density(U):
    K = gram_charlier_factor(OPS, X, Y, cox_munk.skewness_c21(U), cox_munk.skewness_c03(U))
    return K * gaussian(OPS, X, Y, 1.0, 1.0)


def moment(density, i, j):
    return (density * X**i * Y**j).sum() * STEP**2


@pytest.mark.parametrize("U", [2.0, 10.0, 14.0])
def test_the_series_has_the_moments_it_is_named_after(U):
    p = standard_density(U)
    c21, c03 = cox_munk.skewness_c21(U), cox_munk.skewness_c03(U)
    expected = {
        (0, 0): 1.0,
        (1, 0): 0.0,
        (0, 1): 0.0,
        (2, 0): 1.0,
        (0, 2): 1.0,
        (1, 1): 0.0,
        (3, 0): -c03,
        (1, 2): -c21,
        (4, 0): 3.0 + cox_munk.C04,
        (0, 4): 3.0 + cox_munk.C40,
        (2, 2): 1.0 + cox_munk.C22,
    }
    for (i, j), value in expected.items():
        assert moment(p, i, j) == pytest.approx(value, rel=1e-12, abs=1e-12)


def test_steep_slopes_rise_towards_the_wind_and_the_likeliest_slope_rises_downwind():
    U = 10.0
    p = standard_density(U)
    assert moment(p, 3, 0) > 0.2
    mode_X = AXIS[p[:, len(AXIS) // 2].argmax()]
    assert mode_X == pytest.approx(-0.136, abs=STEP)
    # The same in world terms: dz/dx of the mode, x downwind, through the slope distribution that shading uses.
    sigma_x, sigma_y = cox_munk_sigmas(U)
    slopes = GramCharlierSlopes(sigma_x, sigma_y, wind_speed=U)
    dz_dx = np.linspace(-0.1, 0.1, 2001)
    mode = dz_dx[slopes.density(OPS, -dz_dx, 0.0).argmax()]
    assert mode == pytest.approx(0.024, abs=0.001)  # 1.4 degrees up, going downwind


def test_the_series_is_nowhere_negative_up_to_9_168_metres_per_second():
    # First zero at X = -4.258, Y = 0.
    for U, sign in ((9.167, 1.0), (9.169, -1.0)):
        K = gram_charlier_factor(
            OPS, np.linspace(-4.4, -4.1, 3001), 0.0, cox_munk.skewness_c21(U), cox_munk.skewness_c03(U)
        )
        assert np.sign(K.min()) == sign
        assert np.linspace(-4.4, -4.1, 3001)[K.argmin()] == pytest.approx(-4.258, abs=0.002)


@pytest.mark.parametrize("U", [0.0, 5.0, 9.3, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0])
def test_the_mass_that_the_clamp_adds_is_divided_out(U):
    # 1e-6 is the error of the fit; quadrature next to the edge of the clamp adds a few 1e-8.
    added = -np.minimum(standard_density(U), 0.0).sum() * STEP**2
    assert negative_mass(OPS, U) == pytest.approx(added, abs=1e-6)
    sigma_x, sigma_y = 0.2, 0.15
    p = GramCharlierSlopes(sigma_x, sigma_y, wind_speed=U).density(OPS, sigma_x * X, sigma_y * Y)
    assert p.min() >= 0.0
    assert p.sum() * STEP**2 * sigma_x * sigma_y == pytest.approx(1.0, abs=1.1e-6)


def test_beyond_15_metres_per_second_the_shape_stays():
    tilt = np.linspace(-0.6, 0.6, 101)
    calm, gale = (GramCharlierSlopes(0.2, 0.15, wind_speed=U) for U in (GRAM_CHARLIER_WIND_MAX, 40.0))
    np.testing.assert_array_equal(calm.density(OPS, tilt, 0.1), gale.density(OPS, tilt, 0.1))
    w = direction(1.5, 2.0)
    assert calm.masked_area(OPS, w) == gale.masked_area(OPS, w)


@pytest.mark.parametrize("U", [2.0, 8.0, 14.0])
@pytest.mark.parametrize(("theta", "phi"), [(0.0, 0.0), (1.0, 2.0), (1.45, 0.0), (1.53, 3.0), (1.57, 1.0)])
def test_the_visibility_normaliser_is_the_mean_of_what_faces_the_viewer(U, theta, phi):
    # C(v) = int p max(v.f, 0)/f_z d^2 zeta with the series itself, not its clamped form.
    sigma_x, sigma_y = sigmas = cox_munk_sigmas(U)
    view = direction(theta, phi)
    c21, c03 = cox_munk.skewness_c21(U), cox_munk.skewness_c03(U)
    tilt_x, tilt_y, weight = visible_slopes(view, GaussianSlopes(sigma_x, sigma_y), order=80)
    K = gram_charlier_factor(OPS, tilt_x / sigma_x, tilt_y / sigma_y, c21, c03)
    p = K * gaussian(OPS, tilt_x / sigma_x, tilt_y / sigma_y, sigma_x, sigma_y)
    C = (weight * p * ross.shown_area(OPS, view, (tilt_x, tilt_y))).sum()
    s_v = smith.slope_spread(OPS, view[0], view[1], sigma_x, sigma_y)
    M = smith.masked_area_exact(OPS, view[2], s_v)
    M = gram_charlier_masked_area(OPS, M, view, s_v, sigmas, c21, c03)
    assert view[2] + M == pytest.approx(C, rel=1e-12)


def test_the_gaussian_normaliser_would_be_wrong_for_the_series():
    # THEORY section 5: by up to 2.2 % at 14 m/s, beyond 80 degrees.
    sigma_x, sigma_y = cox_munk_sigmas(14.0)
    view = direction(np.radians(np.linspace(80.0, 89.9, 50))[:, np.newaxis], np.linspace(0.0, np.pi, 37))
    series = view[2] + GramCharlierSlopes(sigma_x, sigma_y, wind_speed=14.0).masked_area(OPS, view)
    normal = view[2] + GaussianSlopes(sigma_x, sigma_y).masked_area(OPS, view)
    assert np.abs(series / normal - 1.0).max() == pytest.approx(0.022, abs=0.002)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_absurd_slopes_have_density_0_and_not_nan(dtype):
    # 2e6 is the steepest half vector that shading forms, the floor the narrowest distribution.
    ops = NumpyOps(dtype)
    sigma, gale = np.full(1, np.sqrt(cox_munk.SLOPE_VARIANCE_FLOOR), dtype), ops.constant(20.0)
    tilt = np.array([-2e6, 2e6, 1e3], dtype)
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        for slopes in (GaussianSlopes(sigma, sigma), GramCharlierSlopes(sigma, sigma, wind_speed=gale)):
            assert np.all(slopes.density(ops, tilt, tilt) == 0.0)
