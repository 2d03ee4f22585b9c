# SPDX-License-Identifier: GPL-3.0-or-later
"""Knobs that only Blender can measure: whose normals are shaded, and which way the sun is reflected."""

import functools
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ....core.discretise import discretise
from ....core.effects import Effects
from ....core.gerstner import surface_points
from ....core.lod import Grid, undisturbed_positions
from ....core.material_settings import MaterialSettings
from ....core.optics import cox_munk, ross
from ....core.ripple_settings import Ripples
from ....core.sea import Sea
from ...bench.in_blender import fresh_data
from .. import frames
from .knob import Knob, Step
from .shading import OPS, REFRACTIVE_INDEX, WIND, directions, gaussian_slopes, rms_percent

# ------------------------------------------------------------------------------------------------- normals

_GRID = Grid(cell_size=0.1, cells=128, levels=8)
_TIME = 2.0  # s
_NEAR = 1.5  # m; there the windows of all waves are 1


def _normals_ocean(word):
    settings = frames.settings_of(Sea(), _GRID, Ripples(kind="off"))
    return frames.BlenderOcean.of(replace(settings, effects=Effects(analytic_normals=word)))


def _slopes(normals):
    return -normals[:, :2] / normals[:, 2:]


def _normals_error(word):
    """Share of the slope variance nearby that the shaded normals miss, in percent."""
    with fresh_data():
        ocean = _normals_ocean(word)
        ocean.handle(_TIME)
        mesh = ocean.ob.data
        normals = np.empty((len(mesh.vertices), 3), np.float32)
        if word == "on":
            mesh.attributes["custom_normal"].data.foreach_get("vector", normals.ravel())
        else:
            mesh.update()
            mesh.vertex_normals.foreach_get("vector", normals.ravel())
    flat = undisturbed_positions(_GRID, np.zeros((_GRID.levels, 2)))
    near = np.abs(flat).max(axis=1) < _NEAR
    waves = discretise(Sea(), _GRID.shortest_wavelength)
    truth = surface_points(waves, *flat[near].T, _TIME).slope
    return 100.0 * float(np.mean((_slopes(normals[near]) - truth) ** 2) / np.mean(truth**2))


def _normals_work(word):
    """A frame up to the normals that a picture needs. What is made stays until the program ends."""
    ocean = _normals_ocean(word)
    evaluated_mesh = functools.partial(_evaluated_mesh, ocean)

    def frame(time):
        ocean.handle(time)
        ocean.evaluate()
        evaluated_mesh().corner_normals[0].vector  # noqa: B018 - Blender makes them when they are asked for

    return frame


def _evaluated_mesh(ocean):
    return ocean.ob.evaluated_get(ocean.scene.view_layers[0].depsgraph).data


NORMALS = Knob(
    "normals",
    "Normals of faces or of waves",
    "Shading of the waves nearby: faces blunt the short ones",
    "Slopes within 1.5 m of the camera, mean square error over mean square",
    "% of slope variance",
    "The derivatives of the displaced surface in float64",
    f"a frame of {_GRID.vertex_count} vertices in Blender, normals included",
    (
        Step("of the faces", lambda: _normals_error("off"), lambda: _normals_work("off")),
        Step("of the waves", lambda: _normals_error("on"), lambda: _normals_work("on")),
    ),
    in_blender=True,
)

# ----------------------------------------------------------------------------------------------- reflection

_ELEVATIONS = (4.0, 10.0, 20.0, 40.0, 70.0)  # degrees, of the viewer
_SUN_ELEVATION = 30.0
_IRRADIANCE = 1000.0
_TIMED_SIDE, _TIMED_SAMPLES = 192, 8


@dataclass(frozen=True)
class _GlitterScene:
    """A flat sea of roughness alone under a sun that is a point and a black sky, seen without perspective."""

    scene: object
    camera: object

    def look(self, elevation):
        """See it from an elevation in degrees, looking into the sun's glitter."""
        x, y, z = _to_viewer(elevation)
        self.camera.location = (100.0 * x, 100.0 * y, 100.0 * z)
        self.camera.rotation_euler = (np.radians(90.0 - elevation), 0.0, -np.pi / 2)

    def render(self, side, samples):
        """Mean radiance of a picture."""
        import bpy

        self.scene.render.resolution_x = self.scene.render.resolution_y = side
        self.scene.cycles.samples = samples
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "glitter.exr"
            self.scene.render.filepath = str(path)
            bpy.ops.render.render(write_still=True, scene=self.scene.name)
            image = bpy.data.images.load(str(path))
            pixels = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
            image.pixels.foreach_get(pixels)
            channels = image.channels
            bpy.data.images.remove(image)
        return float(pixels.reshape(-1, channels)[:, 0].astype(np.float64).mean())


