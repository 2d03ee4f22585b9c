# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups that are built once and rebuilt only when their build version changes."""

from collections.abc import Callable
from dataclasses import dataclass

import bpy

from .graph import Graph
from .layout import arrange

GROUP_KEY = "ocean_lod_group"
"""Custom property of a node group that this extension made: the name it was made under."""

VERSION_KEY = "ocean_lod_build_version"
"""Custom property of such a group: what it was built from."""


NAME_PREFIX = "Ocean LOD "
"""What tells our groups apart in a file; within a group of ours it goes without saying."""


@dataclass(frozen=True)
class Socket:
    """A socket of a group. `kind` is FLOAT, VECTOR, COLOR or SHADER; `subtype` as Blender names it.

    `panel` is the title of a fold of the group's node that the socket is in, closed at first; empty for none.
    """

    name: str
    kind: str
    description: str = ""
    default: object = None
    minimum: float | None = None
    maximum: float | None = None
    subtype: str = "NONE"
    hide_value: bool = False
    panel: str = ""


_SOCKET_TYPES = {
    "FLOAT": "NodeSocketFloat",
    "VECTOR": "NodeSocketVector",
    "COLOR": "NodeSocketColor",
    "SHADER": "NodeSocketShader",
}


@dataclass(frozen=True)
class GroupRecipe:
    """How a group is made: `build` fills a graph; raise `version` whenever its result changes.

    `needs` are the recipes of the groups used inside: a change of one of them rebuilds this one as well.
    """

    name: str
    version: str
    inputs: tuple[Socket, ...]
    outputs: tuple[Socket, ...]
    build: Callable[[Graph], None]
    needs: tuple["GroupRecipe", ...] = ()

    @property
    def full_version(self) -> str:
        """The version of this group and of everything inside it."""
        inner = ",".join(f"{recipe.name}={recipe.full_version}" for recipe in self.needs)
        return f"{self.version}({inner})" if inner else self.version


def find_group(name: str):
    """The group that was made under `name`, whatever it is called by now, or None."""
    made_by_us = [
        tree for tree in bpy.data.node_groups if tree.library is None and tree.get(GROUP_KEY) == name
    ]
    return min(made_by_us, key=lambda tree: (tree.name != name, tree.name), default=None)


def ensure_group(recipe: GroupRecipe) -> bpy.types.NodeTree:
    """The group of `recipe`: the existing one where its build version is current, else built anew in place.

    Rebuilding keeps the sockets whose name and type stay, so that links to the group in an artist's own
    nodes survive.
    """
    for inner in recipe.needs:
        ensure_group(inner)
    tree = find_group(recipe.name)
    if tree is None:
        tree = bpy.data.node_groups.new(recipe.name, "ShaderNodeTree")
        tree[GROUP_KEY] = recipe.name
    if tree.get(VERSION_KEY) != recipe.full_version:
        tree.nodes.clear()
        graph = Graph(tree)
        _declare_sockets(tree, recipe)
        for socket in recipe.inputs:
            graph.declare_input(socket.name, socket.kind)
        recipe.build(graph)
        graph.finish()
        arrange(tree)
        tree[VERSION_KEY] = recipe.full_version
    return tree


def remove_unused(tree) -> None:
    """Remove a group of ours that nothing uses any more, and those inside it that only it used."""
    if tree is None or tree.users or GROUP_KEY not in tree:
        return
    inner = {node.node_tree.name for node in tree.nodes if node.type == "GROUP" and node.node_tree is not None}
    bpy.data.node_groups.remove(tree)
    for name in inner:
        remove_unused(bpy.data.node_groups.get(name))  # one of the others may have taken it along


def _declare_sockets(tree, recipe):
    """Make the interface of `tree` that of `recipe`, keeping the items that stay."""
    for item in list(tree.interface.items_tree):
        if item.item_type == "PANEL":
            tree.interface.remove(item, move_content_to_parent=True)
    wanted = [("OUTPUT", socket) for socket in recipe.outputs] + [("INPUT", socket) for socket in recipe.inputs]
    kept = []
    for in_out, socket in wanted:
        item = _interface_item(tree, in_out, socket)
        _describe(item, socket)
        kept.append(item)
    identifiers = {item.identifier for item in kept}
    for item in list(tree.interface.items_tree):
        if item.identifier not in identifiers:
            tree.interface.remove(item)
    for position, (in_out, socket) in enumerate(wanted):
        tree.interface.move(_interface_item(tree, in_out, socket), position)
    _fold_into_panels(tree, recipe.inputs)


def _fold_into_panels(tree, sockets):
    """Panels stand below the sockets that are in none, in the order of their first socket."""
    panels = {}
    for socket in sockets:
        if socket.panel:
            if socket.panel not in panels:
                panels[socket.panel] = tree.interface.new_panel(socket.panel, default_closed=True)
            panel = panels[socket.panel]
            tree.interface.move_to_parent(
                _interface_item(tree, "INPUT", socket), panel, len(panel.interface_items)
            )


def _interface_item(tree, in_out, socket):
    for item in tree.interface.items_tree:
        if (
            item.item_type == "SOCKET"
            and (item.in_out, item.name) == (in_out, socket.name)
            and item.socket_type == _SOCKET_TYPES[socket.kind]
        ):
            return item
    return tree.interface.new_socket(socket.name, in_out=in_out, socket_type=_SOCKET_TYPES[socket.kind])


def _describe(item, socket):
    item.description = socket.description
    item.hide_value = socket.hide_value
    if socket.kind == "FLOAT":
        item.subtype = socket.subtype
    if socket.minimum is not None:
        item.min_value = socket.minimum
    if socket.maximum is not None:
        item.max_value = socket.maximum
    if socket.default is not None:
        item.default_value = socket.default


def use_group(graph: Graph, recipe: GroupRecipe, values: dict) -> dict:
    """A node of the group of `recipe`, each of its inputs connected to the value of its name; its outputs by name.

    `values` may hold more than this group takes.
    """
    title = recipe.name.removeprefix(NAME_PREFIX)
    node = graph.node("ShaderNodeGroup", title, node_tree=find_group(recipe.name))
    for socket in recipe.inputs:
        graph.connect(values[socket.name], node.inputs[socket.name])
    return {socket.name: graph.output_of(node, socket.name) for socket in recipe.outputs}
