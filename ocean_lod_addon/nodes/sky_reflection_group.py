# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Sky Reflection": what EEVEE reflects besides the sun.

EEVEE shades every microfacet closure as isotropic GGX and knows no dielectric Fresnel for it. Here a white
Glossy closure gives where the reflected light comes from, and the reflected share of the visible facets how much
of it there is. That is a mix with nothing, and not the closure's color: EEVEE takes a dark color for a dark
Fresnel reflectance and then leaves out what bounces twice.

The share counts light from above the surface alone. So the closure must not look below it, where the sky is
dark, or the same light would be missing twice: its normal and roughness are those with which EEVEE sees the sky
where the facets mirror it from.
"""

from ..core.optics import eevee_closures
from ..core.optics.reflected_share import sine_of_source, source_variance
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import BSDF, MAJOR_VARIANCE, MINOR_VARIANCE, NORMAL, REFLECTED_SHARE, VIEW_COSINE, VIEW_SPREAD


def _build(graph: Graph):
    """Where the light comes from, the normal and roughness for it, one Glossy closure, its share."""
    ops = GraphOps(graph)
    with graph.section("Where the light comes from"):
        c = ops.maximum(graph.input(VIEW_COSINE.name), eevee_closures.COS_VIEW_MIN)
        sine = sine_of_source(ops, c, graph.input(VIEW_SPREAD.name))
        slope_variance = ops.sqrt(graph.input(MAJOR_VARIANCE.name) * graph.input(MINOR_VARIANCE.name))
        spread = source_variance(ops, c, slope_variance)
    with graph.section("Normal and roughness for it"):
        alpha = graph.label(eevee_closures.alpha_of_spread(ops, spread), "alpha")
        along_normal, along_view = eevee_closures.normal_towards(ops, c, sine, alpha)
        incoming = graph.output_of(graph.node("ShaderNodeNewGeometry"), "Incoming")
        normal = graph.input(NORMAL.name) * along_normal + incoming * along_view
        normal = graph.label(normal.normalized(), "normal of seen facets")
    with graph.section("Reflection"):
        white = {"Color": (1.0, 1.0, 1.0, 1.0), "Roughness": ops.sqrt(alpha), "Normal": normal}
        closure = graph.node("ShaderNodeBsdfGlossy", "Sky", white, distribution="MULTI_GGX")
        stored = graph.input(REFLECTED_SHARE.name) + eevee_closures.HALF_COLOR_STEP
        stored = graph.label(stored, "share as EEVEE stores it")
        reflected = graph.node("ShaderNodeMixShader", "Reflected share", {0: stored, 2: graph.output_of(closure)})
    graph.output(BSDF.name, graph.output_of(reflected))


SKY_REFLECTION = GroupRecipe(
    "Ocean LOD Sky Reflection",
    "5",
    inputs=(MAJOR_VARIANCE, MINOR_VARIANCE, REFLECTED_SHARE, VIEW_COSINE, VIEW_SPREAD, NORMAL),
    outputs=(BSDF,),
    build=_build,
)
