# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of direction: grazing, at the zenith, from below, from behind."""

import math

import numpy as np

from ocean_lod_addon.core.camera_view import CameraView, nearest_visible_water
from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel, ross
from ocean_lod_addon.core.optics.erf import erfc, erfcx
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes
from ocean_lod_addon.core.optics.smith import a_of_direction, masked_area, masked_area_exact, slope_spread
from tests.hard_cases.catalogue import FLOAT32_ROUNDING, FLOAT64_ROUNDING, hard_case

OPS, OPS32 = NumpyOps(), NumpyOps(np.float32)
SIGMA_X, SIGMA_Y = 0.18, 0.15
COUNT = 100_000


def direction(elevation, azimuth):
    c = np.cos(elevation)
    return np.array([c * np.cos(azimuth), c * np.sin(azimuth), np.sin(elevation)])


def near_specular_pairs(count, lowest=-9.0):
    """Views and lights near their mirror direction, at elevations down to 10^lowest rad and exactly 0."""
    random = np.random.default_rng(4)
    elevation = 10.0 ** random.uniform(lowest, 0.19, count)
    elevation[: count // 100] = 0.0
    azimuth = random.uniform(-np.pi, np.pi, count)
    view = direction(elevation, azimuth)
    other = np.clip(elevation + random.normal(0.0, 0.05, count), 0.0, np.pi / 2)
    light = direction(other, azimuth + np.pi + random.normal(0.0, 0.05, count))
    return view.astype(np.float32), light.astype(np.float32)


def printed_brdf_cos(view, light):
    """Eqs. 13 to 24 with the angles and quotients they are printed with (errors of print mended), any dtype."""
    one = view.dtype.type(1.0)
    variance_x, variance_y = one * SIGMA_X**2, one * SIGMA_Y**2

    def smith(w):
        theta, phi = np.arccos(w[2]), np.arctan2(w[1], w[0])
        along = variance_x * np.cos(phi) ** 2 + variance_y * np.sin(phi) ** 2
        a = (2 * along * np.tan(theta) ** 2) ** -0.5
        root = np.sqrt(one * np.pi)
        return (np.exp(-a * a) - a * root * erfc(a).astype(w.dtype)) / (2 * a * root)

    h = view + light
    h = h / np.sqrt((h * h).sum(axis=0))
    zeta_x, zeta_y = h[0] / h[2], h[1] / h[2]
    p = np.exp(-(zeta_x**2 / variance_x + zeta_y**2 / variance_y) / 2) / (2 * np.pi * SIGMA_X * SIGMA_Y)
    bottom = 4 * h[2] ** 4 * np.cos(np.arccos(view[2])) * (1 + smith(view) + smith(light))
    return p / bottom


@hard_case(
    title="light and view near each other's mirror direction, elevations from 0 on, in float32",
    truth="BRDF cos theta is finite: the masked areas are",
    naive="Eqs. 13 to 24 with their angles",
    error="values that are no number or infinite, share",
    bound=0.0,
    because="no angle, no division by a cosine",
)
def test_grazing_view_and_light_stay_finite():
    view, light = near_specular_pairs(COUNT)
    with np.errstate(all="ignore"):
        naive = printed_brdf_cos(view, light)
        slopes = GaussianSlopes(np.float32(SIGMA_X), np.float32(SIGMA_Y))
        ours = ross.reflection_lobe(OPS32, view, light, ross.half_vector(OPS32, view, light), slopes)
    return tuple(float((~np.isfinite(values)).mean()) for values in (naive, ours))


@hard_case(
    title="the same pairs, where they are bright",
    truth="the same formula in float64 with the exact erfc",
    naive="Eqs. 13 to 24 with their angles",
    error="BRDF cos theta, largest relative error",
    bound=160 * FLOAT32_ROUNDING,
    because="exponents up to 8 have 8 times their few u, (1 + slope^2)^2 four, the rest a few each",
)
def test_grazing_view_and_light_in_float32():
    view, light = near_specular_pairs(COUNT)
    slopes = GaussianSlopes(SIGMA_X, SIGMA_Y, masked_area_exact)
    exact_view, exact_light = view.astype(np.float64), light.astype(np.float64)
    half = ross.half_vector(OPS, exact_view, exact_light)
    truth = ross.reflection_lobe(OPS, exact_view, exact_light, half, slopes)
    X, Y = half.tilt_x / SIGMA_X, half.tilt_y / SIGMA_Y
    bright = (X * X + Y * Y < 16.0) & (truth > 0.0)
    slopes32 = GaussianSlopes(np.float32(SIGMA_X), np.float32(SIGMA_Y))
    ours = ross.reflection_lobe(OPS32, view, light, ross.half_vector(OPS32, view, light), slopes32)
    with np.errstate(all="ignore"):
        naive = np.abs(printed_brdf_cos(view, light)[bright] / truth[bright] - 1.0)
    naive = np.max(naive[np.isfinite(naive)])
    return float(naive), float(np.abs(ours[bright] / truth[bright] - 1.0).max())


@hard_case(
    title="the zenith: tan theta = 0",
    truth="nothing is masked: M = 0",
    naive="Lambda(a), a = [2 sigma^2 tan^2 theta]^(-1/2)",
    error="masked area",
    bound=0.0,
    because="exp(-c^2 / 2) of c = 1e15 is 0; the slope spread is kept above 0",
)
def test_the_zenith():
    with np.errstate(all="ignore"):
        a = a_of_direction(0.0, 0.0, SIGMA_X**2, SIGMA_Y**2)
        naive = (np.exp(-a * a) - a * np.sqrt(np.pi) * erfc(a)) / (2 * a * np.sqrt(np.pi))
    return float(abs(naive)), float(masked_area(OPS, 1.0, slope_spread(OPS, 0.0, 0.0, SIGMA_X, SIGMA_Y)))


@hard_case(
    title="exact grazing: Lambda at a = 0",
    truth="cos theta Lambda -> sigma / sqrt(2 pi)",
    naive="cos theta times Lambda(a)",
    error="masked area, relative",
    bound=2e-7,
    because="the polynomial for erfc is within 1.5e-7",
)
def test_exact_grazing():
    s = slope_spread(OPS, 1.0, 0.0, SIGMA_X, SIGMA_Y)
    truth = SIGMA_X / math.sqrt(2.0 * math.pi)
    with np.errstate(all="ignore"):
        a = np.float64(0.0)
        naive = 0.0 * (np.exp(-a * a) - a * np.sqrt(np.pi) * erfc(a)) / (2 * a * np.sqrt(np.pi))
    return float(abs(naive / truth - 1.0)), float(abs(masked_area(OPS, 0.0, s) / truth - 1.0))


@hard_case(
    title="89.99 degrees from the zenith",
    truth="cos theta (1 + Lambda), exact",
    naive="cosines clamped at 0.01, as one shader does",
    error="shown area, relative",
    bound=2e-7,
    because="the polynomial for erfc is within 1.5e-7",
)
def test_almost_grazing():
    w_z = math.cos(math.radians(89.99))

    def shown(z, form):
        x = math.sqrt(1.0 - z * z)
        return z + form(OPS, z, slope_spread(OPS, x, 0.0, SIGMA_X, SIGMA_Y))

    truth = shown(w_z, masked_area_exact)
    return abs(shown(0.01, masked_area_exact) / truth - 1.0), float(abs(shown(w_z, masked_area) / truth - 1.0))


@hard_case(
    title="Lambda far from grazing: exp(a^2) erfc(a) at a = 30",
    truth="its asymptotic series, 0.018795888861416751",
    naive="the product",
    error="relative",
    bound=8 * FLOAT64_ROUNDING,
    because="13 positive terms",
)
def test_erfc_under_and_overflow():
    truth = 0.018795888861416751
    with np.errstate(all="ignore"):
        naive = np.exp(np.float64(30.0) ** 2) * erfc(30.0)
    return float(abs(naive / truth - 1.0)), float(abs(erfcx(30.0) / truth - 1.0))


@hard_case(
    title="light and view exactly opposite on the horizon: no half vector",
    truth="nothing is reflected",
    naive="h = (v + l) / |v + l|",
    error="BRDF cos theta",
    bound=0.0,
    because="h_z is held at 1e-6, where the density is 0",
)
def test_no_half_vector():
    view, light = np.array([1.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0])
    slopes = GaussianSlopes(SIGMA_X, SIGMA_Y)
    with np.errstate(all="ignore"):
        naive = printed_brdf_cos(view, light)
    return float(abs(naive)), abs(float(ross.brdf_cos(OPS, view, light, slopes, WATER_REFRACTIVE_INDEX)))


@hard_case(
    title="light or view from below",
    truth="the model ends at the horizon: 0",
    naive="Eqs. 13 to 24, whatever the sign of the cosine",
    error="largest BRDF cos theta",
    bound=0.0,
    because="0 by definition",
)
def test_from_below():
    random = np.random.default_rng(5)
    view, light = random.normal(size=(2, 3, 10_000))
    view, light = (w / np.sqrt((w * w).sum(axis=0)) for w in (view, light))
    view[2] = -np.abs(view[2])
    slopes = GaussianSlopes(SIGMA_X, SIGMA_Y)
    ours = ross.brdf_cos(OPS, view, light, slopes, WATER_REFRACTIVE_INDEX)
    other = ross.brdf_cos(OPS, light, view, slopes, WATER_REFRACTIVE_INDEX)
    with np.errstate(all="ignore"):
        naive = np.abs(printed_brdf_cos(view, light))
    return float(naive[np.isfinite(naive)].max()), float(max(np.abs(ours).max(), np.abs(other).max()))


@hard_case(
    title="back-facing micro-normals: the resolved slope faces away from a grazing view",
    truth="a reflectance is finite and not negative",
    naive="1 + Lambda_v + Lambda_l of cosines as they come",
    error="values that are negative or no number, share",
    bound=0.0,
    because="shown areas are held at 0",
)
def test_back_facing_normals():
    random = np.random.default_rng(6)
    tilt = random.normal(0.0, 0.3, (2, 20_000))
    view, light = direction(0.05, 0.0), direction(0.4, np.pi)
    slopes = GaussianSlopes(SIGMA_X, SIGMA_Y)
    half = ross.half_vector(OPS, view, light)
    ours = ross.reflection_lobe(OPS, view, light, half, slopes, tilt)
    shown = [ross.shown_area(OPS, w, tilt) for w in (view, light)]
    lambdas = []
    with np.errstate(all="ignore"):
        for w, z in zip((view, light), shown, strict=True):
            a = z / (math.sqrt(2.0) * abs(w[0]) * SIGMA_X)
            lambdas.append((np.exp(-a * a) - a * np.sqrt(np.pi) * erfc(a)) / (2 * a * np.sqrt(np.pi)))
        p = slopes.density(OPS, half.tilt_x - tilt[0], half.tilt_y - tilt[1])
        naive = p * half.secant2**2 / (4.0 * shown[0] * (1.0 + lambdas[0] + lambdas[1]))
    return tuple(float((~(values >= 0.0) | np.isinf(values)).mean()) for values in (naive, ours))


@hard_case(
    title="Fresnel at normal and at grazing incidence",
    truth="((n - 1) / (n + 1))^2 and 1",
    naive="sines and tangents of angle sums",
    error="reflectance",
    bound=8 * FLOAT64_ROUNDING,
    because="no denominator vanishes: sqrt(n^2 - 1 + c^2) is above 0.88",
)
def test_fresnel_at_its_ends():
    n, c = WATER_REFRACTIVE_INDEX, np.array([1.0, 0.0])
    truth = np.array([fresnel.normal_incidence(n), 1.0])
    with np.errstate(all="ignore"):
        i = np.arccos(c)
        t = np.arcsin(np.sin(i) / n)
        naive = 0.5 * ((np.sin(i - t) / np.sin(i + t)) ** 2 + (np.tan(i - t) / np.tan(i + t)) ** 2)
    return float(np.abs(naive - truth).max()), float(np.abs(fresnel.exact(OPS, c, n) - truth).max())


@hard_case(
    title="a camera that looks level: its frame meets the water at infinity",
    truth="the nearest water is on a ray that sinks",
    naive="the frame's centre ray, met with the plane z = 0",
    error="distance of the point from the camera, m (0 where it is finite and ahead)",
    bound=0.0,
    because="rays that sink less than 1e-6 never reach the water",
)
def test_a_level_camera():
    view = CameraView(np.array([0.0, 0.0, 2.0]), np.eye(3)[[1, 2, 0]], (-0.3, 0.3, -0.2, 0.2))
    with np.errstate(all="ignore"):
        naive = np.abs(-view.position[2] / view.axes[2][2] * view.axes[2][0])
    point = nearest_visible_water(view)
    return float(naive), 0.0 if np.isfinite(point).all() and point[0] > 0.0 else float("inf")
