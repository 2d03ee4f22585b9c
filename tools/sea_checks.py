# SPDX-License-Identifier: GPL-3.0-or-later
"""Two checks on rendered pictures that take too long for the tests. Run in one of the Blender environments:

    python tools/sea_checks.py repetition
    python tools/sea_checks.py flicker --engine CYCLES

`repetition` looks straight down on 2 km of sea, and on Blender's Ocean modifier repeated over as much. It prints
the highest autocorrelation of each picture at distances at which waves no longer know of each other.

`flicker` dollies slowly towards the horizon while the sea moves. It prints by how much pixels of the band below
the horizon change from frame to frame, over the same in pictures of 8 x 8 as many pixels, scaled down: those show
the waves that a pixel of the frame can not resolve one by one, as a lens would.
"""

import argparse
import math
import os
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
_FOLDER = tempfile.TemporaryDirectory(prefix="ocean_lod_checks_")
os.environ["BLENDER_USER_RESOURCES"] = _FOLDER.name

import bpy  # noqa: E402
import numpy as np  # noqa: E402

import ocean_lod_addon  # noqa: E402
from ocean_lod_addon.cli.render import set_engine, set_samples  # noqa: E402
from ocean_lod_addon.core import presets  # noqa: E402
from ocean_lod_addon.core.lod import Grid  # noqa: E402
from ocean_lod_addon.core.material_settings import MaterialSettings  # noqa: E402
from ocean_lod_addon.core.sea import Sea, WaveSystem  # noqa: E402
from ocean_lod_addon.core.shot import Shot  # noqa: E402
from ocean_lod_addon.core.shot_fit import HIGHEST_WAVE, PIXELS_PER_CELL, fit, frame_needs  # noqa: E402
from ocean_lod_addon.scene import ocean_object, placing, shot_scene  # noqa: E402

SUPERSAMPLING = 8


def new_scene(shot: Shot, engine: str, width: int, height: int, samples: int):
    """A scene with a shot's camera and sky, without an ocean."""
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


def luminance(scene) -> np.ndarray:
    """The scene rendered, as the brightness of each pixel over that of white, (rows, columns), rows upwards."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    scene.render.filepath = str(Path(_FOLDER.name) / "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    rgb = pixels.reshape(height, width, -1)[:, :, :3].astype(np.float64)
    return rgb @ (0.2126, 0.7152, 0.0722) * 2.0**scene.view_settings.exposure


# Repetition

AERIAL_WIDTH = 2000.0  # m
AERIAL_PIXELS = 512
AERIAL_WIND = 8.0  # m/s


def detrended(picture: np.ndarray) -> np.ndarray:
    """Less its best quadratic surface: what light does over 2 km is no repetition, nor its absence."""
    n = len(picture)
    y, x = np.mgrid[:n, :n] / n
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1).reshape(n * n, -1)
    return picture - (terms @ np.linalg.lstsq(terms, picture.ravel(), rcond=None)[0]).reshape(n, n)


def autocorrelation(picture: np.ndarray) -> np.ndarray:
    """Of a picture (n, n), for shifts from -n/2 to n/2 - 1 pixels along both axes; 1 in the middle.

    Only pixels that are in the picture before and after a shift are compared.
    """
    n = len(picture)
    padded = np.zeros((2 * n, 2 * n))
    padded[:n, :n] = detrended(picture)
    inside = np.zeros((2 * n, 2 * n))
    inside[:n, :n] = 1.0
    sums, counts = (np.fft.ifft2(np.abs(np.fft.fft2(image)) ** 2).real for image in (padded, inside))
    shifts = np.fft.fftshift(sums / np.maximum(counts, 1.0))[n // 2 : n + n // 2, n // 2 : n + n // 2]
    return shifts / shifts[n // 2, n // 2]


def highest_beyond(correlation: np.ndarray, pixel: float, distance: float) -> float:
    """The highest value at shifts of more than `distance` in m."""
    n = len(correlation)
    y, x = np.mgrid[:n, :n] - n // 2
    return float(correlation[pixel * np.hypot(x, y) > distance].max())


def add_modifier_ocean(scene):
    """Blender's Ocean modifier: 250 m of sea, repeated 8 x 8."""
    ob = bpy.data.objects.new("Modifier", bpy.data.meshes.new("Modifier"))
    scene.collection.objects.link(ob)
    ocean = ob.modifiers.new("Ocean", "OCEAN")
    ocean.geometry_mode, ocean.repeat_x, ocean.repeat_y = "GENERATE", 8, 8
    ocean.spatial_size, ocean.resolution, ocean.viewport_resolution = 250, 8, 8
    ocean.wind_velocity, ocean.wave_scale = AERIAL_WIND, 1.0
    first = -0.5 * AERIAL_WIDTH + 125.0  # the middle of the first tile
    ob.location = (first, first, 0.0)
    material = bpy.data.materials.new("Water")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    glossy, output = tree.nodes.new("ShaderNodeBsdfGlossy"), tree.nodes.new("ShaderNodeOutputMaterial")
    glossy.inputs["Roughness"].default_value = 0.45
    tree.links.new(glossy.outputs[0], output.inputs["Surface"])
    ob.data.materials.append(material)


