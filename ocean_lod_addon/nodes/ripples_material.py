# SPDX-License-Identifier: GPL-3.0-or-later
"""Ripples in an ocean's material: a group of its own between the mesh's slope variance and the water."""

from collections.abc import Sequence

import bpy
import numpy as np

from ..core.plan import RIPPLES_NODE
from ..core.ripples.bump import BumpLayout
from .groups import ensure_group, remove_unused
from .layout import place_beside
from .material import MATERIAL_KEY, NODE_NAME, own_nodes
from .ripples_group import WAVE_HEIGHT, ripples_recipe, variance_socket
from .sockets import NORMAL, SLOPE_VARIANCE

RIPPLES_NODE_NAME = RIPPLES_NODE
"""Name of the group node in a material."""


def ripples_group_name(material: bpy.types.Material) -> str:
    """The name that the ripples group of an ocean's material is made under."""
    return f"{RIPPLES_NODE_NAME} of {material[MATERIAL_KEY]}"


def show_ripples(material: bpy.types.Material, layout: BumpLayout, images: Sequence) -> None:
    """Make the material show ripples of this layout, with an image for each tile."""
    group = ensure_group(ripples_recipe(ripples_group_name(material), layout, images))
    tree = material.node_tree
    node = tree.nodes.get(RIPPLES_NODE_NAME)
    if node is None:
        _insert_node(tree, group)
    elif node.node_tree != group:
        node.node_tree = group


def _insert_node(tree, group):
    """The node before the water's; what was linked to the water's slope variance is linked to it instead."""
    water = tree.nodes[NODE_NAME]
    sources = [link.from_socket for link in water.inputs[SLOPE_VARIANCE.name].links]
    node = tree.nodes.new("ShaderNodeGroup")
    node.name = node.label = RIPPLES_NODE_NAME
    node.node_tree = group
    for source in sources:
        tree.links.new(source, node.inputs[SLOPE_VARIANCE.name])
    for name in (SLOPE_VARIANCE.name, NORMAL.name):
        tree.links.new(node.outputs[name], water.inputs[name])
    place_beside(tree, node, water, own_nodes(tree), left=True)


def hide_ripples(material: bpy.types.Material) -> None:
    """Make the material show no ripples, and remove their group."""
    tree = material.node_tree
    node = tree.nodes.get(RIPPLES_NODE_NAME)
    if node is None:
        return
    sources = [link.from_socket for link in node.inputs[SLOPE_VARIANCE.name].links]
    targets = [link.to_socket for link in node.outputs[SLOPE_VARIANCE.name].links]
    for source in sources:
        for target in targets:
            tree.links.new(source, target)
    group = node.node_tree
    tree.nodes.remove(node)
    remove_unused(group)


def set_ripple_values(material: bpy.types.Material, tensors: np.ndarray, wave_height: float) -> None:
    """The slope variances (bands, 3) of the bands and the significant wave height in m; for every frame.

    Only sockets that hold something else are written, since every write makes the renderers update the material.
    """
    node = material.node_tree.nodes.get(RIPPLES_NODE_NAME)
    if node is None:
        return
    for index, tensor in enumerate(tensors):
        socket = node.inputs[variance_socket(index).name]
        if not np.array_equal(np.float32(tuple(socket.default_value)), np.float32(tensor)):
            socket.default_value = tuple(map(float, tensor))
    if WAVE_HEIGHT.name in node.inputs:
        socket = node.inputs[WAVE_HEIGHT.name]
        if np.float32(socket.default_value) != np.float32(wave_height):
            socket.default_value = wave_height
