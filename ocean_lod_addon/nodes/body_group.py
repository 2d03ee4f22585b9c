# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Water Body": the light that comes back out of the water.

The water-leaving radiance of deep water is nearly the same in every direction, so the body is a diffuse
reflector of the water's reflectance. It lies under the surface: what the surface reflects does not come from
below, and where the surface mirrors the eye downwards the water shows, too. Hence the factor 1 - reflected share.
"""

from .graph import Graph
from .groups import GroupRecipe
from .sockets import BSDF, NORMAL, REFLECTED_SHARE, WATER_COLOR


def _build(graph: Graph):
    """A diffuse closure of the water's colour times what the surface lets through."""
    with graph.section("Transmitted light"):
        transmitted = graph.label(1.0 - graph.input(REFLECTED_SHARE.name), "transmitted share")
        color = graph.input(WATER_COLOR.name) * transmitted
        inputs = {"Color": color, "Normal": graph.input(NORMAL.name)}
        closure = graph.node("ShaderNodeBsdfDiffuse", "Upwelling light", inputs)
    graph.output(BSDF.name, graph.output_of(closure))


WATER_BODY = GroupRecipe(
    "Ocean LOD Water Body", "3", inputs=(WATER_COLOR, REFLECTED_SHARE, NORMAL), outputs=(BSDF,), build=_build
)
