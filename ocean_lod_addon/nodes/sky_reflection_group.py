# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Sky Reflection": what EEVEE reflects besides the sun.

EEVEE shades every microfacet closure as isotropic GGX and knows no dielectric Fresnel for it. Here a white
Glossy closure of matched roughness gives where the reflected light comes from, and the mean Fresnel
reflectance over the visible facets how much of it is reflected.
"""

from ..core.optics import beckmann
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import BSDF, MAJOR_VARIANCE, MEAN_FRESNEL, MINOR_VARIANCE


def _build(graph: Graph):
    """One Glossy closure, roughness from the geometric mean of the two slope deviations."""
    ops = GraphOps(graph)
    with graph.section("Slope variance to roughness"):
        major, minor = graph.input(MAJOR_VARIANCE.name), graph.input(MINOR_VARIANCE.name)
        roughness = beckmann.glossy_sockets(ops, major, minor).roughness
    with graph.section("Reflection"):
        mean_fresnel = graph.input(MEAN_FRESNEL.name)
        closure = graph.node(
            "ShaderNodeBsdfGlossy", "Sky", {"Color": mean_fresnel, "Roughness": roughness}, distribution="GGX"
        )
    graph.output(BSDF.name, graph.output_of(closure))


SKY_REFLECTION = GroupRecipe(
    "Ocean LOD Sky Reflection",
    "1",
    inputs=(MAJOR_VARIANCE, MINOR_VARIANCE, MEAN_FRESNEL),
    outputs=(BSDF,),
    build=_build,
)
