# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Clear Water": the material of water that one looks into.

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
    REFLECTED_SHARE,
    VOLUME,
)
from .water_group import (
    PARTS,
    WATER_SOCKETS,
    Surface,
    body,
    cycles_reflection,
    eevee_reflection,
    eevee_sunlit_body,
    surface,
)


def _cycles_surface(graph: Graph, parts: Surface) -> Shader:
    closure, sun = cycles_reflection(graph, parts)
    above = graph.add_shaders(closure, sun)
    variances = {socket.name: parts.slopes[socket.name] for socket in (MAJOR_VARIANCE, MINOR_VARIANCE)}
    inputs = {REFLECTION_FROM_ABOVE.name: above, **variances, **parts.reflected_share, **parts.normal}
    return use_group(graph, CLEAR_SURFACE, inputs)[BSDF.name]


def _volume(graph: Graph) -> Shader:
    """Isotropic scattering sends half of the light back: twice the backscattering gives the right half.

    Good while little light is scattered twice; in turbid water, where one sees nothing anyway, half too dark.
    """
    volume = graph.node(
        "ShaderNodeVolumeCoefficients",
        "Water",
        {
            "Absorption Coefficients": graph.input(ABSORPTION.name),
            "Scatter Coefficients": graph.input(BACKSCATTERING.name) * 2.0,
            "Anisotropy": 0.0,
        },
    )
    return graph.output_of(volume)


def _transmittance(graph: Graph) -> Color:
    """What water of the stated depth leaves of light that crosses it once, per channel."""
    ops = GraphOps(graph)
    path = graph.input(ABSORPTION.name) * graph.input(EEVEE_DEPTH.name)
    channels = (ops.exp(-component) for component in path.components())
    return graph.label(graph.vector(*channels), "transmittance")


def _eevee_refraction(graph: Graph, parts: Surface, transmittance: Color) -> Shader:
    ops = GraphOps(graph)
    variances = (parts.slopes[socket.name] for socket in (MAJOR_VARIANCE, MINOR_VARIANCE))
    roughness = beckmann.glossy_sockets(ops, *variances).roughness
    transmitted = graph.label(1.0 - parts.reflected_share[REFLECTED_SHARE.name], "transmitted share")
    leaving = transmittance * (transmitted * RADIANCE_OUT_OF_WATER)
    inputs = {"Color": leaving, "Roughness": roughness, "IOR": WATER_REFRACTIVE_INDEX, **parts.normal}
    return graph.output_of(graph.node("ShaderNodeBsdfRefraction", "Bottom", inputs, distribution="GGX"))


def _build(graph: Graph):
    """Refraction instead of a body in Cycles; in EEVEE both, in the proportion that the depth decides."""
    parts = surface(graph)
    with graph.section("Cycles"):
        cycles = _cycles_surface(graph, parts)
    with graph.section("Cycles volume"):
        volume = _volume(graph)
    with graph.section("Water of one depth"):
        transmittance = _transmittance(graph)
        white = graph.vector(1.0, 1.0, 1.0)
        deep = graph.label(white - transmittance.times(transmittance), "share of deep water's light")
        color = parts.color.times(deep)
        refraction = _eevee_refraction(graph, parts, transmittance)
    with graph.section("EEVEE"):
        below = (refraction, body(graph, parts, color), eevee_sunlit_body(graph, parts, color))
        eevee = graph.add_shaders(*eevee_reflection(graph, parts), *below)
    graph.output(CYCLES.name, cycles)
    graph.output(EEVEE.name, eevee)
    graph.output(VOLUME.name, volume)


CLEAR_WATER = GroupRecipe(
    "Ocean LOD Clear Water",
    "3",
    inputs=(*WATER_SOCKETS, ABSORPTION, BACKSCATTERING, EEVEE_DEPTH),
    outputs=(CYCLES, EEVEE, VOLUME),
    build=_build,
    needs=(*PARTS, CLEAR_SURFACE),
)
