# SPDX-License-Identifier: GPL-3.0-or-later
"""Knobs of shading, evaluated by NumPy over many shading points at once.

A graphics processor or Cycles takes other times than NumPy, but in the same order: the time of a formula is that
of its operations.
"""

import functools
import math

import numpy as np

from ....core.ops import NumpyOps
from ....core.optics import cox_munk, fresnel, ross, smith
from ....core.optics.erf import erfc_eq19
from ....core.optics.mean_fresnel import mean_fresnel, mean_fresnel_bruneton, mean_over_visible_slopes
from ....core.optics.slope_density import GaussianSlopes, GramCharlierSlopes
from ....core.optics.trochoid_slopes import mean_square_slope, mean_square_slope_linear
from .knob import Knob, Step

OPS = NumpyOps()
REFRACTIVE_INDEX = 1.333
WIND = 10.0  # m/s at 12.5 m

_POINTS = 1 << 18
_PER_MILLION = 1e6 / _POINTS
_SUN_ELEVATION = math.radians(30.0)


def directions(theta, phi) -> tuple:
    """Unit vectors (x, y, z) from zenith angles and azimuths in rad."""
    return np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta) * np.ones_like(phi)


def slope_deviations(wind: float) -> tuple[float, float]:
    """sigma_x and sigma_y of Cox and Munk."""
    return math.sqrt(cox_munk.slope_variance_along(wind)), math.sqrt(cox_munk.slope_variance_across(wind))


def gaussian_slopes(wind: float = WIND, **more) -> GaussianSlopes:
    """Gaussian slopes of this wind."""
    return GaussianSlopes(*slope_deviations(wind), **more)


def glitter_views() -> tuple:
    """Directions to a viewer from straight above to half a degree above the horizon, all around: (60, 72)."""
    theta = np.radians(np.linspace(0.0, 89.5, 60))[:, None]
    phi = np.radians(np.arange(0.0, 360.0, 5.0))[None, :]
    return directions(theta, phi)


def sun() -> tuple:
    """The direction to a sun 30 degrees above the horizon, upwind."""
    return directions(0.5 * np.pi - _SUN_ELEVATION, np.float64(np.pi))


def glitter(slopes, reflectance=fresnel.exact) -> np.ndarray:
    """Radiance of the sun's glitter over the sun's irradiance, 1/sr, seen from `glitter_views`."""
    view, light = glitter_views(), sun()
    half = ross.half_vector(OPS, view, light)
    lobe = ross.reflection_lobe(OPS, view, light, half, slopes)
    return lobe * reflectance(OPS, half.cos_incidence, REFRACTIVE_INDEX)


def rms_percent(values, truth) -> float:
    """Rms error over rms truth, in percent."""
    return 100.0 * float(np.sqrt(np.mean(np.square(values - truth)) / np.mean(np.square(truth))))


def worst_percent(values, truth, least=0.0) -> float:
    """Largest relative error in percent, of those where the truth is more than `least`."""
    counts = truth > least
    return 100.0 * float(np.max(np.abs(values[counts] / truth[counts] - 1.0)))


def _uniform(low, high, dtype=np.float32):
    return np.random.Generator(np.random.PCG64(0)).uniform(low, high, _POINTS).astype(dtype)


def _many(formula, *ranges, dtype=np.float32):
    """The work of evaluating a formula of some numbers at many points."""
    ops = NumpyOps(dtype)
    values = [_uniform(low, high, dtype) for low, high in ranges]
    return lambda _time: formula(ops, *values)


# ---------------------------------------------------------------------------------------------- Fresnel


def _fresnel_error(formula):
    c = np.linspace(0.0, 1.0, 2001)
    return worst_percent(formula(OPS, c, REFRACTIVE_INDEX), fresnel.exact(OPS, c, REFRACTIVE_INDEX))


def _fresnel_work(formula):
    return _many(lambda ops, c: formula(ops, c, np.float32(REFRACTIVE_INDEX)), (0.0, 1.0))


FRESNEL = Knob(
    "fresnel",
    "Fresnel factor of a facet",
    "Brightness of the sun's glitter and of mirror images",
    "Reflectance, at the angle where it is furthest off",
    "% of radiance",
    "Fresnel's equations, n = 1.333",
    "a million shading points in NumPy",
    tuple(
        Step(
            name,
            functools.partial(_fresnel_error, formula),
            functools.partial(_fresnel_work, formula),
            _PER_MILLION,
        )
        for name, formula in (("Schlick (Eq. 25)", fresnel.schlick), ("exact", fresnel.exact))
    ),
)

