# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of whole configurations, compared with the Reference's in steps of an 8-bit picture.

They are without noise: light of a sun that is a point, reflected by the Ross BRDF in math nodes and scattered by
the water's body, under a black sky, with the same rays through each pixel. So a difference is the mesh's doing.
Ripples are left out: those of another resolution are other ripples of the same kind, and neither are truer.
"""

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...core.cost.quality import QUALITIES, apply
from ...core.lod import Grid
from ...core.material_settings import MaterialSettings
from ...core.plan import Settings
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from ...core.shot import Shot
from ..bench import in_blender
from . import frames

REFERENCE, TWICE = "reference", "twice the reference"

STEPS = 255.0

_WIDTH, _HEIGHT = 160, 90
_PIXEL_SAMPLES = 256
_SHOT = Shot(camera_height=3.0, sun_elevation=np.radians(35.0), sun_azimuth=np.radians(5.0))
_WHITE = 99.0
"""Percentile of the Reference's radiance that is shown as white: glitter may be brighter."""

_SIZED = frames.settings_of(Sea(), Grid(cell_size=0.1, cells=96, levels=12), Ripples(kind="off"))
_TIME_FRAME = 24


@dataclass(frozen=True)
class PictureDifference:
    """Difference of a picture from another in steps of 1/255 of white, over all pixels with water in either."""

    mean: float
    percentile_95: float
    percentile_99: float

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "mean_steps": self.mean,
            "percentile_95_steps": self.percentile_95,
            "percentile_99_steps": self.percentile_99,
        }


@dataclass(frozen=True)
class Pictures:
    """Differences from the Reference's picture by quality, and its own from one of twice everything."""

    differences: dict[str, PictureDifference]
    reference_from_twice: PictureDifference

    @property
    def converged(self) -> bool:
        """Whether twice of everything changes the picture by less than a step, in the mean and for 95 % of it."""
        return max(self.reference_from_twice.mean, self.reference_from_twice.percentile_95) < 1.0

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "differences": {name: difference.as_mapping() for name, difference in self.differences.items()},
            "reference_from_twice": self.reference_from_twice.as_mapping(),
            "converged": self.converged,
        }


def shown(radiance: np.ndarray, white: float) -> np.ndarray:
    """A picture as a screen shows it, in steps of 0 to 255, not rounded: clipped at white, sRGB."""
    linear = np.clip(radiance / white, 0.0, 1.0)
    curve = 1.055 * np.maximum(linear, 0.0031308) ** (1.0 / 2.4) - 0.055
    return STEPS * np.where(linear <= 0.0031308, 12.92 * linear, curve)


def difference(radiance: np.ndarray, truth: np.ndarray, white: float) -> PictureDifference:
    """How far two pictures are apart, where they are not both black: the sky is."""
    water = (radiance > 0.0).any(axis=-1) | (truth > 0.0).any(axis=-1)
    steps = np.abs(shown(radiance, white) - shown(truth, white))[water]
    return PictureDifference(float(steps.mean()), *map(float, np.percentile(steps, (95.0, 99.0))))


def compare(keep_in: Path | None = None) -> Pictures:
    """Render all qualities and compare them; pictures are kept as PNG in a folder if one is given."""
    radiance = {name: render(apply(quality, _SIZED)) for name, quality in QUALITIES.items()}
    radiance[TWICE] = render(twice(apply(QUALITIES[REFERENCE], _SIZED)), _PIXEL_SAMPLES * 2)
    white = float(np.percentile(radiance[REFERENCE], _WHITE))
    if keep_in is not None:
        for name, picture in radiance.items():
            save_png(shown(picture, white), keep_in / f"cost_{name.replace(' ', '_')}.png")
    return Pictures(
        {name: difference(radiance[name], radiance[REFERENCE], white) for name in QUALITIES},
        difference(radiance[REFERENCE], radiance[TWICE], white),
    )


def twice(settings: Settings) -> Settings:
    """Twice the vertices per wavelength, cells and extent: the same waves."""
    grid = settings.grid
    doubled = Grid(grid.cell_size / 2, grid.cells * 2, grid.levels + 1, grid.samples_per_wavelength * 2)
    return replace(settings, grid=doubled)


def render(settings: Settings, samples: int = _PIXEL_SAMPLES) -> np.ndarray:
    """The radiance that a configuration's picture shows, (height, width, 3), the lowest row first."""
    import bpy

    material = MaterialSettings(sun_model="formula")
    with in_blender.fresh_data(), tempfile.TemporaryDirectory() as folder:
        ocean = frames.BlenderOcean.of(replace(settings, material=material))
        scene = ocean.scene
        _light(scene)
        _camera(scene)
        scene.frame_set(_TIME_FRAME)
        ocean.handle(1.0)
        _set_engine(scene, samples)
        path = Path(folder) / "picture.exr"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True, scene=scene.name)
        return _read(path)


def _light(scene):
    import bpy
    from mathutils import Vector

    scene.world = bpy.data.worlds.get("Black of cost") or bpy.data.worlds.new("Black of cost")
    scene.world.color = (0.0, 0.0, 0.0)
    if scene.world.node_tree is not None:
        scene.world.node_tree.nodes.clear()
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.data.angle = 1000.0, 0.0
    elevation, azimuth = _SHOT.sun_elevation, _SHOT.sun_azimuth
    to_sun = Vector((np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)))
    sun.rotation_euler = to_sun.to_track_quat("Z", "Y").to_euler()
    scene.collection.objects.link(sun)


def _camera(scene):
    from ...scene import shot_scene

    shot_scene.add_camera(scene, _SHOT)
    scene.render.resolution_x, scene.render.resolution_y = _WIDTH, _HEIGHT
    scene.render.resolution_percentage = 100


def _set_engine(scene, samples):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces, cycles.seed = samples, 0, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    image = scene.render.image_settings
    image.file_format, image.color_depth, image.color_mode = "OPEN_EXR", "32", "RGB"


def _read(path):
    import bpy

    image = bpy.data.images.load(str(path))
    pixels = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], -1)[:, :, :3].astype(np.float64)


def save_png(steps: np.ndarray, path: Path) -> None:
    """Write a picture of 0 to 255 steps, the lowest row first."""
    import bpy

    height, width, _ = steps.shape
    image = bpy.data.images.new("cost", width, height, alpha=False)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.dstack([steps / STEPS, np.ones((height, width))]).astype(np.float32).ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)
