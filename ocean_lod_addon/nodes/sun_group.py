# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Sun": the Ross BRDF of one sun, evaluated in math nodes.

EEVEE shades microfacets as isotropic GGX, which turns the glitter path into a round blob; here the formula
itself is the emission, with the exact Fresnel reflectance. Slopes that the mesh shows are taken from the
shading normal and added to the unresolved ones in horizontal axes (THEORY section 6, with resolved geometry).
There are no shadows in it.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics import fresnel, ross
from ..core.optics.slope_density import GaussianSlopes, slope_deviation
from ..core.sun import disc_slope_variance
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .reflection_group import HAS_EXACT_FRESNEL
from .sockets import (
    BSDF,
    FORMULA_SUN,
    GLITTER_STRENGTH,
    MAJOR_VARIANCE,
    MINOR_VARIANCE,
    NORMAL,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    TANGENT,
)

SUN_INPUTS = (
    MAJOR_VARIANCE,
    MINOR_VARIANCE,
    TANGENT,
    NORMAL,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    SUN_ANGLE,
    GLITTER_STRENGTH,
)


def _exact(graph: Graph, cos_incidence):
    return fresnel.exact(GraphOps(graph), cos_incidence, WATER_REFRACTIVE_INDEX)


def _as_the_closure(graph: Graph, cos_incidence):
    """Exact where the formula replaces the closure, the closure's own Schlick where it adds to it."""
    ops = GraphOps(graph)
    schlick = fresnel.schlick(ops, cos_incidence, WATER_REFRACTIVE_INDEX)
    return ops.where(graph.input(FORMULA_SUN.name), _exact(graph, cos_incidence), schlick)


def _slopes(graph: Graph) -> GaussianSlopes:
    """The unresolved slopes, and on top of them what the size of the sun's disc adds to a glitter path."""
    ops = GraphOps(graph)
    disc = graph.label(disc_slope_variance(graph.input(SUN_ANGLE.name)), "variance of sun disc")
    variances = (graph.input(socket.name) + disc for socket in (MAJOR_VARIANCE, MINOR_VARIANCE))
    return GaussianSlopes(*(slope_deviation(ops, variance) for variance in variances))


def _build(graph: Graph, reflectance):
    """Slopes, directions in the axes of the slopes, the BRDF, the emission."""
    ops = GraphOps(graph)
    with graph.section("Slopes"):
        slopes = _slopes(graph)
    with graph.section("Directions in slope axes"):
        geometry = graph.node("ShaderNodeNewGeometry")
        axis_x, axis_y, _ = graph.input(TANGENT.name).components()
        incoming = graph.output_of(geometry, "Incoming")
        view, light, normal = (
            ross.to_wind_axes(ops, vector.components(), axis_x, axis_y)
            for vector in (incoming, graph.input(SUN_DIRECTION.name), graph.input(NORMAL.name))
        )
        from_above = graph.label(1.0 - graph.output_of(geometry, "Backfacing"), "seen from above")
    with graph.section("Ross BRDF of the sun"):
        half = ross.half_vector(ops, view, light)
        lobe = ross.reflection_lobe(ops, view, light, half, slopes, ross.tilt_of_normal(ops, normal))
    with graph.section("Fresnel"):
        F = reflectance(graph, half.cos_incidence)
    with graph.section("Radiance"):
        strength = lobe * F * from_above * graph.input(GLITTER_STRENGTH.name)
        inputs = {"Color": graph.input(SUN_IRRADIANCE.name), "Strength": strength}
        emission = graph.node("ShaderNodeEmission", "Glitter", inputs)
    graph.output(BSDF.name, graph.output_of(emission))


SUN = GroupRecipe("Ocean LOD Sun", "3", SUN_INPUTS, (BSDF,), lambda graph: _build(graph, _exact))

SUN_BESIDE_CLOSURE = (
    SUN
    if HAS_EXACT_FRESNEL
    else GroupRecipe(
        "Ocean LOD Sun Beside Closure",
        "2",
        (*SUN_INPUTS, FORMULA_SUN),
        (BSDF,),
        lambda graph: _build(graph, _as_the_closure),
    )
)
"""The sun for Cycles, where it adds to the closure or takes from it: with the closure's Fresnel reflectance."""
