# SPDX-License-Identifier: GPL-3.0-or-later
"""Ripples can be changed and switched off at any time; a Blender that can not shade them shows none."""

import bpy
import pytest

import ocean_lod_addon
from ocean_lod_addon.nodes.ripples_material import RIPPLES_NODE_NAME
from ocean_lod_addon.scene import ocean_object, properties
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
    shown = kind != "off" and bpy.app.version >= properties.RIPPLES_SINCE
    assert (RIPPLES_NODE_NAME in ocean.data.materials[0].node_tree.nodes) == shown
    assert bool([image for image in bpy.data.images if "ocean_lod_ripples" in image]) == shown


@pytest.mark.render
def test_the_sea_is_not_black(ocean):
    """Cycles draws a shader that is too big for it black; the sea reflects at least 2 % of a white sky."""
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
