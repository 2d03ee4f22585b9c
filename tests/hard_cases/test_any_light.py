# SPDX-License-Identifier: GPL-3.0-or-later
"""Any direction of light and view on any roughness: finite, not negative, reciprocal, no more than comes in."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import beckmann, ross
from ocean_lod_addon.core.optics.principal_slopes import principal_slopes
from ocean_lod_addon.core.optics.reflected_share import reflected_share
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes, GramCharlierSlopes, slope_deviation
from ocean_lod_addon.core.optics.smith import slope_spread
from tests.hard_cases.catalogue import FLOAT64_ROUNDING
from tests.hard_cases.strategies import angles, any_settings

OPS, OPS32 = NumpyOps(), NumpyOps(np.float32)

LARGEST_VARIANCE = 0.5
"""Of slopes, per axis: sigma 0.7, which the closures end at; a hurricane has 0.2."""

variances = st.sampled_from([0.0, 1.4e-6, LARGEST_VARIANCE]) | st.floats(-30.0, 0.0).map(
    lambda exponent: LARGEST_VARIANCE * 10.0**exponent
)
elevations = (
    st.sampled_from([0.0, math.pi / 2])
    | st.floats(0.0, math.pi / 2, allow_subnormal=False)  # those have no relative precision
    | st.floats(-12.0, 0.0).map(lambda exponent: 10.0**exponent)
)


def _direction(elevation, azimuth):
    c = math.cos(elevation)
    return np.array([c * math.cos(azimuth), c * math.sin(azimuth), max(math.sin(elevation), 0.0)])


directions = st.builds(_direction, elevations, angles)


@st.composite
def slopes(draw):
    """Gaussian or Gram-Charlier slopes of any variances and wind."""
    sigmas = [slope_deviation(OPS, draw(variances)) for _ in range(2)]
    if draw(st.booleans()):
        return GaussianSlopes(*sigmas)
    return GramCharlierSlopes(*sigmas, wind_speed=draw(st.floats(0.0, 80.0)))


@any_settings
@given(directions, directions, slopes(), st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)) | st.none())
def test_reflected_sun_is_finite_and_not_negative(view, light, slopes, tilt):
    with np.errstate(under="ignore", invalid="raise", over="raise", divide="raise"):
        value = ross.sun_radiance_factor(OPS, view, light, slopes, WATER_REFRACTIVE_INDEX, tilt)
    assert 0.0 <= value < math.inf


@any_settings
@given(directions, directions, slopes())
def test_reflected_sun_is_finite_in_float32(view, light, slopes):
    single = np.float32(view), np.float32(light)
    sigmas = np.float32(slopes.sigma_x), np.float32(slopes.sigma_y)
    value = ross.sun_radiance_factor(OPS32, *single, GaussianSlopes(*sigmas), np.float32(WATER_REFRACTIVE_INDEX))
    assert 0.0 <= value < math.inf


@any_settings
@given(directions, directions, slopes())
def test_light_and_view_can_be_exchanged(view, light, slopes):
    """Truth: Helmholtz: the BRDF is the same both ways; some ten operations, exponents up to 700 times one u.

    BRDF cos theta below the smallest normal number has lost its digits before it is divided by the cosine.
    """
    here = ross.brdf(OPS, view, light, slopes, WATER_REFRACTIVE_INDEX)
    there = ross.brdf(OPS, light, view, slopes, WATER_REFRACTIVE_INDEX)
    lost = 4.0 * np.finfo(float).tiny / max(min(view[2], light[2]), np.finfo(float).tiny)
    assert abs(here - there) <= 2000 * FLOAT64_ROUNDING * max(here, there) + lost


@any_settings
@given(directions, variances, variances)
def test_a_sea_reflects_no_more_than_all_light(view, variance_x, variance_y):
    sigma_x, sigma_y = slope_deviation(OPS, variance_x), slope_deviation(OPS, variance_y)
    s_v = slope_spread(OPS, view[0], view[1], sigma_x, sigma_y)
    share = reflected_share(OPS, view[2], s_v, WATER_REFRACTIVE_INDEX)
    assert 0.0 <= share <= 1.0


@any_settings
@given(variances, variances, angles)
def test_any_tensor_has_axes_and_sockets(major, minor, angle):
    """Truth: variances of a tensor's principal axes are positive, its axis has length 1, sockets are in range."""
    c, s = math.cos(angle), math.sin(angle)
    tensor = major * c * c + minor * s * s, major * s * s + minor * c * c, (major - minor) * c * s
    large, small, x, y = principal_slopes(OPS32, *np.float32(tensor))
    assert 0.0 < small <= large < 1.01
    assert abs(math.hypot(x, y) - 1.0) < 1e-6
    for sockets in (beckmann.metallic_sockets(OPS32, large, small), beckmann.glossy_sockets(OPS32, large, small)):
        assert 0.0 < sockets.roughness <= 1.0
        assert -1.0 <= sockets.anisotropy <= 1.0 + 1e-6
