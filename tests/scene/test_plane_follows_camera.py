# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane travels with the scene's camera over a sea that stays put, and never within a shutter interval."""

import math

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.lod import Grid, level_anchors
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene import ocean_object, placing

CELL = 0.25


@pytest.fixture
def shot():
    """An ocean and a camera that flies along x at 3 m per frame."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    bpy.ops.mesh.ocean_lod_add(preset="moderate", cells=64, levels=5, cell_size=CELL)
    ocean = bpy.context.object
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.rotation_euler = (math.radians(80), 0.0, math.radians(-90))
    camera.location = (0.0, 0.0, 5.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    for frame, x in ((1, 0.0), (101, 300.0)):
        camera.location.x = x
        camera.keyframe_insert("location", frame=frame)
    for curve in _curves(camera):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.render.resolution_x = scene.render.resolution_y = 16
    yield ocean, camera, scene
    ocean_lod_addon.unregister()


def _curves(ob):
    action = ob.animation_data.action
    return action.layers[0].strips[0].channelbags[0].fcurves


def centre_of(ob):
    """Middle of the plane's outer square, whose vertices hardly move."""
    positions = mesh_arrays.read_positions(ob.data)
    return 0.5 * (positions.min(axis=0) + positions.max(axis=0))[:2]


def test_the_plane_is_under_the_camera(shot):
    """Within a cell of the outermost level, and moved ahead: the nearest water in frame is 6.6 m away, the finest
    level reaches 4 m from its centre before its cells double."""
    ocean, camera, scene = shot
    for frame in (1, 50, 101):
        scene.frame_set(frame)
        outermost, ahead = CELL * 2**4, 2.6
        assert np.abs(centre_of(ocean) - np.array(camera.location[:2])).max() <= outermost + ahead


def test_a_pinned_plane_stays(shot):
    ocean, _, scene = shot
    ocean.ocean_lod.framing.centre = "PINNED"
    scene.frame_set(101)
    assert np.abs(centre_of(ocean)).max() < CELL * 2**4


def test_the_sea_stays_put_under_the_moving_plane(shot):
    """At one sea time, vertices that stand on the same lattice point before and after a move of 6 m have the same
    height, but for the shortest waves, whose windows (reaching 4 m here) travel with the camera. If the waves
    travelled with the plane, heights would differ by more than their own spread."""
    ocean, _, scene = shot
    ocean.ocean_lod.time.speed = 0.0
    heights = []
    for frame in (20, 22):  # 6 m apart: inner levels overlap
        scene.frame_set(frame)
        surface = ocean_object._surface(ocean_object.read_ocean(ocean, scene))
        anchors = surface.placement(placing.camera_view(ocean, scene)).anchors
        rest = np.round((surface.undisturbed(anchors)[:, :2]) / CELL).astype(int)
        inner = np.abs(rest * CELL - anchors[0]).max(axis=1) < 7.0
        positions = mesh_arrays.read_positions(ocean.data)
        heights.append({tuple(key): z for key, z in zip(rest[inner], positions[inner, 2], strict=True)})
    shared = heights[0].keys() & heights[1].keys()
    assert len(shared) > 300
    change = np.array([heights[0][key] - heights[1][key] for key in shared])
    spread = np.std(list(heights[0].values()))
    assert np.abs(change).max() < 0.25 * spread


def test_sub_frames_of_a_rendered_frame_share_its_lattice(shot):
    """The camera moves 3 m per frame, twelve cells: with motion blur every evaluated instant of a frame must still
    have that frame's anchors, or vertices would jump within the shutter."""
    ocean, _, scene = shot
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter = 1.0
    seen = []

    def watch(scene, _depsgraph):
        positions = mesh_arrays.read_positions(ocean.data)
        outer = positions[np.abs(positions - positions.mean(axis=0)).max(axis=1).argsort()[-200:]]
        seen.append((scene.frame_current + scene.frame_subframe, outer.mean(axis=0)[0]))

    bpy.app.handlers.frame_change_post.append(watch)
    scene.frame_start = scene.frame_end = 31
    bpy.ops.render.render(animation=True)
    bpy.app.handlers.frame_change_post.remove(watch)
    rendering = [middle for frame, middle in seen if abs(frame - 31) <= 0.5]
    assert len({frame for frame, _ in seen}) >= 3, "motion blur evaluates sub-frames"
    assert max(rendering) - min(rendering) < 1.0, "only waves moved, not the 3 m of the camera"


def test_a_render_moves_only_what_the_camera_sees(shot):
    ocean, _, scene = shot
    flat = []

    def watch(*_):
        flat.append(np.mean(mesh_arrays.read_positions(ocean.data)[:, 2] == 0.0))

    bpy.app.handlers.render_post.append(watch)
    bpy.ops.render.render()
    bpy.app.handlers.render_post.remove(watch)
    assert 0.3 < flat[0] < 0.9
    scene.frame_set(2)
    assert np.mean(mesh_arrays.read_positions(ocean.data)[:, 2] == 0.0) < 0.01, "the viewport shows all of it"


