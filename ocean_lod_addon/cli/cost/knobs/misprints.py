# SPDX-License-Identifier: GPL-3.0-or-later
"""What the paper's equations would get wrong if they were taken as printed."""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ....core.discretise import discretise
from ....core.ops import NumpyOps
from ....core.optics import fresnel
from ....core.optics.smith import smith_lambda
from ....core.optics.trochoid_slopes import mean_square_slope
from ....core.sea import Sea
from .knob import Knob, Step
from .shading import (
    REFRACTIVE_INDEX,
    WIND,
    glitter_views,
    rms_percent,
    slope_deviations,
    sun,
)


@dataclass(frozen=True)
class Misprint:
    """An equation as printed beside what is right, and how far the printed form is off."""

    equation: str
    printed: str
    corrected: str
    error_of: str
    unit: str
    error: Callable[[], float]


_STEEPNESS = 0.3
_LENGTH = 20.0  # m
_AMPLITUDE = _STEEPNESS * _LENGTH / (2.0 * math.pi)


def _profile_error():
    """Rms height over a wavelength of a trochoid drawn upside down, X = x0 + A sin instead of X = x0 - A sin."""
    psi = np.linspace(-np.pi, np.pi, 20_001)
    X = np.linspace(-np.pi, np.pi, 2001)
    right = np.interp(X, psi - _STEEPNESS * np.sin(psi), np.cos(psi))
    printed = np.interp(X, psi + _STEEPNESS * np.sin(psi), np.cos(psi))
    return 1e3 * _AMPLITUDE * float(np.sqrt(np.mean((printed - right) ** 2)))


def _direction_error():
    """Rms angle between each wave's own direction and 45 degrees, where k (x0 + y0) makes all of them run."""
    waves = discretise(Sea(), 0.4)
    away = np.angle(np.exp(1j * (waves.direction - 0.25 * np.pi)))
    energy = waves.amplitude**2
    return math.degrees(math.sqrt(float(np.sum(energy * away**2) / np.sum(energy))))


def _normal_error():
    """Largest angle between the normals (-Zx, 1) of a height field and (-Zx, Jxx) of the displaced surface."""
    psi = np.linspace(0.0, 2.0 * np.pi, 20_001)
    slope = -_STEEPNESS * np.sin(psi)
    between = np.arctan2(-slope, 1.0 - _STEEPNESS * np.cos(psi)) - np.arctan2(-slope, np.ones_like(psi))
    return math.degrees(float(np.abs(between).max()))


def glitter_of_equations(views, light, sigmas, *, eq8=True, eq13=True, eq17=True, eq22=True) -> np.ndarray:
    """BRDF cos theta_l of Eqs. 8 to 24 in angles, as the paper has it; an equation set to False is as printed.

    p / h_z^4 F / [4 cos theta_v (1 + Lambda_v + Lambda_l)], with Gaussian slopes; printed, Y = zeta_y / sigma_x
    (8), Lambda_v stands twice (13), tan is not squared (17) and one h_z is missing (22, 23).
    """
    (v_x, v_y, v_z), (l_x, l_y, l_z) = views, light
    H_x, H_y, H_z = v_x + l_x, v_y + l_y, v_z + l_z
    length = np.sqrt(H_x**2 + H_y**2 + H_z**2)
    sigma_x, sigma_y = sigmas
    X, Y = H_x / H_z / sigma_x, H_y / H_z / (sigma_y if eq8 else sigma_x)
    p = np.exp(-0.5 * (X**2 + Y**2)) / (2.0 * np.pi * sigma_x * sigma_y)

    def big_lambda(x, y, z):
        theta, phi = np.arccos(np.minimum(z, 1.0 - 1e-9)), np.arctan2(y, x)
        power = 2 if eq17 else 1
        spread = 2.0 * (sigma_x**2 * np.cos(phi) ** 2 + sigma_y**2 * np.sin(phi) ** 2) * np.tan(theta) ** power
        return smith_lambda(spread**-0.5)

    Lambda_v = big_lambda(v_x, v_y, v_z)
    Lambda_l = big_lambda(l_x, l_y, l_z) if eq13 else Lambda_v
    F = fresnel.exact(NumpyOps(), 0.5 * length, REFRACTIVE_INDEX)
    power = 4 if eq22 else 3
    return p * (length / H_z) ** power * F / (4.0 * v_z * (1.0 + Lambda_v + Lambda_l))


