# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Slopes": from the mesh's slope variance tensor to a closure's axes."""

from ..core.optics.principal_slopes import principal_slopes
from .graph import Graph, GraphOps
from .groups import GroupRecipe
from .sockets import MAJOR_VARIANCE, MINOR_VARIANCE, ROUGHNESS, SLOPE_VARIANCE, TANGENT
from .surface_frame import to_world


def _build(graph: Graph):
    """Scale the tensor by the artist's roughness, find its axes, turn the major one into world space."""
    ops = GraphOps(graph)
    with graph.section("Roughness"):
        roughness = graph.input(ROUGHNESS.name)
        tensor = graph.input(SLOPE_VARIANCE.name) * graph.label(roughness * roughness, "variance factor")
        variance_xx, variance_yy, covariance_xy = tensor.components()
    with graph.section("Principal slopes"):
        major, minor, axis_x, axis_y = principal_slopes(ops, variance_xx, variance_yy, covariance_xy)
    with graph.section("To world space"):
        tangent = to_world(graph, graph.vector(axis_x, axis_y, 0.0), "Rougher axis")
    graph.output(SLOPE_VARIANCE.name, tensor)
    graph.output(MAJOR_VARIANCE.name, major)
    graph.output(MINOR_VARIANCE.name, minor)
    graph.output(TANGENT.name, tangent)


SLOPES = GroupRecipe(
    "Ocean LOD Slopes",
    "2",
    inputs=(SLOPE_VARIANCE, ROUGHNESS),
    outputs=(SLOPE_VARIANCE, MAJOR_VARIANCE, MINOR_VARIANCE, TANGENT),
    build=_build,
)
