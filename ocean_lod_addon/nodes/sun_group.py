# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Sun": the Ross BRDF of one sun, evaluated in math nodes.

EEVEE shades microfacets as isotropic GGX, which turns the glitter path into a round blob; here the formula
itself is the emission, with the exact Fresnel reflectance. Slopes that the mesh shows are taken from the
shading normal and added to the unresolved ones in horizontal axes (THEORY section 6, with resolved geometry).
There are no shadows in it.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics import ross
from ..core.optics.slope_density import GaussianSlopes, slope_deviation
from ..core.sun import disc_slope_variance
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import (
    BSDF,
    GLITTER_STRENGTH,
    MAJOR_VARIANCE,
    MINOR_VARIANCE,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    TANGENT,
)


def _build(graph: Graph):
    """Slopes with the sun's own size, directions in the axes of the slopes, the BRDF, the emission."""
    ops = GraphOps(graph)
    with graph.section("Slopes"):
        disc = graph.label(disc_slope_variance(graph.input(SUN_ANGLE.name)), "variance of sun disc")
        deviations = [
            slope_deviation(ops, graph.input(socket.name) + disc) for socket in (MAJOR_VARIANCE, MINOR_VARIANCE)
        ]
        slopes = GaussianSlopes(*deviations)
    with graph.section("Directions in slope axes"):
        geometry = graph.node("ShaderNodeNewGeometry")
        axis_x, axis_y, _ = graph.input(TANGENT.name).components()
        view, light, normal = (
            ross.to_wind_axes(ops, vector.components(), axis_x, axis_y)
            for vector in (
                graph.output_of(geometry, "Incoming"),
                graph.input(SUN_DIRECTION.name),
                graph.output_of(geometry, "Normal"),
            )
        )
        from_above = graph.label(1.0 - graph.output_of(geometry, "Backfacing"), "seen from above")
    with graph.section("Ross BRDF of the sun"):
        tilt = ross.tilt_of_normal(ops, normal)
        factor = ross.sun_radiance_factor(ops, view, light, slopes, WATER_REFRACTIVE_INDEX, tilt)
    with graph.section("Radiance"):
        strength = factor * from_above * graph.input(GLITTER_STRENGTH.name)
        emission = graph.node(
            "ShaderNodeEmission", "Glitter", {"Color": graph.input(SUN_IRRADIANCE.name), "Strength": strength}
        )
    graph.output(BSDF.name, graph.output_of(emission))


SUN = GroupRecipe(
    "Ocean LOD Sun",
    "1",
    inputs=(
        MAJOR_VARIANCE,
        MINOR_VARIANCE,
        TANGENT,
        SUN_DIRECTION,
        SUN_IRRADIANCE,
        SUN_ANGLE,
        GLITTER_STRENGTH,
    ),
    outputs=(BSDF,),
    build=_build,
)