def _glitter_error(**as_printed):
    views, light, sigmas = glitter_views(), sun(), slope_deviations(WIND)
    right = glitter_of_equations(views, light, sigmas)
    return rms_percent(glitter_of_equations(views, light, sigmas, **as_printed), right)


_SWELL_LENGTH, _SWELL_AMPLITUDE = 100.0, 3.0  # m


def _printed_slope_variance_error():
    """k (1 - sqrt(1 - k A^2)), whose root has metres in it, instead of 1 - sqrt(1 - (k A)^2)."""
    k, A = 2.0 * math.pi / _SWELL_LENGTH, _SWELL_AMPLITUDE
    printed = k * (1.0 - math.sqrt(1.0 - k * A * A))
    return 100.0 * abs(printed / float(mean_square_slope(k * A)) - 1.0)


_OF_GLITTER = "Glitter of a sun 30 degrees high upwind, rms over the hemisphere of views (wind 10 m/s)"

MISPRINTS = (
    Misprint(
        "2",
        "x0 + A sin",
        "x0 - A sin",
        "Height of a wave of 20 m and k A = 0.3, rms: its crests are blunt and its troughs sharp",
        "mm",
        _profile_error,
    ),
    Misprint(
        "2",
        "phase k (x0 + y0)",
        "phase k . (x0, y0)",
        "Direction of the waves, rms: all run at 45 degrees (Pierson-Moskowitz with SWOP, 10 m/s)",
        "degrees",
        _direction_error,
    ),
    Misprint(
        "3-4",
        "derivatives of the height",
        "derivatives of the displaced point",
        "Normal of a wave of k A = 0.3, largest",
        "degrees",
        _normal_error,
    ),
    Misprint(
        "8",
        "Y = zeta_y / sigma_x",
        "Y = zeta_y / sigma_y",
        _OF_GLITTER,
        "% of radiance",
        functools.partial(_glitter_error, eq8=False),
    ),
    Misprint(
        "13",
        "Lambda_v + Lambda_v",
        "Lambda_v + Lambda_l",
        _OF_GLITTER,
        "% of radiance",
        functools.partial(_glitter_error, eq13=False),
    ),
    Misprint(
        "17",
        "tan theta",
        "tan^2 theta",
        _OF_GLITTER,
        "% of radiance",
        functools.partial(_glitter_error, eq17=False),
    ),
    Misprint(
        "22, 23",
        "h_z^2",
        "h_z^3",
        _OF_GLITTER,
        "% of radiance",
        functools.partial(_glitter_error, eq22=False),
    ),
    Misprint(
        "26",
        "k, k A^2",
        "1, (k A)^2",
        "Slope variance of a swell of 100 m and 3 m amplitude (with 4 m it is no number)",
        "% of slope variance",
        _printed_slope_variance_error,
    ),
)
"""Each printed equation by itself, everything else being right."""

_POINTS = 1 << 16


def _work(**as_printed):
    random = np.random.Generator(np.random.PCG64(0))
    theta, phi = random.uniform(0.0, 1.55, _POINTS), random.uniform(-np.pi, np.pi, _POINTS)
    views = np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)
    return lambda _time: glitter_of_equations(views, sun(), slope_deviations(WIND), **as_printed)


_ALL_PRINTED = {"eq8": False, "eq13": False, "eq17": False, "eq22": False}

EQUATIONS = Knob(
    "equations",
    "Equations as printed or corrected",
    "Brightness and shape of the sun's glitter; the table of misprints has each equation by itself",
    _OF_GLITTER,
    "% of radiance",
    "Eqs. 8 to 24 corrected",
    "the lobe at a million shading points in NumPy",
    (
        Step(
            "as printed",
            functools.partial(_glitter_error, **_ALL_PRINTED),
            functools.partial(_work, **_ALL_PRINTED),
            1e6 / _POINTS,
        ),
        Step("corrected", lambda: 0.0, _work, 1e6 / _POINTS),
    ),
)
