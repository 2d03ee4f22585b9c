# SPDX-License-Identifier: GPL-3.0-or-later
"""2 km of sea from straight above: the highest autocorrelation of the picture outside the origin.

The ocean is fitted to the camera as *Fit Plane to Shot* does it, for every seed asked for. Beside it stand the
same sea as geometry alone, whose autocorrelation is that of its few waves, and Blender's Ocean modifier, 250 m of
it repeated.
"""

import json
import math
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import bpy
import numpy as np

from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.shot import Shot
from ocean_lod_addon.scene import ocean_object

from .correlation import correlation, expected, highest_beyond, slope_correlation
from .scenes import add_ocean, luminance, new_scene, save_gray, stretched

LIMIT = 0.1

WIDTH = 2000.0  # m
WIND = 8.0  # m/s
SEA = Sea(systems=(WaveSystem(wind_speed=WIND),))
_BRIGHTEST = 0.99
"""Brighter pixels than those of this rank are cut off: a few sparks are no pattern."""


def _this_ocean(seed):
    def add(scene, pixels):
        add_ocean(scene, replace(SEA, seed=seed), pixels)

    return add


def _as_geometry(waves):
    def add(scene, pixels):
        cell = 2.0 * WIDTH / 2000.0
        grid = Grid(cell_size=cell, cells=1024, levels=1)
        sea = Sea(systems=SEA.systems, wave_count=waves)
        ocean = ocean_object.create(scene, sea, grid, MaterialSettings(), ripples=Ripples(kind="off"))
        scene.collection.objects.link(ocean)

    return add


def _modifier(scene, pixels):
    """Blender's Ocean modifier: 250 m of sea, repeated 8 x 8."""
    ob = bpy.data.objects.new("Modifier", bpy.data.meshes.new("Modifier"))
    scene.collection.objects.link(ob)
    ocean = ob.modifiers.new("Ocean", "OCEAN")
    ocean.geometry_mode, ocean.repeat_x, ocean.repeat_y = "GENERATE", 8, 8
    ocean.spatial_size, ocean.resolution, ocean.viewport_resolution = 250, 8, 8
    ocean.wind_velocity, ocean.wave_scale = WIND, 1.0
    first = -0.5 * WIDTH + 125.0  # the middle of the first tile
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


def oceans(seeds: int) -> dict:
    """What adds each ocean to a scene, by its name: this one of the first `seeds` seeds, then the others."""
    own = {f"this ocean, seed {seed}": _this_ocean(seed) for seed in range(seeds)}
    return own | {
        "its geometry alone, 128 waves": _as_geometry(128),
        "its geometry alone, 1024 waves": _as_geometry(1024),
        "Ocean modifier": _modifier,
    }


@dataclass(frozen=True)
class Repetition:
    """Of one ocean: the highest autocorrelation outside the origin and where it is, m."""

    name: str
    highest: float
    shift: tuple[float, float]


def look(add, engine: str, pixels: int, samples: int) -> np.ndarray:
    """Two pictures of an ocean that differ in their noise, (2, pixels, pixels); `add` adds it to the scene."""
    shot = Shot(camera_height=1000.0, camera_pitch=math.pi / 2, sun_elevation=math.radians(50.0))
    scene = new_scene(shot, engine, pixels, pixels, samples)
    camera = scene.camera.data
    camera.type, camera.ortho_scale = "ORTHO", WIDTH
    add(scene, pixels)
    pictures = []
    for seed in (1, 2):
        scene.cycles.seed = seed
        pictures.append(luminance(scene))
    return np.minimum(pictures, np.quantile(pictures, _BRIGHTEST))


def run(options) -> None:
    """Print the highest autocorrelation of every ocean, and save pictures and numbers."""
    pixel = WIDTH / options.pixels
    perfect = expected(slope_correlation(SEA, 0.0, options.pixels, pixel), pixel)
    print(f"waves know of each other up to {perfect.length:.0f} m; beyond, chance leaves {perfect.chance:.3f}")
    found, shown = [], []
    for name, add in oceans(options.seeds).items():
        pictures = look(add, options.engine, options.pixels, options.samples)
        correlations = correlation(*pictures)
        peak = highest_beyond(correlations, pixel, perfect.length)
        found.append(Repetition(name, peak.value, peak.shift))
        x, y = peak.shift
        print(f"{name:<32} highest autocorrelation {peak.value:.3f}, at ({x:.0f}, {y:.0f}) m", flush=True)
        shown.append(np.vstack([np.abs(correlations), stretched(pictures.mean(axis=0))]))
    worst = max(each.highest for each in found[: options.seeds])
    print(f"{'PASS' if worst <= LIMIT else 'MISS'}: {worst:.3f}, allowed is {LIMIT:g}")
    if options.save:
        save_gray(Path(options.save) / "repetition.png", np.hstack([shown[0], shown[-1]]).clip(0.0, 1.0))
        report = {"limit": LIMIT, "perfect": asdict(perfect), "oceans": [asdict(each) for each in found]}
        (Path(options.save) / "repetition.json").write_text(json.dumps(report, indent=2) + "\n")
