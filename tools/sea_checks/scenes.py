# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes to look at, and pictures of them as numbers."""

import tempfile
from pathlib import Path

import bpy
import numpy as np

import ocean_lod_addon
from ocean_lod_addon.cli.render import set_engine, set_samples
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.sea import Sea
from ocean_lod_addon.core.shot import Shot
from ocean_lod_addon.core.shot_fit import first_fit, frame_needs
from ocean_lod_addon.scene import ocean_object, placing, shot_scene


def new_scene(shot: Shot, engine: str, width: int, height: int, samples: int):
    """A scene with a shot's camera and sky, without an ocean; nothing in it makes pictures smoother."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    scene = bpy.context.scene
    shot_scene.build(scene, shot)
    set_engine(scene, engine)
    set_samples(scene, samples)
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0.0
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    bpy.context.view_layer.update()
    return scene


def add_ocean(scene, sea: Sea, width: int, material: MaterialSettings | None = None):
    """This extension's ocean, with plane and ripples fitted to the scene's camera and a picture of this width."""
    bpy.context.view_layer.update()
    needs = frame_needs(placing.view_of(scene.camera, scene), width)
    grid, ripples, _ = first_fit(sea, needs)
    ob = ocean_object.create(scene, sea, grid, material or MaterialSettings(), ripples=ripples)
    scene.collection.objects.link(ob)
    return ob


def luminance(scene) -> np.ndarray:
    """The scene rendered, as the brightness of each pixel over that of white, (rows, columns), rows upwards."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "picture.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        width, height = image.size
        pixels = np.empty(width * height * image.channels, np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
    rgb = pixels.reshape(height, width, -1)[:, :, :3].astype(np.float64)
    return rgb @ (0.2126, 0.7152, 0.0722)


def stretched(picture: np.ndarray) -> np.ndarray:
    """From 0 at the darkest hundredth of a picture to 1 at the brightest."""
    low, high = np.quantile(picture, (0.01, 0.99))
    return np.clip((picture - low) / max(high - low, 1e-9), 0.0, 1.0)


def save_gray(path: Path, gray: np.ndarray):
    """A PNG of brightnesses from 0 to 1, rows upwards."""
    pixels = np.repeat(gray[..., None], 4, axis=-1)
    pixels[..., 3] = 1.0
    image = bpy.data.images.new("gray", gray.shape[1], gray.shape[0])
    image.pixels.foreach_set(pixels.astype(np.float32).ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)
