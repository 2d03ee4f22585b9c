# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups "Ocean LOD Clear Water": the material of water that one looks into.

Cycles refracts, and a volume with the water's own absorption and backscattering does the rest: shallow water shows
its bottom, deep water its color, without a setting for either. EEVEE refracts what is on the screen and dims it
as water of one depth does, which the artist states.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics import beckmann
from .clear_surface_group import CLEAR_SURFACE, RADIANCE_OUT_OF_WATER, REFLECTION_FROM_ABOVE
from .graph import Color, Graph, GraphOps, Shader
from .groups import GroupRecipe, use_group
from .sockets import (
    ABSORPTION,
    BACKSCATTERING,
    BSDF,
    CYCLES,
    EEVEE,
    EEVEE_DEPTH,
    MAJOR_VARIANCE,
    MINOR_VARIANCE,
    NORMAL,
    REFLECTED_SHARE,
    VOLUME,
    WATER_COLOR,
)
from .sun_group import SKEWED_SUN, SUN
from .water_group import (
    PARTS,
    SKEWED_SOCKETS,
    WATER_SOCKETS,
    cycles_reflection,
    eevee_body,
    eevee_reflection,
    eevee_sunlit_body,
    surface,
)

CLEAR_SOCKETS = (*WATER_SOCKETS, ABSORPTION, BACKSCATTERING, EEVEE_DEPTH)


def _cycles_surface(graph: Graph, values: dict, sun: GroupRecipe) -> Shader:
    above = graph.add_shaders(*cycles_reflection(graph, values, sun))
    return use_group(graph, CLEAR_SURFACE, values | {REFLECTION_FROM_ABOVE.name: above})[BSDF.name]


def _volume(graph: Graph, values: dict) -> Shader:
    """Isotropic scattering sends half of the light back: twice the backscattering gives the right half.

    Good while little light is scattered twice; in turbid water, where one sees nothing anyway, half too dark.
    """
    volume = graph.node(
        "ShaderNodeVolumeCoefficients",
        "Water",
        {
            "Absorption Coefficients": values[ABSORPTION.name],
            "Scatter Coefficients": values[BACKSCATTERING.name] * 2.0,
            "Anisotropy": 0.0,
        },
    )
    return graph.output_of(volume)


def _transmittance(graph: Graph, values: dict) -> Color:
    """What water of the stated depth leaves of light that crosses it once, per channel."""
    ops = GraphOps(graph)
    path = values[ABSORPTION.name] * values[EEVEE_DEPTH.name]
    channels = (ops.exp(-component) for component in path.components())
    return graph.label(graph.vector(*channels), "transmittance")


def _eevee_refraction(graph: Graph, values: dict, transmittance: Color) -> Shader:
    ops = GraphOps(graph)
    roughness = beckmann.glossy_sockets(ops, values[MAJOR_VARIANCE.name], values[MINOR_VARIANCE.name]).roughness
    transmitted = graph.label(1.0 - values[REFLECTED_SHARE.name], "transmitted share")
    inputs = {
        "Color": transmittance * (transmitted * RADIANCE_OUT_OF_WATER),
        "Roughness": roughness,
        "IOR": WATER_REFRACTIVE_INDEX,
        "Normal": values[NORMAL.name],
    }
    return graph.output_of(graph.node("ShaderNodeBsdfRefraction", "Bottom", inputs, distribution="GGX"))


def _build(graph: Graph, sockets, sun: GroupRecipe):
    """Refraction instead of a body in Cycles; in EEVEE both, in the proportion that the depth decides."""
    values = surface(graph, sockets)
    with graph.section("Cycles"):
        cycles = _cycles_surface(graph, values, sun)
    with graph.section("Cycles volume"):
        volume = _volume(graph, values)
    with graph.section("Water of one depth"):
        transmittance = _transmittance(graph, values)
        white = graph.vector(1.0, 1.0, 1.0)
        deep = graph.label(white - transmittance.times(transmittance), "share of deep water's light")
        seen = values | {WATER_COLOR.name: values[WATER_COLOR.name].times(deep)}
        refraction = _eevee_refraction(graph, values, transmittance)
    with graph.section("EEVEE"):
        below = (refraction, eevee_body(graph, seen), eevee_sunlit_body(graph, seen))
        eevee = graph.add_shaders(*eevee_reflection(graph, values, sun), *below)
    graph.output(CYCLES.name, cycles)
    graph.output(EEVEE.name, eevee)
    graph.output(VOLUME.name, volume)


def _recipe(name, sockets, sun):
    return GroupRecipe(
        name,
        "5",
        sockets,
        (CYCLES, EEVEE, VOLUME),
        lambda graph: _build(graph, sockets, sun),
        needs=(*PARTS, sun, CLEAR_SURFACE),
    )


CLEAR_WATER = _recipe("Ocean LOD Clear Water", CLEAR_SOCKETS, SUN)
SKEWED_CLEAR_WATER = _recipe("Ocean LOD Skewed Clear Water", CLEAR_SOCKETS + SKEWED_SOCKETS, SKEWED_SUN)
