# SPDX-License-Identifier: GPL-3.0-or-later
"""Ripples can be changed and switched off at any time, and Cycles has room for every shader they make."""

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.nodes.ripples_material import RIPPLES_NODE_NAME
from ocean_lod_addon.scene import ocean_object
from tests.render.exr import read_pixels


@pytest.fixture
def ocean():
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    bpy.ops.mesh.ocean_lod_add(preset="calm", cells=16, levels=3)
    yield bpy.context.object
    ocean_lod_addon.unregister()


@pytest.mark.parametrize("kind", ["spectral", "random", "off"])
def test_every_kind_is_shown_or_leaves_nothing(ocean, kind):
    ocean.ocean_lod.ripples.kind = kind
    bpy.context.scene.frame_set(3)
    assert ocean_object.problem(ocean) == ""
    shown = kind != "off"
    assert (RIPPLES_NODE_NAME in ocean.data.materials[0].node_tree.nodes) == shown
    assert bool([image for image in bpy.data.images if "ocean_lod_ripples" in image]) == shown


def state_of(ocean):
    """Attribute names, slope variances, and the nodes of the ripples by name and label."""
    variance = np.empty((len(ocean.data.vertices), 3), np.float32)
    ocean.data.attributes["ocean_slope_variance"].data.foreach_get("vector", variance.ravel())
    group = ocean.data.materials[0].node_tree.nodes[RIPPLES_NODE_NAME].node_tree
    nodes = [(node.name, node.label) for node in group.nodes]
    return {attribute.name for attribute in ocean.data.attributes}, variance, nodes


def test_gusts_leave_nothing_where_they_do_not_blow(ocean):
    """One attribute more while they blow, the same at a frame however one comes to it; afterwards all is as it
    was."""
    scene = bpy.context.scene
    ocean.ocean_lod.sea.systems[0].wind_speed = 6.0
    scene.frame_set(2)
    names, variance, nodes = state_of(ocean)
    ocean.ocean_lod.ripples.gusts = True
    scene.frame_set(2)
    gusty_names, gusty_variance, gusty_nodes = state_of(ocean)
    assert gusty_names - names == {"ocean_gust"}
    assert "ocean_gust" in [label for _, label in gusty_nodes]
    assert np.abs(gusty_variance - variance).max() > 1e-4
    scene.frame_set(40)
    assert not np.array_equal(state_of(ocean)[1], gusty_variance)
    scene.frame_set(2)
    assert np.array_equal(state_of(ocean)[1], gusty_variance)
    ocean.ocean_lod.ripples.gusts = False
    scene.frame_set(2)
    assert state_of(ocean)[0] == names
    assert np.array_equal(state_of(ocean)[1], variance)
    assert state_of(ocean)[2] == nodes


def most_images(settings):
    settings.ripples.longest_wavelength, settings.ripples.shortest_wavelength = 1000.0, 0.001
    settings.ripples.resolution = "256"


def largest_water(settings):
    most_images(settings)
    settings.material.see_through = settings.material.skewed_slopes = True
    settings.material.sun_model, settings.material.glitter_strength = "formula", 0.7


@pytest.mark.render
@pytest.mark.parametrize("change", [lambda settings: None, most_images, largest_water])
def test_the_sea_is_not_black(ocean, change):
    """Cycles draws a shader that is too big for it black; the sea reflects at least 2 % of a white sky."""
    change(ocean.ocean_lod)
    scene = bpy.context.scene
    world = bpy.data.worlds.new("White")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    scene.world = world
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location.z = 2.0
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.render.resolution_x = scene.render.resolution_y = 8
    bpy.ops.render.render()
    image = bpy.data.images["Render Result"]
    path = bpy.app.tempdir + "white.exr"
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format = "OPEN_EXR"
    image.save_render(path, scene=scene)
    assert read_pixels(path)[..., :3].mean() > 0.02


@pytest.mark.parametrize("foam", ["off", "on"])
def test_a_camera_that_comes_down_to_the_water(ocean, foam):
    """Truth: ripples that come into sight in a frame break nothing; their attributes wait for a render.

    Foam looks up undisturbed positions as well: that these are there says nothing about the ripples.
    """
    scene = bpy.context.scene
    ocean.ocean_lod.effects.foam = foam
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location.z = 1e5
    scene.collection.objects.link(camera)
    scene.camera = camera
    bpy.context.view_layer.update()
    ocean_object.refresh(ocean, scene)
    assert not ocean_object.plan(ocean, scene).on("ripples")
    camera.location.z = 2.0
    scene.frame_set(5)
    assert ocean_object.plan(ocean, scene).on("ripples")
    assert ocean_object.problem(ocean) == ""
