# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Water": the whole material, one shader output per engine."""

from .body_group import WATER_BODY
from .graph import Graph
from .groups import GroupRecipe, Socket, use_group
from .mean_fresnel_group import MEAN_FRESNEL_OF_SLOPES
from .reflection_group import REFLECTION
from .sky_reflection_group import SKY_REFLECTION
from .slopes_group import SLOPES
from .sockets import BSDF, ROUGHNESS, SLOPE_VARIANCE, WATER_COLOR

TINT = Socket(
    "Tint",
    "COLOR",
    "Factor on the color of the water, per channel. White is physical",
    (1.0, 1.0, 1.0, 1.0),
)
CYCLES = Socket("Cycles", "SHADER", "Surface for Cycles")
EEVEE = Socket("EEVEE", "SHADER", "Surface for EEVEE")


def _build(graph: Graph):
    """Slopes, then reflection and body, then their sum for each engine."""
    with graph.section("Unresolved slopes"):
        inputs = {socket.name: graph.input(socket.name) for socket in (SLOPE_VARIANCE, ROUGHNESS)}
        slopes = use_group(graph, SLOPES, inputs)
    with graph.section("Mean Fresnel"):
        mean_fresnel = use_group(graph, MEAN_FRESNEL_OF_SLOPES, slopes)
    with graph.section("Water body"):
        color = graph.label(graph.input(WATER_COLOR.name).times(graph.input(TINT.name)), "tinted color")
        body = use_group(graph, WATER_BODY, {WATER_COLOR.name: color, **mean_fresnel})[BSDF.name]
    with graph.section("Cycles"):
        reflection = use_group(graph, REFLECTION, slopes)[BSDF.name]
        cycles = graph.add_shaders(reflection, body)
    with graph.section("EEVEE"):
        variances = {socket.name: slopes[socket.name] for socket in SKY_REFLECTION.inputs[:2]}
        sky = use_group(graph, SKY_REFLECTION, variances | mean_fresnel)[BSDF.name]
        eevee = graph.add_shaders(sky, body)
    graph.output(CYCLES.name, cycles)
    graph.output(EEVEE.name, eevee)


WATER = GroupRecipe(
    "Ocean LOD Water",
    "1",
    inputs=(SLOPE_VARIANCE, WATER_COLOR, TINT, ROUGHNESS),
    outputs=(CYCLES, EEVEE),
    build=_build,
    needs=(SLOPES, MEAN_FRESNEL_OF_SLOPES, REFLECTION, WATER_BODY, SKY_REFLECTION),
)
