# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender notices that the handler moves the mesh: exports have every frame of it, and both engines blur it.

The truth is the surface itself: what comes back from a file is compared with the vertices that the ocean has in
the same frame, and a picture with motion blur with the same picture without.
"""

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene import ocean_object
from tests.render.exr import read_pixels

FRAMES = (3, 4, 5)


@pytest.fixture
def shot():
    """A steep sea whose frames are a quarter of a second apart."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    scene = bpy.context.scene
    scene.render.fps = 4
    scene.frame_start, scene.frame_end = FRAMES[0], FRAMES[-1]
    sea = Sea(systems=(WaveSystem(wind_speed=8.0),), wave_count=32)
    ob = ocean_object.create(scene, sea, Grid(cell_size=0.25, cells=32, levels=2), MaterialSettings())
    scene.collection.objects.link(ob)
    ob.ocean_lod.framing.centre = "PINNED"
    bpy.context.view_layer.update()
    yield scene, ob
    ocean_lod_addon.unregister()


def _export_alembic(path):
    bpy.ops.wm.alembic_export(filepath=path, start=FRAMES[0], end=FRAMES[-1], as_background_job=False)


def _export_usd(path):
    bpy.ops.wm.usd_export(filepath=path, export_animation=True)


def _import_alembic(path):
    bpy.ops.wm.alembic_import(filepath=path, as_background_job=False)


def _import_usd(path):
    bpy.ops.wm.usd_import(filepath=path)


@pytest.mark.parametrize(
    ("export", "load", "ending"), [(_export_alembic, _import_alembic, "abc"), (_export_usd, _import_usd, "usdc")]
)
def test_exports_hold_the_surface_of_every_frame(shot, tmp_path, export, load, ending):
    """Float32 in the file and the object's matrix on the way back: 1e-5 m."""
    scene, ob = shot
    expected = {}
    for frame in FRAMES:
        scene.frame_set(frame)
        expected[frame] = mesh_arrays.read_positions(ob.data)
    path = str(tmp_path / f"ocean.{ending}")
    export(path)
    before = set(bpy.data.objects)
    load(path)
    (loaded,) = (new for new in set(bpy.data.objects) - before if new.type == "MESH")
    for frame in FRAMES:
        scene.frame_set(frame)
        evaluated = loaded.evaluated_get(bpy.context.evaluated_depsgraph_get())
        found = mesh_arrays.read_positions(evaluated.data)
        matrix = np.array(evaluated.matrix_world)
        found = found @ matrix[:3, :3].T + matrix[:3, 3]
        assert np.abs(found - expected[frame]).max() < 1e-5
    assert np.abs(expected[3] - expected[5]).max() > 0.1, "frames differ"


def _emit_height(ob):
    """A material that is bright on crests and dark in troughs."""
    material = bpy.data.materials.new("Height")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    normal, emission = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeEmission")
    split, output = tree.nodes.new("ShaderNodeSeparateXYZ"), tree.nodes.new("ShaderNodeOutputMaterial")
    above = tree.nodes.new("ShaderNodeMath")
    above.operation = "GREATER_THAN"
    above.inputs[1].default_value = 0.0
    tree.links.new(normal.outputs["Position"], split.inputs[0])
    tree.links.new(split.outputs["Z"], above.inputs[0])
    tree.links.new(above.outputs[0], emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    ob.data.materials.clear()
    ob.data.materials.append(material)


def _shoreline_pixels(scene, path):
    """Share of pixels that are neither crest (1) nor trough (0) in the middle frame, rendered as an animation."""
    scene.frame_start = scene.frame_end = FRAMES[1]
    scene.render.filepath = str(path / "frame_####")
    bpy.ops.render.render(animation=True)
    pixels = read_pixels(path / f"frame_{FRAMES[1]:04d}.exr")[..., 0]
    return float(np.mean((pixels > 0.1) & (pixels < 0.9)))


@pytest.mark.render
@pytest.mark.parametrize("engine", ["CYCLES", "EEVEE"])
def test_both_engines_blur_the_moving_water(shot, tmp_path, engine):
    """The line between crests and troughs is a pixel wide when the shutter is short, and a band that the crests
    sweep, when it is open for a whole frame: these waves travel a metre in that quarter of a second."""
    scene, ob = shot
    _emit_height(ob)
    ob.ocean_lod.effects.velocity = "off"  # the instants of the shutter, not the attribute
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 12.0
    camera.location.z = 50.0
    scene.collection.objects.link(camera)
    scene.camera = camera
    if engine == "EEVEE":
        offered = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
        engine = next(name for name in offered if name.startswith("BLENDER_EEVEE"))
    render = scene.render
    render.engine = engine
    render.resolution_x = render.resolution_y = 48
    scene.cycles.samples = scene.eevee.taa_render_samples = 16
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.eevee.motion_blur_steps = 2  # 1 step smears along the paths of the water, not of the waves
    scene.view_settings.view_transform = "Raw"
    image = render.image_settings
    if hasattr(image, "media_type"):
        image.media_type = "IMAGE"
    image.file_format = "OPEN_EXR"
    render.motion_blur_shutter = 1.0
    shares = []
    for blur in (False, True):
        render.use_motion_blur = blur
        shares.append(_shoreline_pixels(scene, tmp_path))
    assert shares[1] > 2.0 * shares[0] + 0.02
