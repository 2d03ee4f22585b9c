# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Water Body": the light that comes back out of the water.

The water-leaving radiance of deep water is nearly the same in every direction, so the body is a diffuse
reflector of the water's reflectance. It lies under the surface: what the surface reflects does not reach the
eye from below, hence the factor 1 - mean Fresnel.
"""

from .graph import Graph
from .groups import GroupRecipe
from .sockets import BSDF, MEAN_FRESNEL, WATER_COLOR


def _build(graph: Graph):
    """A diffuse closure of the water's colour times what the surface lets through."""
    with graph.section("Transmitted light"):
        transmitted = graph.label(1.0 - graph.input(MEAN_FRESNEL.name), "transmitted share")
        color = graph.input(WATER_COLOR.name) * transmitted
        closure = graph.node("ShaderNodeBsdfDiffuse", "Upwelling light", {"Color": color})
    graph.output(BSDF.name, graph.output_of(closure))


WATER_BODY = GroupRecipe(
    "Ocean LOD Water Body", "1", inputs=(WATER_COLOR, MEAN_FRESNEL), outputs=(BSDF,), build=_build
)