_MEAN_WINDS = (3.0, 6.0, 10.0, 15.0)
_MEAN_ANGLES = np.radians([0.0, 20.0, 40.0, 50.0, 60.0, 70.0, 75.0, 80.0, 84.0, 87.0, 89.0, 89.8])
_QUADRATURE_POINTS = 8


@functools.lru_cache(maxsize=1)
def _mean_fresnel_truth():
    def exact(c):
        return fresnel.exact(OPS, c, REFRACTIVE_INDEX)

    return np.array(
        [
            [
                mean_over_visible_slopes(
                    OPS, exact, tuple(map(float, directions(theta, 0.0))), gaussian_slopes(wind)
                )
                for theta in _MEAN_ANGLES
            ]
            for wind in _MEAN_WINDS
        ]
    )


def _mean_fresnel_error(formula):
    sigma = np.array([slope_deviations(wind)[0] for wind in _MEAN_WINDS])[:, None]
    return rms_percent(formula(OPS, np.cos(_MEAN_ANGLES), sigma), _mean_fresnel_truth())


def _flat_schlick(ops, cosine, _sigma):
    return fresnel.schlick(ops, cosine, ops.constant(REFRACTIVE_INDEX))


def _bruneton(ops, cosine, sigma):
    return mean_fresnel_bruneton(ops, cosine, sigma, ops.constant(REFRACTIVE_INDEX))


def _fit(ops, cosine, sigma):
    sine = ops.sqrt(1.0 - cosine * cosine)
    return mean_fresnel(ops, cosine, sigma * sine, ops.constant(REFRACTIVE_INDEX))


def _mean_by_quadrature():
    slopes = gaussian_slopes()
    views = [tuple(map(float, directions(theta, 0.0))) for theta in np.linspace(0.0, 1.5, _QUADRATURE_POINTS)]

    def evaluate(_time):
        for view in views:
            mean_over_visible_slopes(OPS, lambda c: fresnel.exact(OPS, c, REFRACTIVE_INDEX), view, slopes)

    return evaluate


MEAN_FRESNEL = Knob(
    "mean_fresnel",
    "Mean Fresnel factor of the rough sea",
    "How much sky the sea reflects, above all towards the horizon",
    "Mean reflectance over the slopes that are seen, rms over winds of 3 to 15 m/s and all angles",
    "% of radiance",
    "Quadrature with Fresnel's equations",
    "a million shading points in NumPy",
    (
        *(
            Step(
                name,
                functools.partial(_mean_fresnel_error, formula),
                lambda formula=formula: _many(formula, (0.001, 1.0), (0.05, 0.2)),
                _PER_MILLION,
            )
            for name, formula in (
                ("Schlick of the flat sea", _flat_schlick),
                ("Bruneton's fit", _bruneton),
                ("our fit of the exact mean", _fit),
            )
        ),
        Step("quadrature", lambda: 0.0, _mean_by_quadrature, 1e6 / _QUADRATURE_POINTS),
    ),
)

# ---------------------------------------------------------------------------------------------- masking


def masked_area_eq19(ops, w_z, s_w):
    """M with the paper's erfc (Eqs. 16 and 19): [exp(-a^2) s_w / sqrt(2 pi) - w_z erfc(a) / 2]."""
    a = w_z / s_w * math.sqrt(0.5)
    gaussian = ops.exp(-(a * a)) * s_w * (1.0 / math.sqrt(2.0 * math.pi))
    return gaussian - 0.5 * w_z * erfc_eq19(ops, a)


def _masking_error(formula):
    truth = glitter(gaussian_slopes(smith_masked_area=smith.masked_area_exact))
    values = glitter(gaussian_slopes(smith_masked_area=formula))
    return worst_percent(values, truth, least=1e-6 * truth.max())


def _masking_work(formula, dtype):
    return _many(formula, (0.0, 1.0), (0.05, 0.2), dtype=dtype)


MASKING = Knob(
    "erfc",
    "erfc in Smith's masking",
    "Brightness of the sea towards the horizon",
    "Glitter of a sun 30 degrees high, at the angle where it is furthest off (wind 10 m/s)",
    "% of radiance",
    "erfc exact to float64",
    "masking of a million directions in NumPy",
    (
        Step(
            "Eq. 19",
            functools.partial(_masking_error, masked_area_eq19),
            functools.partial(_masking_work, masked_area_eq19, np.float32),
            _PER_MILLION,
        ),
        Step(
            "Abramowitz and Stegun 7.1.26",
            functools.partial(_masking_error, smith.masked_area),
            functools.partial(_masking_work, smith.masked_area, np.float32),
            _PER_MILLION,
        ),
        Step(
            "exact",
            lambda: 0.0,
            functools.partial(_masking_work, smith.masked_area_exact, np.float64),
            _PER_MILLION,
        ),
    ),
)

