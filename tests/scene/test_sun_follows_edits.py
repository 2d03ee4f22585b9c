# SPDX-License-Identifier: GPL-3.0-or-later
"""The ocean reflects the sun as an artist edits it, and leaves it as it was when the ocean has gone."""

import math

import bpy
import pytest

import ocean_lod_addon
from ocean_lod_addon.nodes.material import NODE_NAME
from ocean_lod_addon.scene import ocean_object
from tests.fresh_ocean import fresh_ocean


@pytest.fixture
def ocean():
    """A small ocean."""
    ob, _ = fresh_ocean(cells=8, levels=3, cell_size=1.0)
    yield ob
    ocean_lod_addon.unregister()


def add_sun(specular=0.75):
    data = bpy.data.lights.new("Sun", "SUN")
    data.energy, data.specular_factor = 1.0, specular
    lamp = bpy.data.objects.new("Sun", data)
    bpy.context.scene.collection.objects.link(lamp)
    bpy.context.view_layer.update()
    return lamp


def reflected_sun(ocean):
    """Direction and red irradiance that the ocean's material knows."""
    inputs = ocean.data.materials[0].node_tree.nodes[NODE_NAME].inputs
    return tuple(inputs["Sun Direction"].default_value), inputs["Sun Irradiance"].default_value[0]


def test_a_sun_that_comes_later_is_reflected_once_and_followed(ocean):
    lamp = add_sun()
    assert lamp.data.specular_factor == 0.0
    assert reflected_sun(ocean) == (pytest.approx((0.0, 0.0, 1.0)), 1.0)
    lamp.data.energy = 3.0
    lamp.rotation_euler.y = math.radians(60.0)
    bpy.context.view_layer.update()
    assert reflected_sun(ocean) == (pytest.approx((math.sqrt(0.75), 0.0, 0.5), abs=1e-6), 3.0)


def test_what_the_artist_does_to_a_claimed_sun_stays(ocean):
    lamp = add_sun()
    lamp.data.specular_factor = 0.5
    bpy.context.view_layer.update()
    assert lamp.data.specular_factor == 0.5


@pytest.mark.parametrize("how", ["deleted", "given another material", "given another shader"])
def test_the_sun_is_given_back_with_the_last_ocean(ocean, how):
    lamp = add_sun()
    second = ocean.copy()
    bpy.context.scene.collection.objects.link(second)
    bpy.data.objects.remove(second)
    bpy.context.view_layer.update()
    assert lamp.data.specular_factor == 0.0
    if how == "deleted":
        bpy.data.objects.remove(ocean)
    elif how == "given another shader":
        nodes = ocean.data.materials[0].node_tree.nodes
        nodes.remove(nodes[NODE_NAME])
    else:
        ocean.data.materials[0] = bpy.data.materials.new("Mine")
    bpy.context.view_layer.update()
    assert lamp.data.specular_factor == 0.75


def test_an_ocean_whose_water_was_taken_out_of_its_material_still_moves(ocean, capfd):
    """A material with nodes of the artist's own is theirs: nothing is said, and nothing stands still."""
    scene = bpy.context.scene
    nodes = ocean.data.materials[0].node_tree.nodes
    nodes.remove(nodes[NODE_NAME])
    add_sun()
    scene.frame_set(1)
    before = [vertex.co.copy() for vertex in ocean.data.vertices]
    scene.frame_set(12)
    assert before != [vertex.co for vertex in ocean.data.vertices]
    ocean.ocean_lod.foam.coverage = 2.0
    ocean.ocean_lod.ripples.kind = "off"
    ocean.ocean_lod.material.see_through = not ocean.ocean_lod.material.see_through
    assert "Traceback" not in "".join(capfd.readouterr())
    assert not ocean_object.problem(ocean)


def test_another_scene_without_an_ocean_does_not_take_a_shared_sun_away(ocean):
    lamp = add_sun()
    other = bpy.data.scenes.new("Other")
    other.collection.objects.link(lamp)
    other.view_layers[0].update()
    assert lamp.data.specular_factor == 0.0
