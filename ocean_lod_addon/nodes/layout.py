# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the nodes of a tree stand: one layered layout, left to right, computed once a tree is complete.

Every frame is laid out by itself: a node stands one column to the right of the last node it depends on,
and in its column at the height of what feeds it. The frames, and the nodes outside any, are then laid out
in the same way as blocks.

Where an artist may have nodes of their own, a node that comes later is put beside another (`place_beside`), and
theirs stay where they are.
"""

from dataclasses import dataclass

COLUMN_GAP = 50.0
ROW_GAP = 25.0
FRAME_MARGIN = 40.0
"""Room around the nodes of a frame for its border and title."""

_HEADER_HEIGHT = 40.0
_ROW_HEIGHT = 22.0
_CHARACTER_WIDTH = 7.0
_TITLE_MARGIN, _SOCKET_MARGIN, _SELECTOR_MARGIN = 36.0, 30.0, 112.0
"""Room beside a node's title, a socket's name, and the name of a group among its buttons and number of users."""
_IMAGE_BUTTONS = 80.0
"""Room that the selector of an image takes besides."""

_VALUE_CHARACTERS = 8
"""Room that a number or a color takes beside the name of its socket."""

_DROPDOWN_ROWS = {
    "ShaderNodeMath": 2,
    "ShaderNodeVectorMath": 1,
    "ShaderNodeMix": 3,
    "ShaderNodeBsdfMetallic": 2,
    "ShaderNodeBsdfAnisotropic": 2,  # Glossy
    "ShaderNodeBsdfGlass": 1,
    "ShaderNodeBsdfRefraction": 1,
    "ShaderNodeVectorTransform": 3,
    "ShaderNodeAttribute": 2,
    "ShaderNodeOutputMaterial": 1,
    "ShaderNodeGroup": 1,
    "ShaderNodeSeparateColor": 1,
    "ShaderNodeTexWhiteNoise": 1,
    "ShaderNodeTexNoise": 4,
    "ShaderNodeTexImage": 7,
    "ShaderNodeVolumeCoefficients": 5,
}
"""Rows of menus and check boxes that a node shows besides its sockets, as Blender 5.2 draws them."""


@dataclass
class Block:
    """A node, or a frame with its nodes, as a rectangle whose top left corner is (x, y), y upwards."""

    nodes: list
    width: float
    height: float
    x: float = 0.0
    y: float = 0.0


def estimated_height(node) -> float:
    """The height of a node on screen; Blender knows the true one only once it has drawn the node."""
    outputs = sum(_is_shown(socket) for socket in node.outputs)
    inputs = sum(_rows(socket) for socket in node.inputs if _is_shown(socket))
    rows = outputs + inputs + _DROPDOWN_ROWS.get(node.bl_idname, 0)
    return _HEADER_HEIGHT + _ROW_HEIGHT * rows


def fitting_width(node) -> float:
    """The width at which no title and no socket's name is cut off."""
    names = [_SOCKET_MARGIN + _CHARACTER_WIDTH * _characters(socket) for socket in (*node.inputs, *node.outputs)]
    title = _TITLE_MARGIN + _CHARACTER_WIDTH * len(node.label)
    tree, image = getattr(node, "node_tree", None), getattr(node, "image", None)
    used = tree or image
    field = used.name if used else getattr(node, "attribute_name", "")
    selector = _SELECTOR_MARGIN + _CHARACTER_WIDTH * len(field) if field else 0.0
    selector += _IMAGE_BUTTONS if image else 0.0
    return max(node.width, title, selector, *names)


def _characters(socket):
    if not _is_shown(socket):
        return 0
    has_field = not (socket.is_output or socket.is_linked or socket.hide_value)
    return len(socket.name) + (_VALUE_CHARACTERS if has_field else 0)


def _is_shown(socket):
    return not socket.hide and socket.enabled


def _rows(socket):
    has_fields = socket.type == "VECTOR" and not socket.is_linked and not socket.hide_value
    return 4 if has_fields else 1


def arrange(tree) -> None:
    """Give every node of `tree` its place; nodes in frames stay in their frames."""
    nodes = [node for node in tree.nodes if node.bl_idname != "NodeFrame"]
    for node in nodes:
        node.width = fitting_width(node)
    links = [(link.from_node.name, link.to_node.name) for link in tree.links]
    blocks = [_arranged_block(group, links) for group in _by_frame(nodes)]
    block_of = {node.name: index for index, block in enumerate(blocks) for node in block.nodes}
    between = [(block_of[a], block_of[b]) for a, b in links if block_of[a] != block_of[b]]
    _place(blocks, between, 2.0 * COLUMN_GAP)
    for frame in tree.nodes:
        if frame.bl_idname == "NodeFrame":
            frame.location = (0.0, 0.0)
    for block in blocks:
        for node in block.nodes:
            x, y = node.location
            node.location = (x + block.x, y + block.y)


