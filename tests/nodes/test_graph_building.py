# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph builder: what a formula becomes, that two builds agree, and that rebuilding keeps links."""

import itertools

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.nodes.graph import GraphOps
from ocean_lod_addon.nodes.groups import GroupRecipe, Socket, ensure_group, find_group
from ocean_lod_addon.nodes.layout import estimated_height
from tests.nodes.tree_description import describe_tree
from tests.nodes.tree_interpreter import TreeInterpreter


@pytest.fixture(autouse=True)
def _empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def every_operation(ops, x, y):
    """Uses each operation of `Ops` and each operator once or more; finite for x, y > 0."""
    total = ops.sqrt(x) + 2.0 * ops.exp(-x) - 1.5 / y + ops.absolute(x - y) - 3.0
    total = total + ops.minimum(x, y) * ops.maximum(y, 0.3) / (1.0 + x) + ops.power(x, 0.7)
    total = ops.label(total, "total so far") + ops.less_than(x, y)
    return ops.where(ops.less_than(x, 0.5), total, total - ops.constant(1.0))


def _build_every_operation(graph):
    ops = GraphOps(graph)
    with graph.section("Everything"):
        result = every_operation(ops, graph.input("X"), graph.input("Y"))
    graph.output("Result", result)


def recipe(build, version="1", inputs=("X", "Y"), outputs=("Result",)):
    return GroupRecipe(
        "Test Group",
        version,
        tuple(Socket(name, "FLOAT", f"the value {name}", 0.5, 0.0, 10.0) for name in inputs),
        tuple(Socket(name, "FLOAT") for name in outputs),
        build,
    )


def test_nodes_compute_what_numpy_computes():
    """float32 nodes against the float64 formula: a dozen roundings of values below 4, so 4 * 12 * 2^-24."""
    tree = ensure_group(recipe(_build_every_operation))
    rng = np.random.default_rng(1)
    x, y = rng.uniform(0.01, 2.0, (2, 500))
    expected = every_operation(NumpyOps(), x, y)
    actual = TreeInterpreter(tree, {"X": x, "Y": y}).output("Result")
    assert np.all(np.abs(x - 0.5) > 1e-6)  # no point sits where float32 may take the other branch
    # 1.5 / y is as large as 150 and so carries an absolute rounding of 150 * 2^-24 of its own
    assert np.abs(actual - expected) == pytest.approx(0.0, abs=3e-5)


def test_vectors_compute_what_numpy_computes():
    """float32 against float64: a few roundings of values below 10."""

    def build(graph):
        ops, x, y = GraphOps(graph), graph.input("X"), graph.input("Y")
        a, b = ops.vector(x, y, 2.0), graph.vector(y, 1.0, x)
        c = a * x + b + (a * y + b) - a.cross(b).normalized()
        graph.output("Result", ops.dot(c, a.times(b) * y) + (a / 2.0).length())

    tree = ensure_group(recipe(build))
    x, y = np.random.default_rng(7).uniform(0.1, 1.0, (2, 100))
    a, b = np.stack([x, y, np.full_like(x, 2.0)], axis=-1), np.stack([y, np.ones_like(x), x], axis=-1)
    normal = np.cross(a, b)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    c = a * x[:, None] + b + a * y[:, None] + b - normal
    expected = np.sum(c * a * b * y[:, None], axis=-1) + 0.5 * np.linalg.norm(a, axis=-1)
    assert TreeInterpreter(tree, {"X": x, "Y": y}).output("Result") == pytest.approx(expected, rel=1e-5)


def _count(build):
    tree = ensure_group(recipe(build))
    return sum(not node.bl_idname.startswith("NodeGroup") for node in tree.nodes)


@pytest.mark.parametrize(
    ("formula", "nodes"),
    [
        (lambda ops, x, y: x + 0.0, 0),
        (lambda ops, x, y: 0.0 + x, 0),
        (lambda ops, x, y: x - 0.0, 0),
        (lambda ops, x, y: 0.0 - x, 1),
        (lambda ops, x, y: 1.0 * x, 0),
        (lambda ops, x, y: x / 1.0, 0),
        (lambda ops, x, y: 1.0 / x, 1),
        (lambda ops, x, y: x * 0.0, 0),
        (lambda ops, x, y: x * ops.sqrt(ops.constant(4.0)), 1),
        (lambda ops, x, y: ops.where(ops.less_than(ops.constant(1.0), 2.0), x, y), 0),
        (lambda ops, x, y: x * y + y * x, 2),
        (lambda ops, x, y: x - y + (y - x), 3),
        (lambda ops, x, y: ops.sqrt(x) * ops.sqrt(x), 2),
    ],
)
def test_trivial_and_repeated_operations_make_no_nodes(formula, nodes):
    def build(graph):
        graph.output("Result", formula(GraphOps(graph), graph.input("X"), graph.input("Y")))

    assert _count(build) == nodes


def test_two_builds_give_the_same_tree():
    first = describe_tree(ensure_group(recipe(_build_every_operation)))
    bpy.data.node_groups.remove(find_group("Test Group"))
    assert describe_tree(ensure_group(recipe(_build_every_operation))) == first


def test_the_second_call_builds_nothing():
    calls = []

    def build(graph):
        calls.append(graph)
        _build_every_operation(graph)

    assert ensure_group(recipe(build)) == ensure_group(recipe(build))
    assert len(calls) == 1
    assert [tree.name for tree in bpy.data.node_groups] == ["Test Group"]


