# SPDX-License-Identifier: GPL-3.0-or-later
"""The reflectance of a rough sea, averaged over visible slopes: reference and fit."""

import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel
from ocean_lod_addon.core.optics.mean_fresnel import (
    mean_fresnel,
    mean_fresnel_bruneton,
    mean_over_visible_slopes,
)
from ocean_lod_addon.core.optics.smith import slope_spread
from tests.core.optics_helpers import OPS, SEAS, WATER, direction, exact_slopes


def exact(c):
    return fresnel.exact(OPS, c, WATER)


def fit(theta, sigma_v):
    return mean_fresnel(OPS, np.cos(theta), np.sin(theta) * sigma_v, WATER)


@pytest.mark.parametrize("sea", SEAS)
@pytest.mark.parametrize("degrees", [0.0, 40.0, 75.0, 85.0, 89.9, 90.0])
def test_the_mean_of_a_constant_is_the_constant(sea, degrees):
    view = direction(np.radians(degrees), 0.6)
    mean = mean_over_visible_slopes(OPS, lambda c: 0.5 + 0.0 * c, view, exact_slopes(*SEAS[sea]))
    assert mean == pytest.approx(0.5, abs=1e-12)


def test_the_quadrature_has_converged():
    for degrees in (0.0, 60.0, 85.0, 89.9):
        view, slopes = direction(np.radians(degrees), 1.0), exact_slopes(*SEAS["rough"])
        coarse, fine = (mean_over_visible_slopes(OPS, exact, view, slopes, order) for order in (64, 160))
        assert coarse == pytest.approx(fine, rel=1e-9)


def test_the_fit_is_as_good_as_it_says():
    errors = []
    for sigma_v in (0.005, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3):
        for ratio in (0.8, 1.0, 1.25):
            slopes = exact_slopes(sigma_v**2, (ratio * sigma_v) ** 2)
            for cos_view in np.concatenate([[0.0, 0.01, 0.03], np.linspace(0.05, 1.0, 20)]):
                view = direction(np.arccos(cos_view), 0.0)
                mean = mean_over_visible_slopes(OPS, exact, view, slopes, order=40)
                errors.append(fit(np.arccos(cos_view), sigma_v) - mean)
    errors = np.array(errors)
    assert np.abs(errors).max() < 0.0095
    assert np.sqrt(np.mean(errors**2)) < 0.0032


def test_a_smooth_sea_reflects_like_a_mirror_and_rough_seas_stay_sane():
    theta = np.linspace(0.0, np.pi / 2, 200)
    np.testing.assert_allclose(fit(theta, 1e-4), exact(np.cos(theta)), atol=1e-3)  # dF/dcos = 6.3, times 1.3e-4
    assert fit(np.pi / 2, 0.0) == pytest.approx(1.0, abs=1e-5)
    for sigma_v in (0.4, 0.5, 0.7):
        rough = fit(theta, sigma_v)
        assert np.all((rough >= exact(1.0) - 1e-15) & (rough <= 0.2))


def test_the_fit_takes_what_the_shader_has_in_float32():
    ops = NumpyOps(np.float32)
    z = np.linspace(0.0, 1.0, 1001, dtype=np.float32)
    x, zero, sigma = np.sqrt(1.0 - z * z), np.zeros_like(z), np.full(1, 0.178, np.float32)
    single = mean_fresnel(ops, z, slope_spread(ops, x, zero, sigma, sigma), np.float32(WATER))
    assert single.dtype == np.float32
    reference = fit(np.arccos(z.astype(float)), 0.178)
    np.testing.assert_allclose(single, reference, rtol=3e-6)


def test_brunetons_fit_is_of_schlicks_mean_and_off_the_exact_one():
    # sigma_v = 0.05 at 89.5 degrees: 0.772 against 0.677.
    view = direction(np.radians(89.5), 0.0)
    bruneton = mean_fresnel_bruneton(OPS, view[2], 0.05, WATER)
    mean = mean_over_visible_slopes(OPS, exact, view, exact_slopes(0.0025, 0.0025))
    assert (bruneton, mean) == pytest.approx((0.772, 0.677), abs=1e-3)
    assert abs(fit(np.radians(89.5), 0.05) - mean) < 0.0095
