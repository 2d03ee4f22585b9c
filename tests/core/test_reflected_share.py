# SPDX-License-Identifier: GPL-3.0-or-later
"""What a rough sea reflects of the sky, how much and from where: by quadrature and by the fits of shading."""

import itertools
import math

import numpy as np
import pytest

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel
from ocean_lod_addon.core.optics.mean_fresnel import mean_over_visible_slopes
from ocean_lod_addon.core.optics.reflected_share import (
    reflected_light_reference,
    reflected_share,
    sine_of_source,
    source_variance,
)
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes
from ocean_lod_addon.core.optics.smith import masked_area_exact, slope_spread

OPS = NumpyOps()


def slopes_of(sigma_x, sigma_y):
    return GaussianSlopes(sigma_x, sigma_y, smith_masked_area=masked_area_exact)


def view_at(degrees):
    return math.sin(math.radians(degrees)), 0.0, math.cos(math.radians(degrees))


@pytest.mark.parametrize(
    ("degrees", "share"), [(0, 0.02043), (60, 0.05556), (75, 0.12530), (85, 0.23580), (89.5, 0.32192)]
)
def test_reference_is_the_single_scattering_albedo(degrees, share):
    """Truth: THEORY section 7, last column, wind 10 m/s seen along the wind; those numbers and this quadrature
    both cut through the facets that mirror the view exactly to the horizon, at 5e-5."""
    slopes = slopes_of(math.sqrt(0.0316), math.sqrt(0.0222))
    reference = reflected_light_reference(OPS, view_at(degrees), slopes, WATER_REFRACTIVE_INDEX, order=96)
    assert reference.share == pytest.approx(share, abs=6e-5)


def seas():
    """The directions and slopes that the fits are promised for, with their quadrature."""
    angles = (0.0, 30.0, 50.0, 65.0, 75.0, 81.0, 85.0, 88.0, 89.5)
    for sigma, across, degrees in itertools.product((0.02, 0.05, 0.1, 0.17, 0.23, 0.3), (0.8, 1.0, 1.25), angles):
        slopes, view = slopes_of(sigma, sigma * across), view_at(degrees)
        s_v = slope_spread(OPS, view[0], view[1], slopes.sigma_x, slopes.sigma_y)
        yield slopes, view[2], s_v, reflected_light_reference(OPS, view, slopes, WATER_REFRACTIVE_INDEX)


def test_fits_keep_their_promises():
    """Truth: the quadrature; the promises are those of the docstrings."""
    for slopes, cosine, s_v, light in seas():
        x, _, z = light.mean_direction
        length = math.hypot(x, z)
        assert reflected_share(OPS, cosine, s_v, WATER_REFRACTIVE_INDEX) == pytest.approx(light.share, rel=0.06)
        elevation = math.degrees(math.asin(sine_of_source(OPS, cosine, s_v)))
        if cosine < 1.0:
            assert elevation == pytest.approx(math.degrees(math.atan2(z, -x)), abs=4.2)
        if slopes.sigma_x >= 0.05:
            variance = source_variance(OPS, cosine, slopes.sigma_x * slopes.sigma_y)
            assert variance == pytest.approx(1.0 - length, rel=0.42)


def test_never_more_than_the_mean_fresnel_reflectance():
    slopes = slopes_of(0.2, 0.15)
    for degrees in (0.0, 45.0, 70.0, 85.0, 89.9):
        view = view_at(degrees)
        mean = mean_over_visible_slopes(OPS, lambda c: fresnel.exact(OPS, c, WATER_REFRACTIVE_INDEX), view, slopes)
        assert reflected_light_reference(OPS, view, slopes, WATER_REFRACTIVE_INDEX).share <= mean * (1.0 + 1e-12)


def test_shares_stay_shares_in_float32_everywhere():
    """Including the zenith, exact grazing and a sea as smooth as the floor allows."""
    rng = np.random.default_rng(8)
    ops = NumpyOps(np.float32)
    cosine = np.concatenate([rng.uniform(0.0, 1.0, 20000), [0.0, 1.0, 1e-7, 1.0 - 1e-7]]).astype(np.float32)
    sigma = 10.0 ** rng.uniform(-3.0, -0.3, cosine.size).astype(np.float32)
    s_v = slope_spread(ops, np.sqrt(1 - cosine * cosine), np.float32(0.0), sigma, sigma)
    for share in (
        reflected_share(ops, cosine, s_v, WATER_REFRACTIVE_INDEX),
        sine_of_source(ops, cosine, s_v),
        source_variance(ops, cosine, sigma * sigma),
    ):
        assert np.all(np.isfinite(share))
        assert np.all((share >= 0.0) & (share <= 1.0))