# ---------------------------------------------------------------------------------------------- slope densities


def _skewed_slopes():
    return GramCharlierSlopes(*slope_deviations(WIND), wind_speed=WIND)


def _glitter_work(slopes):
    light = tuple(np.float32(component) for component in sun())

    def formula(ops, x, y, z):
        half = ross.half_vector(ops, (x, y, z), light)
        return ross.reflection_lobe(ops, (x, y, z), light, half, slopes)

    return _many(formula, (-0.7, 0.7), (-0.7, 0.7), (0.01, 1.0))


SLOPES = Knob(
    "slopes",
    "Distribution of slopes",
    "Shape of the sun's glitter: steep slopes rise into the wind",
    "Glitter of a sun 30 degrees high upwind, rms over the hemisphere of views (wind 10 m/s)",
    "% of radiance",
    "Cox and Munk's Gram-Charlier series",
    "the lobe at a million shading points in NumPy",
    (
        Step(
            "Gaussian",
            lambda: rms_percent(glitter(gaussian_slopes()), glitter(_skewed_slopes())),
            lambda: _glitter_work(gaussian_slopes()),
            _PER_MILLION,
        ),
        Step("Gram-Charlier", lambda: 0.0, lambda: _glitter_work(_skewed_slopes()), _PER_MILLION),
    ),
)


def _round_slopes():
    """Isotropic slopes of the same mean square of the two axes' product, as EEVEE's closures have."""
    sigma = math.sqrt(math.prod(slope_deviations(WIND)))
    return GaussianSlopes(sigma, sigma)


def _round_lobe_work():
    """The lobe where both deviations are one number: directions need not be turned into wind axes."""
    return _glitter_work(_round_slopes())


def _long_lobe_work():
    """The lobe with two deviations, and both directions turned into the axes of the wind."""
    slopes, light = gaussian_slopes(), tuple(np.float32(component) for component in sun())
    wind_x, wind_y = np.float32(math.cos(0.3)), np.float32(math.sin(0.3))

    def formula(ops, x, y, z):
        view = ross.to_wind_axes(ops, (x, y, z), wind_x, wind_y)
        to_sun = ross.to_wind_axes(ops, light, wind_x, wind_y)
        return ross.reflection_lobe(ops, view, to_sun, ross.half_vector(ops, view, to_sun), slopes)

    return _many(formula, (-0.7, 0.7), (-0.7, 0.7), (0.01, 1.0))


ANISOTROPY = Knob(
    "anisotropy",
    "Isotropic or anisotropic roughness",
    "Shape of the sun's glitter: wider along the wind than across",
    "Glitter of a sun 30 degrees high upwind, rms over the hemisphere of views (wind 10 m/s)",
    "% of radiance",
    "Slope variances along and across the wind",
    "the lobe at a million shading points in NumPy",
    (
        Step(
            "isotropic",
            lambda: rms_percent(glitter(_round_slopes()), glitter(gaussian_slopes())),
            _round_lobe_work,
            _PER_MILLION,
        ),
        Step("anisotropic", lambda: 0.0, _long_lobe_work, _PER_MILLION),
    ),
)

# ---------------------------------------------------------------------------------------------- Eq. 26

_SWELL_STEEPNESS = 0.3


def _slope_variance_error(formula):
    truth = float(mean_square_slope(_SWELL_STEEPNESS))
    return 100.0 * abs(float(formula(_SWELL_STEEPNESS)) / truth - 1.0)


SLOPE_VARIANCE = Knob(
    "slope_variance",
    "Slope variance of a wave (Eq. 26)",
    "How rough a sea of few steep waves looks from afar",
    f"Slope variance of one steep swell, k A = {_SWELL_STEEPNESS}",
    "% of slope variance",
    "1 - sqrt(1 - (k A)^2), the mean over horizontal area",
    "a million waves in NumPy, once",
    tuple(
        Step(
            name,
            functools.partial(_slope_variance_error, formula),
            lambda formula=formula: _many(lambda _ops, e: formula(e), (0.0, 0.5), dtype=np.float64),
            _PER_MILLION,
        )
        for name, formula in (("linear, (k A)^2 / 2", mean_square_slope_linear), ("exact", mean_square_slope))
    ),
)
