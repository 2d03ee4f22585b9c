# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Sky Reflection": what EEVEE reflects besides the sun.

EEVEE shades every microfacet closure as isotropic GGX and knows no dielectric Fresnel for it. Here a white
Glossy closure of matched roughness gives where the reflected light comes from, and the reflected
share of the visible facets how much of it there is. That is a mix with nothing, and not the closure's
color: EEVEE takes a dark color for a dark Fresnel reflectance and then leaves out what bounces twice.
"""

from ..core.optics import beckmann
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import BSDF, MAJOR_VARIANCE, MINOR_VARIANCE, NORMAL, REFLECTED_SHARE


def _build(graph: Graph):
    """One Glossy closure, roughness from the geometric mean of the two slope deviations."""
    ops = GraphOps(graph)
    with graph.section("Slope variance to roughness"):
        major, minor = graph.input(MAJOR_VARIANCE.name), graph.input(MINOR_VARIANCE.name)
        roughness = beckmann.glossy_sockets(ops, major, minor).roughness
    with graph.section("Reflection"):
        white = {"Color": (1.0, 1.0, 1.0, 1.0), "Roughness": roughness, "Normal": graph.input(NORMAL.name)}
        closure = graph.node("ShaderNodeBsdfGlossy", "Sky", white, distribution="MULTI_GGX")
        share = {0: graph.input(REFLECTED_SHARE.name), 2: graph.output_of(closure)}
        reflected = graph.node("ShaderNodeMixShader", "Reflected share", share)
    graph.output(BSDF.name, graph.output_of(reflected))


SKY_REFLECTION = GroupRecipe(
    "Ocean LOD Sky Reflection",
    "4",
    inputs=(MAJOR_VARIANCE, MINOR_VARIANCE, REFLECTED_SHARE, NORMAL),
    outputs=(BSDF,),
    build=_build,
)
