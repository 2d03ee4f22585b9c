# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Mean Fresnel": how much a rough sea reflects towards the viewer.

Never the Fresnel reflectance of the mean plane: near the horizon the visible facets lean towards the viewer,
and the sea reflects half as much, or less.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics.fresnel import normal_incidence
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import MAJOR_VARIANCE, MEAN_FRESNEL, MINOR_VARIANCE, TANGENT
from .surface_frame import SurfaceFrame


def _mean_fresnel(ops, cos_view, s):
    R = normal_incidence(WATER_REFRACTIVE_INDEX)
    exponent = 5.403 * ops.exp(-4.049 * s)
    return R + (1.0 - R) * ops.power(1.0 - cos_view, exponent) / (1.0 + 22.91 * ops.power(s, 1.379))


def _build(graph: Graph):
    """The direction to the viewer in the surface's axes, the slope deviation along it, the fit."""
    ops = GraphOps(graph)
    with graph.section("View direction"):
        x, y, z = SurfaceFrame(graph, graph.input(TANGENT.name)).view()
        cos_view = graph.label(ops.minimum(ops.maximum(z, 0.0), 1.0), "cos of view angle")
    with graph.section("Slope deviation along the view"):
        x2, y2 = x * x, y * y
        along = ops.multiply_add(x2, graph.input(MAJOR_VARIANCE.name), y2 * graph.input(MINOR_VARIANCE.name))
        s = graph.label(ops.sqrt(along / ops.maximum(x2 + y2, 1e-9)), "sigma along view")
    with graph.section("Mean Fresnel"):
        result = _mean_fresnel(ops, cos_view, s)
    graph.output(MEAN_FRESNEL.name, result)


MEAN_FRESNEL_OF_SLOPES = GroupRecipe(
    "Ocean LOD Mean Fresnel",
    "1",
    inputs=(MAJOR_VARIANCE, MINOR_VARIANCE, TANGENT),
    outputs=(MEAN_FRESNEL,),
    build=_build,
)
