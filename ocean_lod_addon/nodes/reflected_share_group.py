# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Reflected Share": how much a rough sea reflects towards the viewer.

Never the Fresnel reflectance of the mean plane: near the horizon the visible facets lean towards the viewer,
and the sea reflects half as much, or less.
"""

from ..core.constants import WATER_REFRACTIVE_INDEX
from ..core.optics.reflected_share import reflected_share
from ..core.optics.smith import slope_spread
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import (
    MAJOR_VARIANCE,
    MINOR_VARIANCE,
    NORMAL,
    REFLECTED_SHARE,
    TANGENT,
    VIEW_COSINE,
    VIEW_SPREAD,
)
from .surface_frame import SurfaceFrame


def _build(graph: Graph):
    """The direction to the viewer in the surface's axes, the slope deviation along it, the fit."""
    ops = GraphOps(graph)
    with graph.section("View direction"):
        x, y, z = SurfaceFrame(graph, graph.input(TANGENT.name), graph.input(NORMAL.name)).view()
        cos_view = graph.label(ops.minimum(ops.maximum(z, 0.0), 1.0), "cos of view angle")
    with graph.section("Slope spread along the view"):
        major, minor = graph.input(MAJOR_VARIANCE.name), graph.input(MINOR_VARIANCE.name)
        s_v = slope_spread(ops, x, y, ops.sqrt(major), ops.sqrt(minor))
    with graph.section("Reflected share"):
        result = reflected_share(ops, cos_view, s_v, WATER_REFRACTIVE_INDEX)
    graph.output(REFLECTED_SHARE.name, result)
    graph.output(VIEW_COSINE.name, cos_view)
    graph.output(VIEW_SPREAD.name, s_v)


REFLECTED_SHARE_OF_SLOPES = GroupRecipe(
    "Ocean LOD Reflected Share",
    "3",
    inputs=(MAJOR_VARIANCE, MINOR_VARIANCE, TANGENT, NORMAL),
    outputs=(REFLECTED_SHARE, VIEW_COSINE, VIEW_SPREAD),
    build=_build,
)
