# SPDX-License-Identifier: GPL-3.0-or-later
"""A patch of flat mean sea keeps its mean radiance as the camera backs off and its levels trade places."""

import dataclasses
import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.ripples.bump import Bump
from ocean_lod_addon.core.ripples.handover import band_variances, bump_share
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.slope_budget import total_slope_variance, wave_tensors
from ocean_lod_addon.core.windows import window, window_reach
from ocean_lod_addon.nodes.material import ensure_material, set_sun
from ocean_lod_addon.nodes.ripple_parts import PIXEL_PROPERTY
from ocean_lod_addon.nodes.ripples_material import set_ripple_values, show_ripples
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene.ripple_images import ensure_images, write_images
from tests.render.exr import read_pixels

pytestmark = pytest.mark.render

SEA = Sea(systems=(WaveSystem(wind_speed=4.0, direction=0.4),), seed=9)
GRID = Grid(cell_size=0.4)
PIXEL_ANGLE = 36.0 / 35.0 / 1920.0
ELEVATION = math.radians(35.0)
SIDE, CELL = 140.0, 0.4
SEEN, PIXELS, SAMPLES = 60.0, 96, 12
DISTANCES = (2.0, 12.0, 60.0, 300.0, 5000.0)


class Patch:
    """A square of sea whose every point has the levels of one distance, seen from one direction."""

    def __init__(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.waves = discretise(SEA, GRID.shortest_wavelength)
        self.bump = Bump(Ripples(), SEA, GRID, self.waves)
        n = round(SIDE / CELL) + 1
        line = (np.arange(n) - (n - 1) / 2) * CELL
        self.x, self.y = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
        corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).reshape(-1, 1)
        faces = corner + np.array([0, n, n + 1, 1])
        self.mesh = bpy.data.meshes.new("Water")
        self.mesh.from_pydata(np.column_stack([self.x, self.y, 0.0 * self.x]), [], faces)
        self.mesh.attributes.new(mesh_arrays.SLOPE_VARIANCE, "FLOAT_VECTOR", "POINT")
        self.mesh.attributes.new("custom_normal", "FLOAT_VECTOR", "POINT")
        mesh_arrays.ensure_ripple_attributes(self.mesh, self.bump.layout.handed_over)
        mesh_arrays.ensure_rest_positions(self.mesh, wanted=True)
        mesh_arrays.write_rest_positions(self.mesh, np.zeros((1, 2)), np.column_stack([self.x, self.y]))
        self.ob = bpy.data.objects.new("Water", self.mesh)
        self._add_material()
        scene = self.scene = bpy.context.scene
        scene.collection.objects.link(self.ob)
        self._add_light_and_camera()
        scene.render.engine = "CYCLES"
        scene.cycles.samples, scene.cycles.use_adaptive_sampling = SAMPLES, False
        scene.cycles.use_denoising = False
        scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0.0
        scene.render.resolution_x = scene.render.resolution_y = PIXELS
        settings = scene.render.image_settings
        settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"

    def _add_material(self):
        material = ensure_material("Water", MaterialSettings())
        images = ensure_images("Water", self.bump.layout)
        show_ripples(material, self.bump.layout, images)
        set_ripple_values(material, self.bump.tensors, self.bump.wave_height)
        write_images(images, self.bump, 1.0)
        set_sun(material, None)
        self.mesh.materials.append(material)

    def _add_light_and_camera(self):
        """A white sky, and a sun that stands where a slope of about two deviations mirrors it."""
        world = bpy.data.worlds.new("Sky")
        if world.node_tree is None:
            world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        self.scene.world = world
        sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
        sun.data.energy, sun.data.angle = 0.2, 0.0
        sun.rotation_euler = (0.0, 0.5 * math.pi - ELEVATION - 0.35, math.pi)
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", SEEN, 1e4
        away = 300.0
        camera.location = (away * math.cos(ELEVATION), 0.0, away * math.sin(ELEVATION))
        camera.rotation_euler = (0.5 * math.pi - ELEVATION, 0.0, 0.5 * math.pi)
        for ob in (sun, camera):
            self.scene.collection.objects.link(ob)
        self.scene.camera = camera

    def back_off(self, distance):
        """Give the patch what the mesh, the attributes and the pixels are at a distance in m."""
        waves, bands = self.waves, self.bump.layout.bands[: self.bump.layout.handed_over]
        w = window(distance * math.cos(ELEVATION), window_reach(GRID, waves.wavelength))
        shown = dataclasses.replace(waves, amplitude=waves.amplitude * w)
        points = surface_points(shown, self.x, self.y, 1.0)
        unresolved = total_slope_variance(SEA, waves) - (wave_tensors(waves) * w[:, None] ** 2).sum(axis=0)
        resolved = (band_variances(waves, bands) * w[:, None] ** 2).sum(axis=0)
        amplitudes = np.sqrt(bump_share(resolved, self.bump.tensors[: len(bands)]))
        count = len(self.x)
        mesh_arrays.write_positions(self.mesh, points.position.astype(np.float32))
        mesh_arrays.write_vectors(self.mesh, "custom_normal", points.normal.astype(np.float32))
        mesh_arrays.write_slope_variance(self.mesh, np.tile(np.float32(unresolved), (count, 1)))
        mesh_arrays.write_ripple_amplitudes(self.mesh, np.tile(np.float32(amplitudes), (count, 1)))
        self.ob[PIXEL_PROPERTY] = (0.0, PIXEL_ANGLE * distance, 0.0)
        self.mesh.update()
        self.ob.update_tag()

    def radiance(self, path) -> float:
        """Mean of the picture."""
        self.scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        return float(read_pixels(path)[..., 0].astype(np.float64).mean())


def test_mean_radiance_does_not_depend_on_the_distance(tmp_path):
    """From 2 m, where mesh and ripples show nearly all slopes, to 5 km, where the BRDF has them all. 3 % is
    what an eye may notice between two frames; 110 000 samples and some 200 of the longest waves leave 1 %."""
    patch = Patch()
    radiances = []
    for distance in DISTANCES:
        patch.back_off(distance)
        radiances.append(patch.radiance(tmp_path / "patch.exr"))
    mean = np.mean(radiances)
    assert np.abs(np.array(radiances) / mean - 1.0).max() < 0.03, radiances
