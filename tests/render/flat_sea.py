# SPDX-License-Identifier: GPL-3.0-or-later
"""A flat sea under a sun and a black sky, seen by a wide camera: each pixel is another direction of view.

One render so holds a whole set of view angles. Pixels are sampled at their centres, the sun is a point, and
what a pixel must show is then a formula of its direction alone.
"""

import math
from dataclasses import dataclass

import bpy
import numpy as np

from ocean_lod_addon.nodes.material import SLOPE_VARIANCE_ATTRIBUTE

HALF_SIZE = 500.0
CAMERA_HEIGHT = 1.0


@dataclass(frozen=True)
class Camera:
    """A perspective camera above the origin, looking along +x, `pitch` below the horizon, angles in rad."""

    pixels: int = 48
    field_of_view: float = math.radians(150.0)
    pitch: float = math.radians(45.0)

    def directions(self) -> np.ndarray:
        """Unit vectors from the camera through the pixel centres, shape (rows, columns, 3), top row first."""
        half_width = math.tan(0.5 * self.field_of_view)
        steps = ((np.arange(self.pixels) + 0.5) / self.pixels * 2.0 - 1.0) * half_width
        right, up = np.meshgrid(steps, -steps)
        forward = np.array([math.cos(self.pitch), 0.0, -math.sin(self.pitch)])
        upward = np.array([math.sin(self.pitch), 0.0, math.cos(self.pitch)])
        rays = forward + right[..., None] * np.array([0.0, -1.0, 0.0]) + up[..., None] * upward
        return rays / np.linalg.norm(rays, axis=-1, keepdims=True)


def direction(elevation_degrees: float, azimuth_degrees: float) -> np.ndarray:
    """The unit vector at an elevation and an azimuth (counter-clockwise from +x)."""
    e, a = math.radians(elevation_degrees), math.radians(azimuth_degrees)
    return np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])


def build_scene(material, slope_variance, to_sun, irradiance, camera=None):
    """An empty file's scene with the sea, a point sun (None for no sun) and the camera."""
    camera = camera or Camera()
    scene = bpy.context.scene
    _add_plane(scene, material, slope_variance)
    if to_sun is not None:
        _add_sun(scene, to_sun, irradiance)
    _add_camera(scene, camera)
    world = bpy.data.worlds.new("Black")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    scene.world = world
    scene.render.resolution_x = scene.render.resolution_y = camera.pixels
    scene.render.resolution_percentage = 100
    return scene


def _add_plane(scene, material, slope_variance):
    corners = [(x * HALF_SIZE, y * HALF_SIZE, 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    mesh = bpy.data.meshes.new("Sea")
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    attribute = mesh.attributes.new(SLOPE_VARIANCE_ATTRIBUTE, "FLOAT_VECTOR", "POINT")
    attribute.data.foreach_set("vector", np.tile(np.asarray(slope_variance, np.float32), 4))
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("Sea", mesh))


def _add_sun(scene, to_sun, irradiance):
    light = bpy.data.lights.new("Sun", "SUN")
    light.energy, light.angle = irradiance, 0.0
    sun = bpy.data.objects.new("Sun", light)
    elevation = math.asin(to_sun[2])
    sun.rotation_euler = (0.0, math.pi / 2 - elevation, math.atan2(to_sun[1], to_sun[0]))
    scene.collection.objects.link(sun)


def _add_camera(scene, camera):
    data = bpy.data.cameras.new("Camera")
    data.sensor_fit, data.angle, data.clip_start, data.clip_end = "HORIZONTAL", camera.field_of_view, 0.01, 1e4
    looking = bpy.data.objects.new("Camera", data)
    looking.location = (0.0, 0.0, CAMERA_HEIGHT)
    looking.rotation_euler = (math.pi / 2 - camera.pitch, 0.0, -math.pi / 2)
    scene.collection.objects.link(looking)
    scene.camera = looking


def render_cycles(scene, path, samples=4) -> np.ndarray:
    """Linear RGB, shape (rows, columns, 3), top row first."""
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "GAUSSIAN"  # a box would be a whole pixel wide
    scene.cycles.filter_width = 0.01
    scene.cycles.max_bounces = 1
    scene.cycles.sample_clamp_indirect = 0.0
    return _render(scene, path)


def render_eevee(scene, path, samples=1) -> np.ndarray:
    """Linear RGB, shape (rows, columns, 3), top row first."""
    scene.render.engine = "BLENDER_EEVEE_NEXT" if bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"
    scene.eevee.taa_render_samples = samples
    scene.render.filter_size = 0.01
    return _render(scene, path)


def _render(scene, path):
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, -1)[::-1, :, :3].astype(np.float64)
