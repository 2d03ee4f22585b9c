# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered frames show the surface of their own frame, however the frames are rendered."""

import hashlib
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from scipy.interpolate import LinearNDInterpolator

import ocean_lod_addon
from ocean_lod_addon.core import ocean_time
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene import ocean_object, properties
from tests.render.exr import read_pixels

FRAMES = range(1, 5)
SIDE = 24  # pixels
VIEW = 12.0  # m across
SHIFT = 20.0  # m, added to positions so that no pixel is negative
TOLERANCE = 0.03  # m
REPOSITORY = Path(__file__).parents[2]


def build_scene(engine):
    """A 12 m square of a steep sea seen from straight above, in a material that shows its height."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    scene = bpy.context.scene
    sea = Sea(systems=(WaveSystem(wind_speed=8.0),), wave_count=64)
    ob = ocean_object.create(scene, sea, Grid(cell_size=0.25, cells=64, levels=2), properties.MaterialSettings())
    scene.collection.objects.link(ob)
    ob.data.materials.clear()
    ob.data.materials.append(height_material())
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", VIEW
    camera.location.z = 50.0
    scene.collection.objects.link(camera)
    scene.camera = camera
    render = scene.render
    render.engine = engine
    render.resolution_x = render.resolution_y = SIDE
    render.filter_size = 0.01
    scene.cycles.samples = scene.eevee.taa_render_samples = 1
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.frame_start, scene.frame_end = FRAMES[0], FRAMES[-1]
    image = render.image_settings
    if hasattr(image, "media_type"):
        image.media_type = "IMAGE"
    image.file_format, image.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Raw"
    return scene, ob


def height_material():
    material = bpy.data.materials.new("Height")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    emission = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shift = tree.nodes.new("ShaderNodeVectorMath")  # a height below 0 would be clipped
    shift.inputs[1].default_value = (SHIFT, SHIFT, SHIFT)
    tree.links.new(geometry.outputs["Position"], shift.inputs[0])
    tree.links.new(shift.outputs["Vector"], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material


def expected_heights(ob, frame, fps):
    """Height of the surface of `frame` at x, y: interpolated between its vertices, computed without Blender."""
    surface = ocean_object.Surface(ocean_object.read_ocean(ob, bpy.context.scene))
    positions = np.empty((surface.vertex_count, 3), np.float32)
    time = ocean_time.sea_time(ocean_time.OceanTime(), frame, fps)
    surface.positions(time, surface.placement(), positions)
    return LinearNDInterpolator(positions[:, :2], positions[:, 2])


@pytest.mark.render
@pytest.mark.parametrize("engine", ["CYCLES", "EEVEE"])
def test_each_rendered_frame_shows_its_own_surface(engine, tmp_path):
    """Pixels carry the position they hit; the height there is that frame's, not the neighbouring frame's.

    Quads that renderers split into triangles their own way, and half-float pixels in EEVEE (8 mm at SHIFT), differ
    by less than TOLERANCE; a frame late would be wrong by several times that.
    """
    if engine == "EEVEE":
        names = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
        engine = next(name for name in names if name.startswith("BLENDER_EEVEE"))
    scene, ob = build_scene(engine)
    scene.render.fps = 1  # a second between frames, so that neighbouring frames differ clearly
    scene.render.filepath = str(tmp_path / "frame_####")
    bpy.ops.render.render(animation=True)
    for frame in FRAMES:
        pixels = read_pixels(tmp_path / f"frame_{frame:04d}.exr")[..., :3].reshape(-1, 3) - SHIFT
        own = np.abs(expected_heights(ob, frame, 1)(pixels[:, :2]) - pixels[:, 2])
        late = np.abs(expected_heights(ob, frame - 1, 1)(pixels[:, :2]) - pixels[:, 2])
        assert np.median(own) < TOLERANCE
        assert np.median(late) > 3 * TOLERANCE


class _PositionsOfRenderedFrames:
    """Hashes of the vertex positions as each frame was rendered."""

    def __init__(self, ob):
        self.hashes = {}
        self._ob = ob

    def __call__(self, scene, *_):
        positions = mesh_arrays.read_positions(self._ob.data)
        self.hashes[scene.frame_current] = hashlib.sha256(positions.tobytes()).hexdigest()


_RENDER_A_FILE = """
import sys
sys.path.insert(0, {repository!r})
import bpy
import ocean_lod_addon
ocean_lod_addon.register()
bpy.ops.wm.open_mainfile(filepath={blend!r})
from tests.render.test_animation_matches_frames import _PositionsOfRenderedFrames
from ocean_lod_addon.scene import ocean_object
watch = _PositionsOfRenderedFrames(next(filter(ocean_object.is_ocean, bpy.data.objects)))
bpy.app.handlers.render_post.append(watch)
bpy.ops.render.render(animation=True)
print("HASHES", watch.hashes, flush=True)
import os
os._exit(0)
"""


@pytest.mark.render
def test_animation_reverse_and_another_process_give_the_same_vertices(tmp_path):
    """render(animation=True), a fresh process that opens the file (what `blender -b file -a` does), and single
    frames rendered backwards: the same bits, because a frame depends on settings and frame number alone."""
    scene, ob = build_scene("CYCLES")
    scene.render.filepath = str(tmp_path / "frame_####")
    blend = tmp_path / "ocean.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend), copy=True)

    watch = _PositionsOfRenderedFrames(ob)
    bpy.app.handlers.render_post.append(watch)
    bpy.ops.render.render(animation=True)
    forwards = dict(watch.hashes)
    watch.hashes.clear()
    for frame in reversed(FRAMES):
        scene.frame_set(frame)
        bpy.ops.render.render()
    bpy.app.handlers.render_post.remove(watch)
    assert len(set(forwards.values())) == len(FRAMES), "every frame differs"
    assert watch.hashes == forwards

    script = _RENDER_A_FILE.format(repository=str(REPOSITORY), blend=str(blend))
    command = [sys.executable, "-c", script]
    finished = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    assert f"HASHES {forwards}" in finished.stdout
