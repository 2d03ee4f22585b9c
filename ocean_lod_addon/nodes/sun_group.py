# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups "Ocean LOD Sun": the Ross BRDF of one sun, evaluated in math nodes.

EEVEE shades microfacets as isotropic GGX, which turns the glitter path into a round blob; here the formula
itself is the emission, with the exact Fresnel reflectance. Slopes that mesh and bump show are taken from the
shading normal and added to the unresolved ones in horizontal axes (THEORY section 6, with resolved geometry).
There are no shadows in it.

Three kinds: Gaussian slopes; Cox and Munk's skewed and peaked slopes; and Gaussian slopes with the Fresnel
reflectance of Cycles' closure, for what adds to that closure or takes from it.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics import fresnel, ross
from ..core.optics.principal_slopes import variance_along
from ..core.optics.slope_density import GaussianSlopes, GramCharlierSlopes, slope_deviation
from ..core.sun import disc_slope_variance
from .graph import Graph, GraphOps, Vector
from .groups import GroupRecipe
from .reflection_group import HAS_EXACT_FRESNEL
from .sockets import (
    BSDF,
    GLITTER_STRENGTH,
    MAJOR_VARIANCE,
    MINOR_VARIANCE,
    NORMAL,
    SLOPE_VARIANCE,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    TANGENT,
    WIND_DIRECTION,
    WIND_SPEED,
)
from .surface_frame import to_world

SUN_INPUTS = (NORMAL, SUN_DIRECTION, SUN_IRRADIANCE, SUN_ANGLE, GLITTER_STRENGTH)


def _deviations(graph: Graph, variances):
    """sigma of the unresolved slopes, with what the size of the sun's disc adds to a glitter path."""
    disc = graph.label(disc_slope_variance(graph.input(SUN_ANGLE.name)), "variance of sun disc")
    return [slope_deviation(GraphOps(graph), variance + disc) for variance in variances]


def _gaussian(graph: Graph) -> tuple[GaussianSlopes, Vector]:
    """Slopes along the principal axes, and the first axis in world space."""
    variances = (graph.input(MAJOR_VARIANCE.name), graph.input(MINOR_VARIANCE.name))
    return GaussianSlopes(*_deviations(graph, variances)), graph.input(TANGENT.name)


def _skewed(graph: Graph) -> tuple[GramCharlierSlopes, Vector]:
    """Slopes along and across the wind, and the wind's axis in world space."""
    ops = GraphOps(graph)
    angle = graph.input(WIND_DIRECTION.name)
    c, s = graph.math("COSINE", angle), graph.math("SINE", angle)
    tensor = graph.input(SLOPE_VARIANCE.name).components()
    variances = (variance_along(ops, *tensor, c, s), variance_along(ops, *tensor, s * -1.0, c))
    slopes = GramCharlierSlopes(*_deviations(graph, variances), wind_speed=graph.input(WIND_SPEED.name))
    return slopes, to_world(graph, graph.vector(c, s, 0.0), "Wind axis")


def _build(graph: Graph, slopes_and_axis, reflectance):
    """Slopes, directions in the axes of the slopes, the BRDF, the emission."""
    ops = GraphOps(graph)
    with graph.section("Slopes"):
        slopes, axis = slopes_and_axis(graph)
    with graph.section("Directions in slope axes"):
        geometry = graph.node("ShaderNodeNewGeometry")
        axis_x, axis_y, _ = axis.components()
        incoming = graph.output_of(geometry, "Incoming")
        view, light, normal = (
            ross.to_wind_axes(ops, vector.components(), axis_x, axis_y)
            for vector in (incoming, graph.input(SUN_DIRECTION.name), graph.input(NORMAL.name))
        )
        from_above = graph.label(1.0 - graph.output_of(geometry, "Backfacing"), "seen from above")
    with graph.section("Half vector"):
        half = ross.half_vector(ops, view, light)
    with graph.section("Slope density and masking"):
        lobe = ross.reflection_lobe(ops, view, light, half, slopes, ross.tilt_of_normal(ops, normal))
    with graph.section("Fresnel"):
        F = reflectance(ops, half.cos_incidence, WATER_REFRACTIVE_INDEX)
    with graph.section("Radiance"):
        strength = lobe * F * from_above * graph.input(GLITTER_STRENGTH.name)
        inputs = {"Color": graph.input(SUN_IRRADIANCE.name), "Strength": strength}
        emission = graph.node("ShaderNodeEmission", "Glitter", inputs)
    graph.output(BSDF.name, graph.output_of(emission))


SUN = GroupRecipe(
    "Ocean LOD Sun",
    "5",
    (MAJOR_VARIANCE, MINOR_VARIANCE, TANGENT, *SUN_INPUTS),
    (BSDF,),
    lambda graph: _build(graph, _gaussian, fresnel.exact),
)

SKEWED_SUN = GroupRecipe(
    "Ocean LOD Skewed Sun",
    "2",
    (SLOPE_VARIANCE, WIND_DIRECTION, WIND_SPEED, *SUN_INPUTS),
    (BSDF,),
    lambda graph: _build(graph, _skewed, fresnel.exact),
)

SUN_BESIDE_CLOSURE = GroupRecipe(
    "Ocean LOD Sun Beside Closure",
    "2 exact" if HAS_EXACT_FRESNEL else "2 schlick",
    SUN.inputs,
    (BSDF,),
    lambda graph: _build(graph, _gaussian, fresnel.exact if HAS_EXACT_FRESNEL else fresnel.schlick),
)
