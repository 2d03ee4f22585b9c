# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Clear Surface": the surface for Cycles where one looks into the water, or out of it.

From above, what the surface does not reflect is refracted by the same facets. From below, a Glass closure, which
knows total reflection. Rays that carry light to what lies in the water (shadow rays, and the rays by which things
there look for light) go straight through instead of being refracted: otherwise the sun would reach the bottom only
along caustics, which a path tracer hardly ever finds. That costs the bend of the light on its way down, not its
energy.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics import beckmann
from .graph import Graph, GraphOps
from .groups import GroupRecipe, Socket
from .sockets import BSDF, MAJOR_VARIANCE, MINOR_VARIANCE, NORMAL, REFLECTED_SHARE

RADIANCE_OUT_OF_WATER = 1.0 / WATER_REFRACTIVE_INDEX**2
"""Light that leaves the water spreads over a wider cone and loses radiance by 1/n^2; Cycles leaves that out."""

REFLECTION_FROM_ABOVE = Socket("Reflection", "SHADER", "What the surface reflects upwards")


def _build(graph: Graph):
    """Refraction below the reflection, Glass from below, and the way through for light."""
    ops = GraphOps(graph)
    with graph.section("Slope variance to roughness"):
        major, minor = graph.input(MAJOR_VARIANCE.name), graph.input(MINOR_VARIANCE.name)
        roughness = beckmann.glossy_sockets(ops, major, minor).roughness
        transmitted = graph.label(1.0 - graph.input(REFLECTED_SHARE.name), "transmitted share")
    shape = {"Roughness": roughness, "IOR": WATER_REFRACTIVE_INDEX, "Normal": graph.input(NORMAL.name)}
    with graph.section("From above"):
        leaving = graph.label(transmitted * RADIANCE_OUT_OF_WATER, "radiance out of water")
        refraction = graph.node(
            "ShaderNodeBsdfRefraction", "Refraction", {"Color": leaving, **shape}, distribution="BECKMANN"
        )
        reflection = graph.input(REFLECTION_FROM_ABOVE.name)
        from_above = graph.add_shaders(reflection, graph.output_of(refraction))
    with graph.section("From below"):
        white = {"Color": (1.0, 1.0, 1.0, 1.0)}
        glass = graph.node("ShaderNodeBsdfGlass", "Underside", white | shape, distribution="BECKMANN")
        backfacing = graph.output_of(graph.node("ShaderNodeNewGeometry"), "Backfacing")
        seen = graph.mix_shaders(backfacing, from_above, graph.output_of(glass))
    with graph.section("Light on its way down"):
        path = graph.node("ShaderNodeLightPath")
        kinds = ("Is Shadow Ray", "Is Diffuse Ray", "Is Volume Scatter Ray")
        shadow, diffuse, scattered = (graph.output_of(path, kind) for kind in kinds)
        to_light = ops.maximum(ops.maximum(shadow, diffuse), scattered)
        straight = graph.label(to_light * backfacing, "straight through")
        transparent = graph.node("ShaderNodeBsdfTransparent", "Light", {"Color": transmitted})
        surface = graph.mix_shaders(straight, seen, graph.output_of(transparent))
    graph.output(BSDF.name, surface)


CLEAR_SURFACE = GroupRecipe(
    "Ocean LOD Clear Surface",
    "3",
    inputs=(REFLECTION_FROM_ABOVE, MAJOR_VARIANCE, MINOR_VARIANCE, REFLECTED_SHARE, NORMAL),
    outputs=(BSDF,),
    build=_build,
)