def add_ocean(scene):
    """This extension's ocean, as the picture calls for."""
    grid = Grid(cell_size=2.0, cells=1024, levels=1)
    sea = Sea(systems=(WaveSystem(wind_speed=AERIAL_WIND),), wave_count=1024)
    scene.collection.objects.link(ocean_object.create(scene, sea, grid, MaterialSettings()))


def repetition(options):
    """Print the highest autocorrelation of both oceans."""
    for name, add in (("this ocean", add_ocean), ("Ocean modifier", add_modifier_ocean)):
        shot = Shot(camera_height=1000.0, camera_pitch=math.pi / 2, sun_elevation=math.radians(50.0))
        scene = new_scene(shot, options.engine, AERIAL_PIXELS, AERIAL_PIXELS, options.samples)
        camera = scene.camera.data
        camera.type, camera.ortho_scale = "ORTHO", AERIAL_WIDTH
        add(scene)
        picture = luminance(scene)
        picture = np.minimum(picture, np.quantile(picture, 0.99))  # a few sparks are no pattern
        if options.save:
            save_gray(Path(options.save) / f"{name.replace(' ', '_')}.png", picture)
        correlation = autocorrelation(picture)
        pixel = AERIAL_WIDTH / AERIAL_PIXELS
        values = "   ".join(f"{d:g} m: {highest_beyond(correlation, pixel, d):6.3f}" for d in (100, 200, 400))
        print(f"{name:<16} highest autocorrelation beyond {values}", flush=True)


def save_gray(path: Path, picture: np.ndarray):
    """A PNG of brightnesses stretched from their darkest to their brightest hundredth."""
    low, high = np.quantile(picture, (0.01, 0.99))
    gray = np.clip((picture - low) / (high - low), 0.0, 1.0)
    image = bpy.data.images.new("gray", picture.shape[1], picture.shape[0])
    image.pixels.foreach_set(np.repeat(gray[..., None], 4, axis=-1).astype(np.float32).ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()


# Flicker


def flicker(options):
    """Print the change from frame to frame of the frames, of the reference, and their ratio."""
    band = options.band
    results = {}
    for name, factor, samples in (
        ("frames", 1, options.samples),
        ("reference", SUPERSAMPLING, max(1, options.samples // SUPERSAMPLING**2)),
    ):
        shot = Shot(camera_height=3.0, camera_pitch=0.0)
        scene = new_scene(shot, options.engine, 960 * factor, 540 * factor, samples)
        needs = frame_needs(placing.view_of(scene.camera, scene), 960)
        preset = presets.load("moderate")
        grid = fit(Grid(), [needs], PIXELS_PER_CELL, HIGHEST_WAVE)
        scene.collection.objects.link(ocean_object.create(scene, preset.sea, grid, preset.material))
        render = scene.render
        render.use_border = render.use_crop_to_border = True
        render.border_min_x, render.border_max_x = 0.5 - 0.5 * options.width / 960, 0.5 + 0.5 * options.width / 960
        render.border_min_y, render.border_max_y = 0.5 - (band + 2) / 540, 0.5 - 2 / 540
        frames = []
        for number in range(options.frames):
            scene.frame_set(1 + number)
            scene.camera.location.x = 0.05 * number
            picture = luminance(scene)
            rows, columns = (side // factor for side in picture.shape)
            squares = picture[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor)
            frames.append(np.minimum(squares.mean(axis=(1, 3)), 1.0))  # as they are seen: glitter is white
            if options.save and number == 0:
                save_gray(Path(options.save) / f"{options.engine}_{name}.png", frames[0])
        results[name] = float(np.sqrt(np.mean(np.diff(frames, axis=0) ** 2)))
        print(f"{name:<10} mean {np.mean(frames):.4f}  rms change per frame {results[name]:.5f}", flush=True)
    print(f"{options.engine}: flickers {results['frames'] / results['reference']:.2f} times the reference")


def main():
    """Run the check that the command line names."""
    parser = argparse.ArgumentParser(description="Checks on rendered pictures of the sea.")
    parser.add_argument("check", choices=("repetition", "flicker"))
    parser.add_argument("--engine", choices=("CYCLES", "EEVEE"), default="CYCLES")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--band", type=int, default=16, help="rows of pixels below the horizon")
    parser.add_argument("--width", type=int, default=96, help="columns of pixels")
    parser.add_argument("--save", metavar="FOLDER", help="save pictures there as well")
    options = parser.parse_args()
    {"repetition": repetition, "flicker": flicker}[options.check](options)
    sys.stdout.flush()
    os._exit(0)  # Blender 4.5 can hang in its own exit handlers


if __name__ == "__main__":
    main()
