# SPDX-License-Identifier: GPL-3.0-or-later
"""The sun that `scene_sun` reads off a Sky Texture is the disc that Cycles renders."""

import math

import bpy
import numpy as np
import pytest
from mathutils import Vector

from ocean_lod_addon.nodes.scene_sun import scene_sun

pytestmark = pytest.mark.render

SKY_TYPES = ("NISHITA",) if bpy.app.version < (5, 0, 0) else ("SINGLE_SCATTERING", "MULTIPLE_SCATTERING")

PIXELS = 48


def look_at_the_sun(sky, width):
    """A scene whose picture is `width` wide (rad) with the sun in its middle."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    to_sun = Vector(scene_sun(scene).direction)
    camera.rotation_euler = to_sun.to_track_quat("-Z", "Y").to_euler()
    camera.data.angle = width
    scene.camera = camera
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, False
    scene.render.resolution_x = scene.render.resolution_y = PIXELS
    scene.render.resolution_percentage = 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"


def picture(path):
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    pixels = np.empty(PIXELS * PIXELS * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(PIXELS, PIXELS, -1)[..., :3].astype(np.float64)


@pytest.mark.parametrize("sky_type", SKY_TYPES)
@pytest.mark.parametrize(
    ("elevation", "rotation", "altitude", "air", "aerosols"),
    [(30.0, -40.0, 100.0, 1.0, 2.0), (4.0, 170.0, 500.0, 0.5, 0.5)],
)
def test_direction_and_irradiance(sky_type, elevation, rotation, altitude, air, aerosols, tmp_path):
    """Truth: the picture with the disc minus the picture without, times the solid angle of a pixel.

    2 % of the brightest channel: Blender's own quadrature of the air mass is off by 1 % near the horizon, and
    the disc's edge is resolved by 48 pixels.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    world.node_tree.links.new(sky.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5
    bpy.context.scene.world = world
    sky.sky_type, sky.sun_size, sky.sun_intensity = sky_type, math.radians(1.0), 0.8
    sky.sun_elevation, sky.sun_rotation = math.radians(elevation), math.radians(rotation)
    sky.altitude, sky.air_density = altitude, air
    if sky_type == "NISHITA":
        sky.dust_density = aerosols
    else:
        sky.aerosol_density = aerosols

    width = math.radians(1.4)
    look_at_the_sun(sky, width)
    sun = scene_sun(bpy.context.scene)
    disc = picture(tmp_path / "sky.exr")
    sky.sun_disc = False
    disc = disc - picture(tmp_path / "sky.exr")

    irradiance = disc.sum(axis=(0, 1)) * (2.0 * math.tan(0.5 * width) / PIXELS) ** 2
    assert sun.irradiance == pytest.approx(irradiance, abs=0.02 * irradiance.max())
    brightness = disc.sum(axis=-1)
    middle = 0.5 * (PIXELS - 1)
    rows, columns = np.indices(brightness.shape)
    for offsets in (rows - middle, columns - middle):
        assert abs((offsets * brightness).sum() / brightness.sum()) < 0.05 * PIXELS
