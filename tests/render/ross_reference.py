# SPDX-License-Identifier: GPL-3.0-or-later
"""What a flat strip of sea must show, from the reference formulas of core in float64."""

import numpy as np

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel, ross
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes, GramCharlierSlopes
from ocean_lod_addon.core.optics.smith import masked_area_exact

UPWARD = np.array([0.0, 0.0, 1.0])


def sun_radiance(to_viewer, to_sun, tensor, reflectance=fresnel.exact, normal=UPWARD) -> float:
    """Radiance of a flat sea, or of one tilted to `normal`, under a point sun of irradiance 1, 1/sr.

    `tensor` is (xx, yy, xy); its axes come from NumPy's eigenvalues, the shader's from a formula of its own.
    """
    ops = NumpyOps()
    xx, yy, xy = tensor
    variances, axes = np.linalg.eigh(np.array([[xx, xy], [xy, yy]]))
    slopes = GaussianSlopes(*np.sqrt(variances), smith_masked_area=masked_area_exact)
    view, light, normal = ((*(axes.T @ vector[:2]), vector[2]) for vector in (to_viewer, to_sun, normal))
    half = ross.half_vector(ops, view, light)
    F = reflectance(ops, half.cos_incidence, WATER_REFRACTIVE_INDEX)
    return float(ross.reflection_lobe(ops, view, light, half, slopes, ross.tilt_of_normal(ops, normal)) * F)


def skewed_sun_radiance(to_viewer, to_sun, tensor, wind_speed, wind_direction) -> float:
    """The same with Cox and Munk's slopes, for a wind (m/s) that blows towards `wind_direction` (rad)."""
    ops = NumpyOps()
    xx, yy, xy = tensor
    c, s = np.cos(wind_direction), np.sin(wind_direction)
    axes = np.array([[c, -s], [s, c]])
    along, across = np.diag(axes.T @ np.array([[xx, xy], [xy, yy]]) @ axes)
    slopes = GramCharlierSlopes(np.sqrt(along), np.sqrt(across), masked_area_exact, wind_speed=wind_speed)
    view, light = ((*(axes.T @ vector[:2]), vector[2]) for vector in (to_viewer, to_sun))
    return float(ross.brdf_cos(ops, view, light, slopes, WATER_REFRACTIVE_INDEX))


def lobe_peak(to_viewer, tensor) -> float:
    """Radiance where the sun stands in the mirror direction, to tell a lobe's body from its tail."""
    return sun_radiance(to_viewer, to_viewer * np.array([-1.0, -1.0, 1.0]), tensor)