def test_an_ocean_out_of_frame_is_not_evaluated(shot):
    ocean, camera, scene = shot
    scene.frame_set(5)
    camera.rotation_euler = (math.radians(170), 0.0, math.radians(-90))  # to the sky
    before = mesh_arrays.read_positions(ocean.data)
    unchanged = []

    def watch(*_):
        unchanged.append(np.array_equal(mesh_arrays.read_positions(ocean.data), before))

    bpy.app.handlers.render_post.append(watch)
    bpy.ops.render.render()
    bpy.app.handlers.render_post.remove(watch)
    assert unchanged == [True]


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO", "PANO"])
def test_every_kind_of_camera_and_none(shot, kind, capfd):
    ocean, camera, scene = shot
    camera.data.type = kind
    scene.frame_set(7)
    assert ocean_object.problem(ocean) == ""
    scene.camera = None
    scene.frame_set(8)
    assert ocean_object.problem(ocean) == ""
    assert np.abs(centre_of(ocean)).max() < CELL * 2**4


def test_moved_and_turned_oceans_follow_in_their_own_axes(shot):
    """An ocean moved and turned about z keeps its plane under the camera; the anchors are in its own axes."""
    ocean, camera, scene = shot
    ocean.location = (50.0, -20.0, 1.0)
    ocean.rotation_euler.z = 0.7
    scene.frame_set(60)
    local = ocean.matrix_world.inverted() @ camera.matrix_world.translation
    assert np.abs(centre_of(ocean) - np.array(local[:2])).max() <= CELL * 2**4 + 2.6


@pytest.mark.parametrize(
    ("change", "line"),
    [(("scale", (2.0, 2.0, 2.0)), "scale is 2, 2, 2, allowed is 1"), (("rotation_euler", (0.3, 0, 0)), "tilted")],
)
def test_scaled_and_tilted_oceans_are_refused_clearly(shot, change, line):
    ocean, _, scene = shot
    setattr(ocean, *change)
    scene.frame_set(9)
    assert line in ocean_object.problem(ocean)


def test_scene_units_other_than_metres(shot):
    """A scene in centimetres: the ocean's object is scaled so that its waves keep their size."""
    scene = shot[2]
    scene.unit_settings.scale_length = 0.01
    bpy.ops.mesh.ocean_lod_add(preset="calm", cells=16, levels=2)
    ob = bpy.context.object
    assert ob.scale[:] == pytest.approx((100.0, 100.0, 100.0))
    scene.frame_set(3)
    assert ocean_object.problem(ob) == ""


def test_anchors_at_lattice_ties_are_deterministic():
    """Exactly between two lattice points numpy rounds to even: the same on every machine."""
    grid = Grid(cell_size=0.5, cells=16, levels=3)
    assert level_anchors(grid, (0.25, 0.75)).tolist() == level_anchors(grid, (0.25, 0.75)).tolist()
    assert level_anchors(grid, (0.25, 0.75))[0].tolist() == [0.0, 1.0]


def test_fit_to_shot_sizes_the_plane_and_can_be_undone(shot):
    """8 pixels at the nearest water: the camera is 5 m up and sees down to 37 degrees below the horizon."""
    ocean, _, scene = shot
    scene.frame_end = 11
    scene.render.resolution_x = scene.render.resolution_y = 256
    scene.frame_set(4)
    bpy.context.view_layer.objects.active = ocean
    assert bpy.ops.object.ocean_lod_fit_to_shot(pixels_per_cell=8.0) == {"FINISHED"}
    nearest = 5.0 / math.sin(math.radians(10.0) + math.atan(18 / 50))
    grid = ocean.ocean_lod.grid
    assert grid.cell_size == pytest.approx(8 * nearest * 36 / 50 / 256, rel=1e-4)
    assert len(ocean.data.vertices) == ocean_object.read_ocean(ocean, scene).grid.vertex_count
    assert scene.frame_current == 4
    scene.camera = None
    with pytest.raises(RuntimeError, match="has no camera to size the ocean for"):
        bpy.ops.object.ocean_lod_fit_to_shot()


def test_viewport_and_render_keep_to_their_own_quality(shot):
    """A render with all waves leaves the viewport at its share, bit for bit as before, and the other way round."""
    ocean, _, scene = shot
    ocean.ocean_lod.framing.only_in_view = False
    scene.frame_set(12)
    whole = mesh_arrays.read_positions(ocean.data)
    ocean.ocean_lod.framing.viewport_share = 0.1
    scene.frame_set(12)
    viewport = mesh_arrays.read_positions(ocean.data)
    rendered = []

    def watch(*_):
        rendered.append(mesh_arrays.read_positions(ocean.data))

    bpy.app.handlers.render_post.append(watch)
    bpy.ops.render.render()
    bpy.app.handlers.render_post.remove(watch)
    assert not np.array_equal(viewport, whole)
    assert np.array_equal(rendered[0], whole)
    scene.frame_set(12)
    assert np.array_equal(mesh_arrays.read_positions(ocean.data), viewport)
