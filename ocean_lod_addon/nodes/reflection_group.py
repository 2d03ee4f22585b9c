# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Reflection": the Ross BRDF as Cycles' own closure.

The Ross BRDF is an anisotropic Beckmann microfacet BRDF (THEORY section 6). From Blender 5.0 on the Metallic
closure's physical conductor with extinction 0 is the exact Fresnel reflectance of a dielectric. Before, it is
an approximation that is wrong for water by up to a factor of 2, and F82 with a white edge tint is used, which
is Schlick's formula (the paper's Eq. 25).
"""

import bpy

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics import beckmann, fresnel
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import BSDF, MAJOR_VARIANCE, MINOR_VARIANCE, NORMAL, TANGENT

HAS_EXACT_FRESNEL = bpy.app.version >= (5, 0, 0)
"""Whether the Metallic closure of this Blender computes the Fresnel reflectance of water exactly."""


def _fresnel_settings():
    """Sockets and fresnel_type of a Metallic closure that reflects as water does."""
    if HAS_EXACT_FRESNEL:
        index = (WATER_REFRACTIVE_INDEX,) * 3
        return {"IOR": index, "Extinction": (0.0, 0.0, 0.0)}, "PHYSICAL_CONDUCTOR"
    R = fresnel.normal_incidence(WATER_REFRACTIVE_INDEX)
    return {"Base Color": (R, R, R, 1.0), "Edge Tint": (1.0, 1.0, 1.0, 1.0)}, "F82"


def _build(graph: Graph):
    """Roughness and anisotropy from the two variances, into one Metallic closure."""
    ops = GraphOps(graph)
    with graph.section("Slope variance to roughness"):
        major, minor = graph.input(MAJOR_VARIANCE.name), graph.input(MINOR_VARIANCE.name)
        shape = beckmann.metallic_sockets(ops, major, minor)
    with graph.section("Ross BRDF"):
        sockets, fresnel_type = _fresnel_settings()
        sockets |= {"Roughness": shape.roughness, "Anisotropy": shape.anisotropy}
        sockets |= {name: graph.input(name) for name in (NORMAL.name, TANGENT.name)}
        closure = graph.node(
            "ShaderNodeBsdfMetallic",
            "Water surface",
            sockets,
            distribution="BECKMANN",
            fresnel_type=fresnel_type,
        )
    graph.output(BSDF.name, graph.output_of(closure))


REFLECTION = GroupRecipe(
    "Ocean LOD Reflection",
    "2 exact" if HAS_EXACT_FRESNEL else "2 schlick",
    inputs=(MAJOR_VARIANCE, MINOR_VARIANCE, TANGENT, NORMAL),
    outputs=(BSDF,),
    build=_build,
)
