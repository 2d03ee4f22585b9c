# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Sunlit Body": the water body in the light of a sun that EEVEE does not know.

EEVEE leaves out the disc of a Sky Texture, and with it most of the light on the sea. The body is a diffuse
reflector, so what the disc adds to it is one cosine.
"""

import math

from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import BSDF, NORMAL, REFLECTED_SHARE, SUN_DIRECTION, SUN_IRRADIANCE, WATER_COLOR


def _build(graph: Graph):
    """Reflectance over pi, times the sun's irradiance on the surface, times what the surface lets through."""
    ops = GraphOps(graph)
    with graph.section("Irradiance on the surface"):
        cos_sun = ops.maximum(graph.input(NORMAL.name).dot(graph.input(SUN_DIRECTION.name)), 0.0)
        cos_sun = graph.label(cos_sun, "cos of sun angle")
    with graph.section("Radiance"):
        transmitted = graph.label(1.0 - graph.input(REFLECTED_SHARE.name), "transmitted share")
        color = graph.input(WATER_COLOR.name).times(graph.input(SUN_IRRADIANCE.name))
        strength = cos_sun * transmitted * (1.0 / math.pi)
        emission = graph.node("ShaderNodeEmission", "Sunlit water", {"Color": color, "Strength": strength})
    graph.output(BSDF.name, graph.output_of(emission))


SUNLIT_BODY = GroupRecipe(
    "Ocean LOD Sunlit Body",
    "3",
    inputs=(WATER_COLOR, REFLECTED_SHARE, NORMAL, SUN_DIRECTION, SUN_IRRADIANCE),
    outputs=(BSDF,),
    build=_build,
)
