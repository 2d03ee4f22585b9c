# SPDX-License-Identifier: GPL-3.0-or-later
"""A node tree as plain data, so that two trees can be compared."""


def _plain(value):
    if isinstance(value, int | float | str | bool) or value is None:
        return value
    try:
        return tuple(value)
    except TypeError:
        return value.name


def _properties(node):
    own = set(node.bl_rna.properties.keys()) - {"rna_type", "select", "dimensions", "inputs", "outputs"}
    own -= {"internal_links", "parent", "color_tag", "panel_states", "location_absolute"}
    return {name: _plain(getattr(node, name)) for name in sorted(own)}


def describe_tree(tree) -> dict:
    """Nodes with their properties, values and places, and links, in order of making."""
    nodes = {}
    for node in tree.nodes:
        values = [_plain(getattr(socket, "default_value", None)) for socket in node.inputs]
        parent = node.parent.name if node.parent else None
        nodes[node.name] = (_properties(node), values, parent)
    links = [
        (link.from_node.name, link.from_socket.identifier, link.to_node.name, link.to_socket.identifier)
        for link in tree.links
    ]
    return {"nodes": nodes, "links": links}
