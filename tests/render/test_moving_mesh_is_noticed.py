# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender notices that the handler moves the mesh: exports have every frame of it.

The truth is the surface itself: what comes back from a file is compared with the vertices that the ocean has in
the same frame. That both engines blur it is shown beside this, by the width of the blur.
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