def _to_viewer(elevation):
    return tuple(map(float, directions(np.radians(90.0 - elevation), np.float64(np.pi))))


def _to_sun():
    return tuple(map(float, directions(np.radians(90.0 - _SUN_ELEVATION), np.float64(0.0))))


def _glitter_scene(sun_model):
    import bpy

    from .... import register
    from ....nodes.material import SLOPE_VARIANCE_ATTRIBUTE, ensure_material, set_sun
    from ....nodes.scene_sun import claim_sun, scene_sun

    if not hasattr(bpy.types.Object, "ocean_lod"):
        register()
    scene = bpy.data.scenes.new("glitter")
    scene.world = bpy.data.worlds.new("glitter")
    scene.world.color = (0.0, 0.0, 0.0)
    if scene.world.node_tree is not None:
        scene.world.node_tree.nodes.clear()
    settings = MaterialSettings(sun_model=sun_model, tint_red=0.0, tint_green=0.0, tint_blue=0.0)
    material = ensure_material(f"glitter {sun_model}", settings)
    mesh = bpy.data.meshes.new("glitter")
    side = 2000.0
    mesh.from_pydata([(-side, -side, 0), (side, -side, 0), (side, side, 0), (-side, side, 0)], [], [(0, 1, 2, 3)])
    tensor = (cox_munk.slope_variance_along(WIND), cox_munk.slope_variance_across(WIND), 0.0)
    mesh.attributes.new(SLOPE_VARIANCE_ATTRIBUTE, "FLOAT_VECTOR", "POINT").data.foreach_set(
        "vector", np.tile(np.float32(tensor), 4)
    )
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("glitter", mesh))
    lamp = bpy.data.objects.new("glitter", bpy.data.lights.new("glitter", "SUN"))
    lamp.data.energy, lamp.data.angle = _IRRADIANCE, 0.0
    lamp.rotation_euler = (0.0, np.radians(90.0 - _SUN_ELEVATION), 0.0)
    scene.collection.objects.link(lamp)
    camera = bpy.data.objects.new("glitter", bpy.data.cameras.new("glitter"))
    camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 1.0, 1e4
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.view_layers[0].update()
    claim_sun(scene, settings)
    set_sun(material, scene_sun(scene))
    scene.render.engine, scene.render.resolution_percentage = "CYCLES", 100
    scene.cycles.max_bounces, scene.cycles.seed = 1, 0
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    image = scene.render.image_settings
    image.file_format, image.color_depth, image.color_mode = "OPEN_EXR", "32", "RGB"
    return _GlitterScene(scene, camera)


def _reflection_error(sun_model):
    slopes, light = gaussian_slopes(), _to_sun()
    truth = [
        _IRRADIANCE * float(ross.sun_radiance_factor(OPS, _to_viewer(e), light, slopes, REFRACTIVE_INDEX))
        for e in _ELEVATIONS
    ]
    with fresh_data():
        glitter = _glitter_scene(sun_model)
        values = []
        for elevation in _ELEVATIONS:
            glitter.look(elevation)
            values.append(glitter.render(4, 1))
    return rms_percent(np.array(values), np.array(truth))


def _reflection_work(sun_model):
    glitter = _glitter_scene(sun_model)
    glitter.look(_SUN_ELEVATION)
    return lambda _time: glitter.render(_TIMED_SIDE, _TIMED_SAMPLES)


REFLECTION = Knob(
    "reflection",
    "Cycles' closure or the formula",
    "Brightness of the sun's glitter in Cycles",
    "Glitter of a sun 30 degrees high, seen from 4 to 70 degrees, rms (wind 10 m/s)",
    "% of radiance",
    "The Ross BRDF in float64",
    f"a picture of {_TIMED_SIDE} x {_TIMED_SIDE} pixels with {_TIMED_SAMPLES} samples in Cycles",
    (
        Step(
            "closure",
            functools.partial(_reflection_error, "closure"),
            functools.partial(_reflection_work, "closure"),
        ),
        Step(
            "formula in nodes",
            functools.partial(_reflection_error, "formula"),
            functools.partial(_reflection_work, "formula"),
        ),
    ),
    in_blender=True,
)
