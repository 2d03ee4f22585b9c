# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Foam": foam over the water's surface, for each engine.

The texture is looked up where the water stands at rest, so that foam moves along with it.
"""

from ..core.foam import shading
from ..core.plan import FOAM_ATTRIBUTE, REST_POSITION_ATTRIBUTE, WHITECAPS_ATTRIBUTE
from .graph import Graph, GraphOps
from .groups import GroupRecipe, Socket, use_group
from .ripple_parts import PIXEL_PROPERTY
from .sockets import (
    BSDF,
    CYCLES,
    EEVEE,
    MISSING_SUN,
    NORMAL,
    REFLECTED_SHARE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    WATER_COLOR,
)
from .sunlit_body_group import SUNLIT_BODY

CYCLES_BELOW = Socket("Water in Cycles", "SHADER", "The water that the foam lies on, for Cycles")
EEVEE_BELOW = Socket("Water in EEVEE", "SHADER", "The water that the foam lies on, for EEVEE")
COVERAGE = Socket("Coverage", "FLOAT", "Share of the whole sea that is white", 0.01, 0.0, 1.0, "FACTOR")
GRAIN = Socket("Grain", "FLOAT", "Size of the largest patches and holes, m", 1.0, 0.01, 100.0, "DISTANCE")
FOAM_COLOR = Socket("Foam Color", "COLOR", "Reflectance of dense fresh foam, linear RGB", (0.55, 0.55, 0.55, 1.0))


def _attribute(graph: Graph, name: str, kind="GEOMETRY"):
    return graph.node("ShaderNodeAttribute", name, attribute_name=name, attribute_type=kind)


def _build(graph: Graph):
    """The share that foam hides, and a diffuse layer mixed in by it."""
    ops = GraphOps(graph)
    with graph.section("Texture"):
        rest = graph.output_of(_attribute(graph, REST_POSITION_ATTRIBUTE), "Vector")
        grain = graph.input(GRAIN.name)
        noise = graph.node(
            "ShaderNodeTexNoise",
            "broken foam",
            {
                "Vector": rest / grain,
                "Scale": 1.0,
                "Detail": shading.NOISE_DETAIL,
                "Roughness": shading.NOISE_ROUGHNESS,
            },
            noise_dimensions="2D",
        )
        texture = shading.filaments(ops, graph.output_of(noise, 0))
    with graph.section("Pixel"):
        distance = graph.output_of(graph.node("ShaderNodeCameraData"), "View Distance")
        angle, size, _ = graph.output_of(_attribute(graph, PIXEL_PROPERTY, "OBJECT"), "Vector").components()
        pixel = graph.label(ops.multiply_add(distance, angle, size) / grain, "pixel over grain")
    with graph.section("Hidden share"):
        foam = graph.output_of(_attribute(graph, FOAM_ATTRIBUTE), "Fac")
        whitecaps = graph.output_of(_attribute(graph, WHITECAPS_ATTRIBUTE), "Fac")
        coverage = graph.input(COVERAGE.name)
        hidden = shading.hidden_share(ops, foam, whitecaps, coverage, texture, pixel)
        hidden = graph.label(hidden, "hidden share")
    with graph.section("Foam"):
        color = graph.input(FOAM_COLOR.name)
        diffuse = graph.output_of(graph.node("ShaderNodeBsdfDiffuse", "Foam", {"Color": color}))
        cycles = graph.mix_shaders(hidden, graph.input(CYCLES_BELOW.name), diffuse)
        graph.output(CYCLES.name, cycles)
    with graph.section("Foam in EEVEE"):
        missing = graph.input(SUN_IRRADIANCE.name) * graph.input(MISSING_SUN.name)
        values = {
            WATER_COLOR.name: graph.input(FOAM_COLOR.name),
            REFLECTED_SHARE.name: 0.0,
            NORMAL.name: graph.output_of(graph.node("ShaderNodeNewGeometry"), "Normal"),
            SUN_DIRECTION.name: graph.input(SUN_DIRECTION.name),
            SUN_IRRADIANCE.name: graph.label(missing, "sun that EEVEE leaves out"),
        }
        lit = graph.add_shaders(diffuse, use_group(graph, SUNLIT_BODY, values)[BSDF.name])
        graph.output(EEVEE.name, graph.mix_shaders(hidden, graph.input(EEVEE_BELOW.name), lit))


FOAM = GroupRecipe(
    "Ocean LOD Foam",
    "1",
    inputs=(
        CYCLES_BELOW,
        EEVEE_BELOW,
        FOAM_COLOR,
        COVERAGE,
        GRAIN,
        SUN_DIRECTION,
        SUN_IRRADIANCE,
        MISSING_SUN,
    ),
    outputs=(CYCLES, EEVEE),
    build=_build,
    needs=(SUNLIT_BODY,),
)
