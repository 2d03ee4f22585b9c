# SPDX-License-Identifier: GPL-3.0-or-later
"""How bright the sun disc of Blender's Sky Texture is, which no property of the texture tells.

Cycles shows the disc through the texture's own model of the atmosphere; EEVEE does not show it at all. These
functions compute the irradiance of the disc from the same models (Nishita et al. 1993; Garcia Linan 2022), on a
plane that faces the sun, as linear Rec. 709, in the texture's units.
"""

import numpy as np

from .color import REC709_FROM_XYZ, color_matching

LIMB_DARKENING_MEAN = 0.8
"""Mean over the disc of 1 - 0.6 (1 - sqrt(1 - r^2)), the darkening towards its edge that Cycles applies."""

_PATH_STEPS = 64
"""Blender's own count for multiple scattering; so near the horizon both have the same error."""

# Single scattering (Nishita): a black body above a molecular and an aerosol layer, both exponential.

SUN_TEMPERATURE = 5778.0
SUN_RADIUS_OVER_DISTANCE = 6.9567e8 / 1.49597871e11
NISHITA_EARTH_RADIUS, NISHITA_ATMOSPHERE = 6.36e6, 6.0e4
RAYLEIGH_380_NM, RAYLEIGH_HEIGHT = 5.424820087e-5, 8.0e3
AEROSOL_EXTINCTION, AEROSOL_HEIGHT = 1.11 * 2.0e-5, 1.2e3
_WAVELENGTHS = np.arange(380.0, 781.0, 20.0)

# Multiple scattering: four wavelengths and a matrix that turns them into a colour.

LINAN_EARTH_RADIUS, LINAN_ATMOSPHERE = 6371.0, 100.0
SUN_IRRADIANCE_4 = np.array([1.679, 1.828, 1.986, 1.307])
"""At 630, 560, 490 and 430 nm, as all vectors of four below, W/(m^2 nm)."""
MOLECULES_4 = np.array([6.605e-3, 1.067e-2, 1.842e-2, 3.156e-2])
"""Scattering of air at sea level, 1/km."""
OZONE_4 = np.array([3.472e-25, 3.914e-25, 1.349e-25, 11.03e-27])
OZONE_DOBSON = 334.5
AEROSOL_4 = np.array([1.5908e-22, 1.7711e-22, 2.0942e-22, 2.4033e-22]) + np.array(
    [2.8722e-24, 4.6168e-24, 7.9706e-24, 1.3578e-23]
)
"""Scattering plus absorption of one aerosol particle of an urban mixture."""
AEROSOL_DENSITY, AEROSOL_BACKGROUND, AEROSOL_HEIGHT_KM = 1.3681e20, 2.0e6, 0.73
XYZ_FROM_4 = np.array(
    [
        [53.386917738564668, 43.904844466369358, 1.6137278251608962, 20.762668673810577],
        [22.981337506691025, 71.347795700053394, 18.422960591455485, 2.3614213523314369],
        [0.0, 0.10250686796574131, 31.742921188390806, 110.48009643252140],
    ]
)


def _heights_along(elevation, altitude, earth_radius, atmosphere):
    """Heights above the ground along the ray to the sun, and the weights that integrate over its length."""
    start = earth_radius + altitude
    down, top = start * np.sin(elevation), earth_radius + atmosphere
    length = np.sqrt(down * down + top * top - start * start) - down
    step = length / _PATH_STEPS
    distance = step * (np.arange(_PATH_STEPS) + 0.5)
    height = np.sqrt(start * start + distance * distance + 2.0 * distance * down) - earth_radius
    return np.maximum(height, 0.0), np.full(_PATH_STEPS, step)


def _rgb(xyz):
    return np.maximum(REC709_FROM_XYZ @ xyz, 0.0) * LIMB_DARKENING_MEAN


def black_body_irradiance(wavelength) -> np.ndarray:
    """Irradiance of the sun above the atmosphere by Planck's law, W/(m^2 nm), `wavelength` in nm."""
    h, c, k = 6.62607015e-34, 2.99792458e8, 1.380649e-23
    metres = np.asarray(wavelength) * 1e-9
    radiance = 2.0 * h * c**2 / metres**5 / np.expm1(h * c / (metres * k * SUN_TEMPERATURE))
    return np.pi * SUN_RADIUS_OVER_DISTANCE**2 * radiance * 1e-9


def single_scattering_sun(elevation, altitude, air, aerosols) -> np.ndarray:
    """RGB irradiance, shape (3,), of the disc of a Sky Texture of type Nishita or Single Scattering.

    `elevation` in rad, `altitude` in m, the densities as in the texture (1 is clear air). The disc of this
    model ignores ozone.
    """
    height, weight = _heights_along(elevation, altitude, NISHITA_EARTH_RADIUS, NISHITA_ATMOSPHERE)
    rayleigh = RAYLEIGH_380_NM * (380.0 / _WAVELENGTHS) ** 4
    molecules = weight @ np.exp(-height / RAYLEIGH_HEIGHT)
    particles = weight @ np.exp(-height / AEROSOL_HEIGHT)
    depth = rayleigh * molecules * air + AEROSOL_EXTINCTION * particles * aerosols
    spectrum = black_body_irradiance(_WAVELENGTHS) * np.exp(-depth)
    return _rgb(color_matching(_WAVELENGTHS) @ spectrum * (_WAVELENGTHS[1] - _WAVELENGTHS[0]))


def multiple_scattering_sun(elevation, altitude, air, aerosols, ozone) -> np.ndarray:
    """RGB irradiance, shape (3,), of the disc of a Sky Texture of type Multiple Scattering (Blender 5).

    `elevation` in rad, `altitude` in m, the densities as in the texture (1 is clear air).
    """
    height, weight = _heights_along(elevation, altitude / 1e3, LINAN_EARTH_RADIUS, LINAN_ATMOSPHERE)
    molecules = weight @ np.exp(-0.07771971 * height**1.16364243)
    log_height = np.log(np.maximum(height, 1e-4))
    ozone_column = weight @ (3.78547397e20 * np.exp(-((log_height - 3.22261) ** 2) * 5.55555555 - log_height))
    particles = weight @ (AEROSOL_DENSITY * np.exp(-height / AEROSOL_HEIGHT_KM) + AEROSOL_BACKGROUND)
    depth = MOLECULES_4 * molecules * air + AEROSOL_4 * particles * aerosols
    depth = depth + OZONE_4 * OZONE_DOBSON * ozone_column * ozone
    return _rgb(XYZ_FROM_4 @ (SUN_IRRADIANCE_4 * np.exp(-depth)))
