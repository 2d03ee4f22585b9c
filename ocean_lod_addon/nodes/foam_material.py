# SPDX-License-Identifier: GPL-3.0-or-later
"""Foam in an ocean's material: a group of its own between the water and whatever its surfaces are linked to."""

import bpy

from ..core.foam_settings import Foam
from ..core.plan import FOAM_NODE
from .foam_group import COVERAGE, CYCLES_BELOW, EEVEE_BELOW, FOAM, FOAM_COLOR, GRAIN
from .groups import ensure_group, remove_unused
from .layout import place_beside
from .material import NODE_NAME, own_nodes, write_changed, write_socket
from .sockets import CYCLES, EEVEE, MISSING_SUN, SUN_DIRECTION, SUN_IRRADIANCE

FOAM_NODE_NAME = FOAM_NODE
"""Name of the group node in a material."""

_THROUGH = ((CYCLES, CYCLES_BELOW), (EEVEE, EEVEE_BELOW))
_SUN_SOCKETS = (SUN_DIRECTION, SUN_IRRADIANCE, MISSING_SUN)


def show_foam(material: bpy.types.Material, settings: Foam, coverage: float) -> None:
    """Make the material show foam, which covers the share `coverage` of the sea."""
    tree = material.node_tree
    if FOAM_NODE_NAME not in tree.nodes:
        _insert_node(tree, ensure_group(FOAM))
    node = tree.nodes[FOAM_NODE_NAME]
    write_changed(
        node,
        node.inputs,
        {
            FOAM_COLOR.name: [settings.reflectance] * 3 + [1.0],
            COVERAGE.name: coverage,
            GRAIN.name: settings.grain,
        },
    )
    follow_sun(material)


def follow_sun(material: bpy.types.Material) -> None:
    """Tell the foam which sun the water has."""
    nodes = material.node_tree.nodes
    if FOAM_NODE_NAME in nodes:
        for socket in _SUN_SOCKETS:
            value = nodes[NODE_NAME].inputs[socket.name].default_value
            write_socket(nodes[FOAM_NODE_NAME].inputs[socket.name], value)


def _insert_node(tree, group):
    """The node behind the water's; what the water's surfaces were linked to is linked to it instead."""
    water = tree.nodes[NODE_NAME]
    node = tree.nodes.new("ShaderNodeGroup")
    node.name = node.label = FOAM_NODE_NAME
    node.node_tree = group
    for surface, below in _THROUGH:
        targets = [link.to_socket for link in water.outputs[surface.name].links]
        tree.links.new(water.outputs[surface.name], node.inputs[below.name])
        for target in targets:
            tree.links.new(node.outputs[surface.name], target)
    place_beside(tree, node, water, own_nodes(tree), left=False)


def hide_foam(material: bpy.types.Material) -> None:
    """Make the material show no foam."""
    tree = material.node_tree
    node = tree.nodes.get(FOAM_NODE_NAME)
    if node is None:
        return
    for surface, below in _THROUGH:
        sources = [link.from_socket for link in node.inputs[below.name].links]
        targets = [link.to_socket for link in node.outputs[surface.name].links]
        for source in sources:
            for target in targets:
                tree.links.new(source, target)
    group = node.node_tree
    tree.nodes.remove(node)
    remove_unused(group)
