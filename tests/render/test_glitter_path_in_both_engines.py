# SPDX-License-Identifier: GPL-3.0-or-later
"""One shot of a sea under a low sun, in Cycles and in EEVEE: the path of glitter is in both, and as bright."""

import math

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.cli.render import set_engine, set_samples
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.shot import Shot
from ocean_lod_addon.nodes.material import NODE_NAME
from ocean_lod_addon.scene import ocean_object, shot_scene
from tests.render.exr import read_pixels
from tests.render.flat_sea import direction
from tests.render.ross_reference import closure_excess

pytestmark = pytest.mark.render

WIDTH, HEIGHT, SEA_ROWS = 64, 36, 19
"""Pixels; all of the rows are below the horizon."""

SUN_ELEVATION = 12.0  # degrees

MEAN_RADIANCE_TOLERANCE = 0.03
"""Between the engines, after what the Fresnel reflectance of Cycles' closure adds before Blender 5: 4 samples of
EEVEE and 64 of Cycles."""


@pytest.fixture
def shot():
    """A breeze on the sea, the sun low above the horizon in the middle of the picture."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.resolution_percentage = 100
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    low_sun = {"sun_elevation": math.radians(SUN_ELEVATION), "sun_azimuth": 0.0}
    shot_scene.build(scene, Shot(camera_height=4.0, focal_length=24.0, **low_sun))
    sea = Sea(systems=(WaveSystem(wind_speed=7.0),), wave_count=64)
    ob = ocean_object.create(scene, sea, Grid(cell_size=0.2, cells=128, levels=8), MaterialSettings())
    scene.collection.objects.link(ob)
    ob.ocean_lod.ripples.kind = "off"  # slopes in the BRDF instead: the same light, sooner compiled
    yield scene, ob
    ocean_lod_addon.unregister()


def picture_of_the_sea(scene, engine, samples, path):
    set_engine(scene, engine)
    set_samples(scene, samples)
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    return read_pixels(path)[:SEA_ROWS, :, :3].mean(axis=-1)


def directions_to_viewer(scene):
    """Unit vectors from what the pixels of the sea show, shape (rows from below, columns, 3)."""
    camera = scene.camera
    right, up, backward = np.array(camera.matrix_world.to_3x3()).T
    pixel = camera.data.sensor_width / camera.data.lens / WIDTH
    x = (np.arange(WIDTH) + 0.5 - 0.5 * WIDTH) * pixel
    y = (np.arange(SEA_ROWS) + 0.5 - 0.5 * HEIGHT) * pixel
    to_viewer = backward - x[:, np.newaxis] * right - y[:, np.newaxis, np.newaxis] * up
    return to_viewer / np.linalg.norm(to_viewer, axis=-1, keepdims=True)


def columns_of_path(picture):
    """The columns in which the sea is more than half as bright as in the brightest."""
    columns = picture.mean(axis=0)
    return columns > 0.5 * columns.max()


def contrast(picture, path):
    """How many times brighter the path is than the rest of the sea."""
    return picture[:, path].mean() / picture[:, ~path].mean()


def test_both_engines_show_the_path_and_agree_on_its_light(shot, tmp_path):
    """EEVEE leaves out the disc of a Sky Texture, so that a plain closure there has no path at all."""
    scene, ob = shot
    cycles = picture_of_the_sea(scene, "CYCLES", 64, tmp_path / "sea.exr")
    eevee = picture_of_the_sea(scene, "EEVEE", 4, tmp_path / "sea.exr")
    path = columns_of_path(cycles)
    assert np.all(np.diff(np.flatnonzero(path)) == 1), "one path"
    assert abs(np.flatnonzero(path).mean() - 0.5 * (WIDTH - 1)) < 2.0, "towards the sun"
    assert contrast(cycles, path) > 10.0
    assert contrast(eevee, path) > 10.0
    as_in_closure = eevee * closure_excess(directions_to_viewer(scene), direction(SUN_ELEVATION))
    assert as_in_closure[:, path].mean() == pytest.approx(cycles[:, path].mean(), rel=MEAN_RADIANCE_TOLERANCE)

    tree = ob.data.materials[0].node_tree
    tree.links.new(tree.nodes[NODE_NAME].outputs["Cycles"], tree.nodes["Output EEVEE"].inputs["Surface"])
    plain = picture_of_the_sea(scene, "EEVEE", 4, tmp_path / "sea.exr")
    assert contrast(plain, path) < 0.2 * contrast(cycles, path)  # the glow of the sky around the sun is left
