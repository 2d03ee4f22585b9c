# SPDX-License-Identifier: GPL-3.0-or-later
"""A geometry node group that hands its geometry on as it is."""

import bpy

from .groups import GROUP_KEY, find_group

_NAME = "Ocean LOD Pass-Through"
_GEOMETRY = "Geometry"


def ensure_pass_through() -> bpy.types.NodeTree:
    """The group, made where the file has none: Group Input to Group Output, and nothing between."""
    tree = find_group(_NAME)
    if tree is not None:
        return tree
    tree = bpy.data.node_groups.new(_NAME, "GeometryNodeTree")
    tree[GROUP_KEY] = _NAME
    tree.is_modifier = True
    tree.description = "Changes nothing. It tells Blender that the ocean's mesh moves, for motion blur and export"
    for direction in ("INPUT", "OUTPUT"):
        tree.interface.new_socket(_GEOMETRY, in_out=direction, socket_type="NodeSocketGeometry")
    inside, outside = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    outside.location.x = inside.width + 100.0
    tree.links.new(inside.outputs[_GEOMETRY], outside.inputs[_GEOMETRY])
    return tree
