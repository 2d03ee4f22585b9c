# SPDX-License-Identifier: GPL-3.0-or-later
"""The ocean material: one, changed in place, and careful with what the artist did to it."""

import itertools

import bpy
import pytest

from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.nodes.groups import VERSION_KEY
from ocean_lod_addon.nodes.layout import estimated_height, fitting_width, place_beside
from ocean_lod_addon.nodes.material import SLOPE_VARIANCE_ATTRIBUTE, ensure_material, own_nodes
from ocean_lod_addon.nodes.water_group import WATER
from tests.nodes.tree_description import describe_tree


@pytest.fixture(autouse=True)
def _empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def our_groups():
    return sorted(tree.name for tree in bpy.data.node_groups)


def test_two_calls_give_one_material_and_one_group_of_each_kind():
    first = ensure_material("Ocean", MaterialSettings())
    groups = our_groups()
    assert ensure_material("Ocean", MaterialSettings(roughness=2.0)) == first
    assert [material.name for material in bpy.data.materials] == ["Ocean"]
    assert our_groups() == groups
    assert not any("." in name for name in groups)


def test_a_renamed_material_is_still_the_one():
    material = ensure_material("Ocean", MaterialSettings())
    material.name = "My Sea"
    assert ensure_material("Ocean", MaterialSettings()) == material


def test_a_material_of_the_artist_with_the_same_name_is_left_alone():
    theirs = bpy.data.materials.new("Ocean")
    ours = ensure_material("Ocean", MaterialSettings())
    assert ours != theirs
    assert ensure_material("Ocean", MaterialSettings()) == ours


def test_it_reads_the_mesh_and_serves_both_engines():
    tree = ensure_material("Ocean", MaterialSettings()).node_tree
    (attribute,) = [node for node in tree.nodes if node.bl_idname == "ShaderNodeAttribute"]
    assert attribute.attribute_name == SLOPE_VARIANCE_ATTRIBUTE
    outputs = {node.target: node for node in tree.nodes if node.bl_idname == "ShaderNodeOutputMaterial"}
    assert set(outputs) == {"CYCLES", "EEVEE"}
    for target, output in outputs.items():
        assert output.inputs["Surface"].links[0].from_socket.name.upper() == target


def test_every_socket_that_an_artist_sees_is_described():
    ensure_material("Ocean", MaterialSettings())
    for tree in bpy.data.node_groups:
        for item in tree.interface.items_tree:
            if item.item_type == "PANEL":
                continue
            if item.in_out == "INPUT":
                assert item.description, f"{tree.name}: {item.name}"
            if item.socket_type == "NodeSocketFloat":
                assert item.min_value < item.max_value < 1e6, f"{tree.name}: {item.name} has no range"


def test_no_title_or_name_is_cut_off():
    ensure_material("Ocean", MaterialSettings(see_through=True, skewed_slopes=True))
    for tree in (*bpy.data.node_groups, *(material.node_tree for material in bpy.data.materials)):
        for node in tree.nodes:
            if node.bl_idname != "NodeFrame":
                assert node.width >= fitting_width(node), f"{tree.name}: {node.name}"


def test_only_changed_settings_are_written():
    material = ensure_material("Ocean", MaterialSettings())
    sockets = material.node_tree.nodes[WATER.name].inputs
    sockets["Tint"].default_value = (0.5, 0.25, 0.125, 1.0)
    ensure_material("Ocean", MaterialSettings(roughness=2.0))
    assert sockets["Roughness"].default_value == 2.0
    assert tuple(sockets["Tint"].default_value) == (0.5, 0.25, 0.125, 1.0)
    ensure_material("Ocean", MaterialSettings(roughness=2.0, tint_red=0.75))
    assert tuple(sockets["Tint"].default_value) == (0.75, 1.0, 1.0, 1.0)


def test_own_nodes_and_links_of_the_artist_survive():
    tree = ensure_material("Ocean", MaterialSettings()).node_tree
    water = tree.nodes[WATER.name]
    noise = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs[0], water.inputs["Roughness"])
    bpy.data.node_groups[WATER.name][VERSION_KEY] = "older"
    ensure_material("Ocean", MaterialSettings(roughness=3.0, water_type="coastal"))
    assert bpy.data.node_groups[WATER.name][VERSION_KEY] == WATER.full_version
    assert water.inputs["Roughness"].links[0].from_node == noise


@pytest.mark.parametrize("left", [True, False])
def test_a_node_that_comes_later_moves_no_node_of_the_artist(left):
    tree = ensure_material("Ocean", MaterialSettings()).node_tree
    water = tree.nodes[WATER.name]
    theirs = tree.nodes.new("ShaderNodeTexNoise")
    theirs.location = water.location.x + (-250.0 if left else 320.0), water.location.y - 30.0
    places = {node.name: tuple(node.location) for node in (theirs, water)}
    node = tree.nodes.new("ShaderNodeTexVoronoi")
    place_beside(tree, node, water, own_nodes(tree), left)
    assert {name: tuple(tree.nodes[name].location) for name in places} == places
    boxes = [(*other.location, other.width, estimated_height(other)) for other in (node, *own_nodes(tree), theirs)]
    for (x, y, width, height), (u, v, w, h) in itertools.combinations(boxes[:-1], 2):
        assert x + width <= u or u + w <= x or y - height >= v or v - h >= y
    (x, y, width, height), (u, v, w, h) = boxes[0], boxes[-1]
    assert x + width <= u or u + w <= x or y - height >= v or v - h >= y
    assert (node.location.x < water.location.x) == left


def test_groups_built_twice_are_identical():
    ensure_material("Ocean", MaterialSettings())
    first = {tree.name: describe_tree(tree) for tree in bpy.data.node_groups}
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ensure_material("Ocean", MaterialSettings())
    assert {tree.name: describe_tree(tree) for tree in bpy.data.node_groups} == first
