# SPDX-License-Identifier: GPL-3.0-or-later
"""The Ross BRDF: it neither makes nor loses light, in float64 and float32, at every angle."""

import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel, ross
from ocean_lod_addon.core.optics.cox_munk import SLOPE_VARIANCE_FLOOR
from ocean_lod_addon.core.optics.mean_fresnel import visible_slopes
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes, GramCharlierSlopes
from ocean_lod_addon.core.optics.smith import masked_area_exact
from tests.core.optics_helpers import (
    OPS,
    SEAS,
    WATER,
    cox_munk_sigmas,
    direction,
    exact_slopes,
    mirrored,
    random_directions,
)

DEGREES = [0.0, 0.01, 10.0, 30.0, 45.0, 60.0, 75.0, 80.0, 85.0, 88.0, 89.0, 89.9]


def lobe_of(view, light, slopes, tilt=None, ops=OPS):
    return ross.reflection_lobe(ops, view, light, ross.half_vector(ops, view, light), slopes, tilt)


# Conservation


@pytest.mark.parametrize("degrees", DEGREES)
@pytest.mark.parametrize("sea", SEAS)
def test_visible_slopes_are_a_probability_density(sea, degrees):
    # Eq. 21. The issue asks for 1e-6; with the kink on an edge the quadrature is exact to rounding.
    view, slopes = direction(np.radians(degrees), np.radians(35.0)), exact_slopes(*SEAS[sea])
    tilt_x, tilt_y, weight = visible_slopes(view, slopes)
    total = (weight * ross.visible_slope_density(OPS, (tilt_x, tilt_y), view, slopes)).sum()
    assert total == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("degrees", [0.0, 45.0, 75.0, 85.0, 89.9])
@pytest.mark.parametrize("U", [5.0, 9.0])
def test_visible_slopes_of_the_series_are_a_probability_density_as_well(U, degrees):
    # Below 9.168 m/s, where nothing is clamped; 1e-7 is the Abramowitz-Stegun erfc in use here.
    sigma_x, sigma_y = cox_munk_sigmas(U)
    view, slopes = direction(np.radians(degrees), 2.5), GramCharlierSlopes(sigma_x, sigma_y, wind_speed=U)
    tilt_x, tilt_y, weight = visible_slopes(view, slopes)
    total = (weight * ross.visible_slope_density(OPS, (tilt_x, tilt_y), view, slopes)).sum()
    assert total == pytest.approx(1.0, abs=3e-7)


def test_light_and_viewer_may_be_exchanged():
    # 1e5 pairs, half of them near the mirror direction. 1e-12: each side rounds differently, about 1e-15, and
    # the exponent of at most 700 multiplies that.
    rng = np.random.default_rng(3)
    view = random_directions(rng, 100_000)
    light = random_directions(rng, 100_000)
    near = mirrored(view, rng.normal(0.0, 0.2, 100_000), rng.normal(0.0, 0.2, 100_000))
    use = (np.arange(100_000) % 2 == 0) & (near[2] > 1e-3)
    light = tuple(np.where(use, a, b) for a, b in zip(near, light, strict=True))
    above = (view[2] > 0.0) & (light[2] > 0.0)
    for slopes in (exact_slopes(*SEAS["10 m/s"]), GaussianSlopes(0.3, 0.1)):
        one, other = ross.brdf(OPS, view, light, slopes, WATER), ross.brdf(OPS, light, view, slopes, WATER)
        np.testing.assert_allclose(one[above], other[above], rtol=1e-12, atol=1e-200)