def place_beside(tree, node, neighbour, movable, left: bool) -> None:
    """Put `node` left or right of `neighbour`, at its height.

    Those of the nodes `movable` that stand there move out of the way, sideways. All others stay, and `node` goes
    below the ones it would lie on.
    """
    node.width, node.select = fitting_width(node), False
    x, y = neighbour.location_absolute
    sideways = -1.0 if left else 1.0
    x += -(node.width + COLUMN_GAP) if left else neighbour.width + COLUMN_GAP
    beyond = [other for other in movable if sideways * (_left(other) - _left(neighbour)) > 0.0]
    if left:
        overlaps = [_right(other) + COLUMN_GAP - x for other in beyond]
    else:
        overlaps = [x + node.width + COLUMN_GAP - _left(other) for other in beyond]
    for other in beyond:
        other.location.x += sideways * max(0.0, *overlaps)
    others = [other for other in tree.nodes if other != node and other.bl_idname != "NodeFrame"]
    for other in sorted(others, key=lambda other: -other.location_absolute.y):
        top, bottom = other.location_absolute.y, other.location_absolute.y - estimated_height(other)
        beside = _right(other) <= x or _left(other) >= x + node.width
        if not beside and bottom < y and top > y - estimated_height(node):
            y = bottom - ROW_GAP
    node.location = (x, y)


def _left(node):
    return node.location_absolute.x


def _right(node):
    return _left(node) + node.width


def _by_frame(nodes):
    """The nodes of each frame, and each node outside any frame by itself, in order of making."""
    groups = {}
    for node in nodes:
        key = ("frame", node.parent.name) if node.parent else ("node", node.name)
        groups.setdefault(key, []).append(node)
    return list(groups.values())


def _arranged_block(nodes, links):
    """The block of `nodes`, each placed relative to the block's top left corner."""
    rectangles = [Block([node], node.width, estimated_height(node)) for node in nodes]
    index_of = {node.name: index for index, node in enumerate(nodes)}
    inside = [(index_of[a], index_of[b]) for a, b in links if a in index_of and b in index_of]
    _place(rectangles, inside, COLUMN_GAP)
    margin = FRAME_MARGIN if nodes[0].parent else 0.0
    top = max(rectangle.y for rectangle in rectangles)
    for rectangle in rectangles:
        rectangle.nodes[0].location = (rectangle.x + margin, rectangle.y - top - margin)
    width = max(rectangle.x + rectangle.width for rectangle in rectangles)
    height = top - min(rectangle.y - rectangle.height for rectangle in rectangles)
    return Block(nodes, width + 2.0 * margin, height + 2.0 * margin)


def _place(blocks, links, column_gap):
    """Set x and y of every block: columns from left to right, without overlaps."""
    column_of = _columns(len(blocks), links)
    sources = [[a for a, b in links if b == index] for index in range(len(blocks))]
    x = 0.0
    for column in range(max(column_of, default=-1) + 1):
        members = [index for index in range(len(blocks)) if column_of[index] == column]
        members.sort(key=lambda index: (-_wanted_y(blocks, sources[index]), index))
        top = _top_of_column(blocks, members, sources)
        for index in members:
            blocks[index].x, blocks[index].y = x, top
            top -= blocks[index].height + ROW_GAP
        x += max(blocks[index].width for index in members) + column_gap


def _columns(count, links):
    """The column of each block: 0 without sources, else one right of its last source.

    A link that would close a circle (between frames it can) is left out of the count.
    """
    columns = [0] * count
    for _ in range(count):
        changed = False
        for a, b in links:
            if columns[b] <= columns[a] < count - 1:
                columns[b] = columns[a] + 1
                changed = True
        if not changed:
            return columns
    return columns


def _wanted_y(blocks, sources):
    """The mean height of what feeds a block, 0 where nothing does."""
    return sum(blocks[index].y for index in sources) / len(sources) if sources else 0.0


def _top_of_column(blocks, members, sources):
    """The top of a column whose middle is at the middle of what feeds it."""
    height = sum(blocks[index].height + ROW_GAP for index in members) - ROW_GAP
    fed = [index for index in members if sources[index]]
    if not fed:
        return 0.0
    middles = [blocks[a].y - 0.5 * blocks[a].height for index in fed for a in sources[index]]
    return sum(middles) / len(middles) + 0.5 * height