def test_a_new_version_rebuilds_in_place_and_keeps_links_and_values():
    def build_more(graph):
        graph.output("Extra", graph.input("Z") * 2.0)
        _build_every_operation(graph)

    tree = ensure_group(recipe(_build_every_operation))
    material = bpy.data.materials.new("Mine")
    if material.node_tree is None:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    group = nodes.new("ShaderNodeGroup")
    group.node_tree = tree
    source = nodes.new("ShaderNodeValue")
    links.new(source.outputs[0], group.inputs["X"])
    group.inputs["Y"].default_value = 0.25

    newer = recipe(build_more, "2", inputs=("Z", "X", "Y"), outputs=("Extra", "Result"))
    assert ensure_group(newer) == tree
    assert [socket.name for socket in group.inputs] == ["Z", "X", "Y"]
    assert group.inputs["X"].links[0].from_node == source
    assert group.inputs["Y"].default_value == 0.25

    ensure_group(recipe(_build_every_operation, "3"))
    assert [socket.name for socket in group.inputs] == ["X", "Y"]
    assert [tree.name for tree in bpy.data.node_groups] == ["Test Group"]


def test_a_changed_inner_group_rebuilds_what_uses_it():
    inner, outer_builds = recipe(_build_every_operation), []
    outer = GroupRecipe("Outer", "1", (), (), outer_builds.append, needs=(inner,))
    ensure_group(outer)
    ensure_group(outer)
    assert len(outer_builds) == 1
    ensure_group(GroupRecipe("Outer", "1", (), (), outer_builds.append, needs=(recipe(inner.build, "2"),)))
    assert len(outer_builds) == 2


def test_a_group_of_the_artist_with_the_same_name_is_left_alone():
    theirs = bpy.data.node_groups.new("Test Group", "ShaderNodeTree")
    ours = ensure_group(recipe(_build_every_operation))
    assert ours != theirs
    assert len(theirs.nodes) == 0
    assert ensure_group(recipe(_build_every_operation)) == ours


def test_sockets_carry_range_and_description():
    tree = ensure_group(recipe(_build_every_operation))
    (x,) = [item for item in tree.interface.items_tree if item.name == "X"]
    assert (x.min_value, x.max_value, x.default_value) == (0.0, 10.0, 0.5)
    assert x.description == "the value X"


def test_sockets_of_a_panel_are_folded_below_the_others_and_keep_their_links():
    def build(graph):
        graph.output("Result", graph.input("X") + graph.input("Y") + graph.input("Z"))

    def with_panels(version, **panels):
        sockets = tuple(Socket(name, "FLOAT", panel=panels.get(name, "")) for name in "XYZ")
        return ensure_group(GroupRecipe("Test Group", version, sockets, (Socket("Result", "FLOAT"),), build))

    tree = with_panels("1", X="Weather", Z="Weather")
    material = bpy.data.materials.new("Mine")
    if material.node_tree is None:
        material.use_nodes = True
    group = material.node_tree.nodes.new("ShaderNodeGroup")
    group.node_tree = tree
    source = material.node_tree.nodes.new("ShaderNodeValue")
    material.node_tree.links.new(source.outputs[0], group.inputs["X"])
    for version, panels, order in (("1", {"X": "Weather", "Z": "Weather"}, "YXZ"), ("2", {"Y": "Water"}, "XZY")):
        with_panels(version, **panels)
        folds = {item.name: item for item in tree.interface.items_tree if item.item_type == "PANEL"}
        (title,) = set(panels.values())
        assert list(folds) == [title]
        assert folds[title].default_closed
        assert [item.name for item in folds[title].interface_items] == list(panels)
        assert [socket.name for socket in group.inputs] == list(order)
        assert group.inputs["X"].links[0].from_node == source


def test_nodes_do_not_overlap_and_links_run_left_to_right():
    def build(graph):
        ops = GraphOps(graph)
        x, y = graph.input("X"), graph.input("Y")
        with graph.section("First"):
            first = every_operation(ops, x, y)
        with graph.section("Second"):
            second = every_operation(ops, first, y)
        graph.output("Result", second)

    tree = ensure_group(recipe(build))
    nodes = [node for node in tree.nodes if node.bl_idname != "NodeFrame"]
    assert {node.parent.name for node in nodes if node.parent} == {"First", "Second"}
    boxes = {node.name: (*node.location, node.width, estimated_height(node)) for node in nodes}
    for (a, (ax, ay, aw, ah)), (b, (bx, by, bw, bh)) in itertools.combinations(boxes.items(), 2):
        apart = ax + aw <= bx or bx + bw <= ax or ay - ah >= by or by - bh >= ay
        assert apart, f"{a} overlaps {b}"
    for link in tree.links:
        assert link.from_node.location.x < link.to_node.location.x
    for frame in ("First", "Second"):
        inside = [boxes[node.name] for node in nodes if node.parent and node.parent.name == frame]
        left, right = min(box[0] for box in inside), max(box[0] + box[2] for box in inside)
        top, bottom = max(box[1] for box in inside), min(box[1] - box[3] for box in inside)
        for node in nodes:
            if node.parent is None or node.parent.name != frame:
                x, y, width, height = boxes[node.name]
                assert x + width <= left or x >= right or y - height >= top or y <= bottom