def albedo_over_directions(view, slopes, order=400):
    """int BRDF cos theta_l d omega_l with F = 1 over the upper hemisphere."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    z = (0.5 * (nodes + 1.0) ** 2 / 2.0)[:, np.newaxis]  # finer towards the horizon
    dz = (0.5 * weights * (nodes + 1.0))[:, np.newaxis]
    phi = np.linspace(0.0, 2.0 * np.pi, 2 * order, endpoint=False)[np.newaxis, :]
    r = np.sqrt(1.0 - z * z)
    light = r * np.cos(phi), r * np.sin(phi), np.broadcast_to(z, (order, 2 * order))
    return (lobe_of(view, light, slopes) * dz).sum() * np.pi / order


def albedo_over_slopes(view, slopes):
    """The same integral taken over the facets, which needs no Jacobian: int q(zeta, v, l(zeta)) d^2 zeta."""
    tilt_x, tilt_y, weight = visible_slopes(view, slopes, order=200)
    light = mirrored(view, tilt_x, tilt_y)
    above = light[2] > 0.0
    lit = tuple(np.where(above, component, 1.0) for component in light)
    q = ross.visible_slope_density(OPS, (tilt_x, tilt_y), view, slopes, lit)
    return (weight * np.where(above, q, 0.0)).sum()


FURNACE = [
    (0.0, "10 m/s", 1.00000),
    (45.0, "10 m/s", 0.98915),
    (60.0, "10 m/s", 0.95272),
    (75.0, "10 m/s", 0.90741),
    (85.0, "10 m/s", 0.94002),
    (89.0, "10 m/s", 0.98499),
    (45.0, "20 m/s", 0.95298),
    (75.0, "20 m/s", 0.90453),
    (80.0, "20 m/s", 0.92103),
]


@pytest.mark.parametrize(("degrees", "sea", "albedo"), FURNACE)
def test_white_furnace(degrees, sea, albedo):
    # The documented albedos are for a view 0.6 rad from the wind. Integrating over directions (with the Jacobian
    # of Eq. 23 in the BRDF) and over facets (without) must agree; kinks at the horizon cost 1e-4.
    view, slopes = direction(np.radians(degrees), 0.6), exact_slopes(*SEAS[sea])
    directions, facets = albedo_over_directions(view, slopes), albedo_over_slopes(view, slopes)
    assert directions == pytest.approx(facets, abs=2e-4)
    assert facets == pytest.approx(albedo, abs=2e-4)


@pytest.mark.parametrize("sea", SEAS)
@pytest.mark.parametrize("phi", [0.0, 0.9, np.pi / 2])
def test_no_more_light_comes_back_than_went_in(sea, phi):
    # 1e-7 for the Abramowitz-Stegun erfc that shading uses.
    slopes = GaussianSlopes(*np.sqrt(SEAS[sea]))
    for degrees in (0.0, 20.0, 50.0, 70.0, 80.0, 86.0, 89.0, 89.9, 89.999):
        albedo = albedo_over_slopes(direction(np.radians(degrees), phi), slopes)
        assert 0.7 < albedo <= 1.0 + 1e-7


# Hard cases


@pytest.mark.parametrize("sea", SEAS)
def test_straight_down_the_brdf_is_the_density_over_four(sea):
    # theta = 0: nothing is hidden, h = z.
    up = (0.0, 0.0, 1.0)
    sigma_x, sigma_y = np.sqrt(SEAS[sea])
    expected = 1.0 / (2.0 * np.pi * sigma_x * sigma_y) * ((WATER - 1) / (WATER + 1)) ** 2 / 4.0
    assert ross.brdf(OPS, up, up, GaussianSlopes(sigma_x, sigma_y), WATER) == pytest.approx(expected, rel=1e-14)


def test_light_and_viewer_below_the_horizon_see_nothing():
    slopes = GaussianSlopes(0.2, 0.2)
    up, below, horizon = (0.0, 0.0, 1.0), direction(1.7, 0.3), (1.0, 0.0, 0.0)
    for view, light in ((up, below), (below, up), (up, horizon), (horizon, up), (below, below)):
        assert ross.brdf_cos(OPS, view, light, slopes, WATER) == 0.0
        assert ross.brdf(OPS, view, light, slopes, WATER) == 0.0


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_opposite_grazing_directions_are_finite(dtype):
    # l = -v: the half vector vanishes.
    ops = NumpyOps(dtype)
    phi = np.linspace(0.0, 6.0, 7).astype(dtype)
    v = np.cos(phi), np.sin(phi), np.zeros_like(phi)
    opposite = -v[0], -v[1], v[2]
    sigma, gale = np.full(1, np.sqrt(SLOPE_VARIANCE_FLOOR), dtype), ops.constant(20.0)
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        for slopes in (GaussianSlopes(sigma, sigma), GramCharlierSlopes(sigma, sigma, wind_speed=gale)):
            for light in (opposite, v):
                factor = ross.sun_radiance_factor(ops, v, light, slopes, dtype(WATER))
                assert factor.dtype == dtype
                assert np.all(factor == 0.0)


def test_the_sun_fades_in_without_a_step_at_the_horizon():
    view, slopes = direction(1.2, 0.0), GaussianSlopes(0.18, 0.15)
    heights = np.array([-1e-3, -1e-9, 0.0, 1e-9, 1e-6])
    light = -np.sqrt(1.0 - heights**2), 0.0 * heights, heights
    factor = ross.sun_radiance_factor(OPS, view, light, slopes, WATER)
    assert np.all(factor[:3] == 0.0)
    assert np.all(np.diff(factor[2:]) > 0.0)
    assert factor[-1] < 1e-4


def test_a_view_past_grazing_keeps_the_value_of_grazing():
    slopes, light = GaussianSlopes(0.18, 0.15), direction(1.3, np.pi)
    tilt = np.array([-0.0999999, -0.1, -0.1000001, -0.2]), np.zeros(4)
    view = direction(np.arctan(10.0), 0.0)  # the second surface is exactly edge on
    factor = ross.sun_radiance_factor(OPS, view, light, slopes, WATER, tilt)
    assert np.all(np.isfinite(factor))
    assert factor[0] == pytest.approx(factor[1], rel=1e-4)
    assert factor[2] == pytest.approx(factor[1], rel=1e-4)
    assert factor[3] > 0.0


# Precision

VISIBLE = 1e-9
"""1/sr. Metric for float32: the error of what is rendered, BRDF cos theta_l with F in it (the sun's radiance
factor), relative where it exceeds this and absolute, 1e-14, below. There a sun of 1000 W/m^2 gives 1e-6 W/m^2/sr,
a ten-millionth of a dim sky, and the exponential multiplies the rounding of its argument by 20 and more."""


@pytest.mark.parametrize("grazing", [False, True], ids=["uniform", "grazing"])
@pytest.mark.parametrize("sea", [*SEAS, "floor"])
def test_float32_is_within_1e_5_of_float64_and_never_nan(sea, grazing):
    variances = SEAS.get(sea, (SLOPE_VARIANCE_FLOOR, SLOPE_VARIANCE_FLOOR))
    rng = np.random.default_rng(11)
    count = 100_000
    view, light = random_directions(rng, count, grazing), random_directions(rng, count, grazing)
    near = mirrored(view, *(rng.normal(0.0, np.sqrt(variance), count) for variance in variances))
    use = (np.arange(count) % 2 == 1) & (near[2] >= 0.0)
    light = tuple(np.where(use, a, b) for a, b in zip(near, light, strict=True))
    view, light = (tuple(component.astype(np.float32) for component in w) for w in (view, light))
    assert (view[2] == 0.0).sum() > 1000

    def factor(dtype, masked_area):
        sigmas = (np.full(1, np.sqrt(variance), dtype=np.float32).astype(dtype) for variance in variances)
        arguments = (tuple(component.astype(dtype) for component in w) for w in (view, light))
        slopes = GaussianSlopes(*sigmas, masked_area)
        return ross.sun_radiance_factor(NumpyOps(dtype), *arguments, slopes, dtype(np.float32(WATER)))

    with np.errstate(over="raise", invalid="raise", divide="raise"):
        single = factor(np.float32, GaussianSlopes(1.0, 1.0).smith_masked_area)
    reference = factor(np.float64, masked_area_exact)
    assert single.dtype == np.float32
    assert np.all(np.isfinite(single))
    visible = reference > VISIBLE
    assert visible.sum() > 10_000
    np.testing.assert_allclose(single[visible], reference[visible], rtol=1e-5)
    np.testing.assert_allclose(single[~visible], reference[~visible], rtol=0.0, atol=1e-14)


def test_the_series_in_float32_is_finite_and_as_precise_where_it_is_not_cut():
    # Where K crosses 0 a relative error means nothing: the error is measured against the Gaussian lobe, times
    # the 60 that the terms of K reach before they cancel where the lobe is still visible (|X| < 6).
    rng = np.random.default_rng(12)
    view, light = random_directions(rng, 100_000), random_directions(rng, 100_000)
    results = {}
    for dtype in (np.float32, np.float64):
        ops = NumpyOps(dtype)
        arguments = [tuple(component.astype(np.float32).astype(dtype) for component in w) for w in (view, light)]
        sigmas = np.full(1, 0.2, np.float32).astype(dtype), np.full(1, 0.15, np.float32).astype(dtype)
        with np.errstate(over="raise", invalid="raise", divide="raise"):
            series = ross.sun_radiance_factor(
                ops, *arguments, GramCharlierSlopes(*sigmas, wind_speed=np.full(1, 12, dtype)), dtype(WATER)
            )
            normal = ross.sun_radiance_factor(ops, *arguments, GaussianSlopes(*sigmas), dtype(WATER))
        results[dtype] = series, normal
    error = np.abs(results[np.float32][0] - results[np.float64][0])
    assert np.all(np.isfinite(results[np.float32][0]))
    visible = results[np.float64][1] > VISIBLE
    assert np.all(error[visible] < 60e-5 * results[np.float64][1][visible])
    assert np.median(error[visible] / results[np.float64][1][visible]) < 1e-6


# Resolved waves and axes


def test_no_tilt_is_a_flat_surface():
    rng = np.random.default_rng(1)
    view, light = random_directions(rng, 1000), random_directions(rng, 1000)
    slopes = GaussianSlopes(0.18, 0.15)
    zero = np.zeros(1000)
    flat = ross.sun_radiance_factor(OPS, view, light, slopes, WATER)
    np.testing.assert_array_equal(
        ross.sun_radiance_factor(OPS, view, light, slopes, WATER, (zero, zero)), flat
    )
    normal = (zero, zero, zero + 1.0)
    assert np.all(np.array(ross.tilt_of_normal(OPS, normal)) == 0.0)


@pytest.mark.parametrize(("theta_v", "theta_l"), [(0.0, 0.5), (0.9, 0.8), (1.1, 1.0)])
def test_geometry_and_brdf_share_the_variance_without_a_trace(theta_v, theta_l):
    # Far from grazing nothing is hidden, and averaging the BRDF of half of the slopes over the other half drawn
    # as geometry, by area shown to the viewer, is the BRDF of all of them. 1e-6 is the little that is hidden.
    view, light = direction(theta_v, 0.3), direction(theta_l, 3.0)
    sigma_x, sigma_y = 0.10, 0.08
    drawn_x, drawn_y = 0.06, 0.05
    left = GaussianSlopes(np.sqrt(sigma_x**2 - drawn_x**2), np.sqrt(sigma_y**2 - drawn_y**2), masked_area_exact)
    nodes, weights = np.polynomial.hermite_e.hermegauss(40)
    tilt = drawn_x * nodes[:, np.newaxis], drawn_y * nodes[np.newaxis, :]
    area = np.outer(weights, weights) * ross.shown_area(OPS, view, tilt)
    mean = (area * ross.sun_radiance_factor(OPS, view, light, left, WATER, tilt)).sum() / area.sum()
    whole = exact_slopes(sigma_x**2, sigma_y**2)
    assert mean == pytest.approx(ross.sun_radiance_factor(OPS, view, light, whole, WATER), rel=1e-6)


def test_the_tilt_of_a_normal_is_minus_its_slope_and_survives_overhangs():
    slope = np.array([[0.3], [-0.2]])
    normal = np.array([-slope[0], -slope[1], [1.0]]) / np.sqrt(1.0 + (slope**2).sum())
    np.testing.assert_allclose(ross.tilt_of_normal(OPS, normal), -slope, rtol=1e-15)
    overhang = ross.tilt_of_normal(OPS, np.array([[0.9], [0.3], [-0.3]]))
    assert np.all(np.isfinite(overhang))


def test_only_the_wind_tells_the_axes_apart():
    # Turning wind, light and viewer together changes nothing; turning the wind alone does.
    rng = np.random.default_rng(2)
    view, light = random_directions(rng, 500), random_directions(rng, 500)
    slopes, angle = GramCharlierSlopes(0.25, 0.1, wind_speed=12.0), 0.7

    def turned(w):
        c, s = np.cos(angle), np.sin(angle)
        return c * w[0] - s * w[1], s * w[0] + c * w[1], w[2]

    def factor(view, light, wind_x, wind_y):
        axes = (ross.to_wind_axes(OPS, w, wind_x, wind_y) for w in (view, light))
        return ross.sun_radiance_factor(OPS, *axes, slopes, WATER)

    upright = factor(view, light, 1.0, 0.0)
    wind = np.cos(angle), np.sin(angle)
    np.testing.assert_allclose(factor(turned(view), turned(light), *wind), upright, rtol=1e-10, atol=1e-30)
    assert np.abs(factor(view, light, *wind) - upright).max() > 0.01


def test_a_tangent_frame_agrees_where_it_lies_flat_and_only_there():
    view, light, slopes = direction(0.8, 0.4), direction(0.7, 3.2), GaussianSlopes(0.2, 0.1, masked_area_exact)

    def in_frame(*axes):
        frame = ([np.dot(axis, w) for axis in axes] for w in (view, light))
        return ross.sun_radiance_factor(OPS, *frame, slopes, WATER)

    wind = np.cos(0.5), np.sin(0.5)
    axes = (ross.to_wind_axes(OPS, w, *wind) for w in (view, light))
    flat = in_frame((*wind, 0.0), (-wind[1], wind[0], 0.0), (0.0, 0.0, 1.0))
    assert flat == pytest.approx(ross.sun_radiance_factor(OPS, *axes, slopes, WATER), rel=1e-14)
    tilt = 0.2
    length = np.hypot(1.0, tilt)
    normal, tangent = (tilt / length, 0.0, 1.0 / length), (1.0 / length, 0.0, -tilt / length)
    additive = ross.sun_radiance_factor(OPS, view, light, slopes, WATER, (tilt, 0.0))
    assert in_frame(tangent, (0.0, 1.0, 0.0), normal) != pytest.approx(additive, rel=0.01)


def test_the_lee_faces_of_waves_are_the_steep_ones():
    # Looking straight down, the sun 50 degrees off: only facets tilted by 25 degrees (2.6 sigma) towards the sun
    # mirror it. Those tilted downwind rise into the wind and are the likelier ones (E[X^3] > 0).
    sigma_x, sigma_y = cox_munk_sigmas(10.0)
    slopes = GramCharlierSlopes(sigma_x, sigma_y, wind_speed=10.0)
    up, theta = (0.0, 0.0, 1.0), np.radians(50.0)
    sun_downwind = ross.sun_radiance_factor(OPS, up, direction(theta, 0.0), slopes, WATER)
    sun_upwind = ross.sun_radiance_factor(OPS, up, direction(theta, np.pi), slopes, WATER)
    assert sun_downwind > 1.3 * sun_upwind


def test_the_sun_factor_is_lobe_times_fresnel_at_the_half_vector():
    view, light, slopes = direction(1.2, 0.2), direction(1.1, 3.1), GaussianSlopes(0.18, 0.15)
    v, w = np.array(view), np.array(light)
    h = (v + w) / np.linalg.norm(v + w)
    expected = lobe_of(view, light, slopes) * fresnel.exact(OPS, v @ h, WATER)
    assert ross.sun_radiance_factor(OPS, view, light, slopes, WATER) == pytest.approx(expected, rel=1e-13)
