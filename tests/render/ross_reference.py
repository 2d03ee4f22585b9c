# SPDX-License-Identifier: GPL-3.0-or-later
"""What a flat strip of sea must show, from the reference formulas of core in float64."""

import numpy as np

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel, ross
from ocean_lod_addon.core.optics.reflected_share import reflected_light_reference
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes, GramCharlierSlopes
from ocean_lod_addon.core.optics.smith import masked_area_exact
from ocean_lod_addon.nodes.reflection_group import HAS_EXACT_FRESNEL

UPWARD = np.array([0.0, 0.0, 1.0])

CLOSURE_FRESNEL = fresnel.exact if HAS_EXACT_FRESNEL else fresnel.schlick
"""The reflectance of water in the closure of this Blender; the formulas of EEVEE have the exact one in both."""


def slopes_and_axes(tensor) -> tuple[GaussianSlopes, np.ndarray]:
    """Slopes of a variance tensor (xx, yy, xy), and the directions (columns) that they are measured along."""
    xx, yy, xy = tensor
    variances, axes = np.linalg.eigh(np.array([[xx, xy], [xy, yy]]))
    return GaussianSlopes(*np.sqrt(variances), smith_masked_area=masked_area_exact), axes


def sun_radiance(to_viewer, to_sun, tensor, reflectance=fresnel.exact, normal=UPWARD) -> float:
    """Radiance of a flat sea, or of one tilted to `normal`, under a point sun of irradiance 1, 1/sr.

    `tensor` is (xx, yy, xy); its axes come from NumPy's eigenvalues, the shader's from a formula of its own.
    """
    ops, (slopes, axes) = NumpyOps(), slopes_and_axes(tensor)
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


def closure_excess(to_viewer, to_sun) -> np.ndarray:
    """A sun's reflection in the closure over that with the exact Fresnel reflectance: 1 from Blender 5 on.

    Whatever the waves, the facets that show the sun are those that mirror it to the viewer: both see it at half
    of the angle between them. The vectors are unit vectors, of shape (..., 3).
    """
    ops, cos_incidence = NumpyOps(), 0.5 * np.linalg.norm(np.add(to_viewer, to_sun), axis=-1)
    closure, exact = (F(ops, cos_incidence, WATER_REFRACTIVE_INDEX) for F in (CLOSURE_FRESNEL, fresnel.exact))
    return closure / exact


def sky_share(to_viewer, tensor, reflectance) -> float:
    """Share of a uniform sky's light in a flat sea, for a formula of `fresnel`."""
    slopes, axes = slopes_and_axes(tensor)
    view = (*(axes.T @ to_viewer[:2]), to_viewer[2])
    return reflected_light_reference(
        NumpyOps(), view, slopes, WATER_REFRACTIVE_INDEX, reflectance=reflectance
    ).share


def lobe_peak(to_viewer, tensor) -> float:
    """Radiance where the sun stands in the mirror direction, to tell a lobe's body from its tail."""
    return sun_radiance(to_viewer, to_viewer * np.array([-1.0, -1.0, 1.0]), tensor)
