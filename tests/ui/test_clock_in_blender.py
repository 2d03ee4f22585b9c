# SPDX-License-Identifier: GPL-3.0-or-later
"""The sea's clock in a scene: loops that close bit for bit, retiming by keys, frame rates, time remapping."""

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.ocean import Surface
from ocean_lod_addon.scene import mesh, ocean_object

SCENE_RATES = [(24, 1.0), (30, 1.001), (25, 1.0), (60, 1.001), (1, 1.0)]
"""Frames per second and the base that divides them, as Blender has them."""


def positions_at(ob, frame, subframe=0.0):
    bpy.context.scene.frame_set(frame, subframe=subframe)
    return mesh.read_positions(ob.data)


def assert_surface_is_of_time(ob, time):
    """The vertices equal the kernel at `time`, to the rounding of float32 phases' arguments (0.1 mm)."""
    surface = Surface(ocean_object.read_ocean(ob, bpy.context.scene))
    expected = np.empty((surface.vertex_count, 3), np.float32)
    surface.positions(time, surface.placement(), expected)
    assert np.abs(mesh.read_positions(ob.data) - expected).max() < 1e-4
    surface.positions(time + 0.5, surface.placement(), expected)
    assert np.abs(mesh.read_positions(ob.data) - expected).max() > 1e-2, "half a second would show"


@pytest.mark.parametrize(("fps", "fps_base"), SCENE_RATES)
@pytest.mark.parametrize(("frames", "speed"), [(250, 1.0), (96, 0.3), (33, -2.0)])
def test_frame_1_and_frame_n_plus_1_are_equal_bit_for_bit(ocean, fps, fps_base, frames, speed):
    """Truth: equal bytes in Blender's vertex buffer N frames apart, at whole frames and between them."""
    render = bpy.context.scene.render
    render.fps, render.fps_base = fps, fps_base
    clock = ocean.ocean_lod.time
    clock.loop_frames, clock.speed, clock.offset = frames, speed, 123.4
    for frame, subframe in ((1, 0.0), (1, 0.25), (1, 0.1), (17, 0.9), (-5, 0.75)):
        first = positions_at(ocean, frame, subframe)
        assert not np.array_equal(positions_at(ocean, frame + frames // 2, subframe), first)
        for laps in (1, 2, 32):
            again = positions_at(ocean, frame + laps * frames, subframe)
            assert again.tobytes() == first.tobytes(), (frame, subframe, laps)


def test_a_loop_closes_with_time_remapping(ocean):
    """Truth: N counts the frames that are rendered, whatever Blender's time remapping makes of them."""
    render = bpy.context.scene.render
    render.frame_map_old, render.frame_map_new = 100, 300
    ocean.ocean_lod.time.loop_frames = 120
    first = positions_at(ocean, 1, 0.5)
    assert positions_at(ocean, 121, 0.5).tobytes() == first.tobytes()
    assert not np.array_equal(positions_at(ocean, 41, 0.5), first)
    assert ocean_object.read_ocean(ocean, bpy.context.scene).sea.loop_period == pytest.approx(120 / 24 / 3)


def test_a_keyed_clock_loops_over_its_own_seconds(ocean):
    """Truth: keys one loop period apart (240 frames of 1/24 s at half speed: 10 s keyed) give equal bytes."""
    clock = ocean.ocean_lod.time
    clock.source, clock.loop_frames, clock.speed = "KEYED", 240, 0.5
    for frame, time in ((1, 3.0), (11, 13.0), (21, 23.0)):
        clock.time = time
        clock.keyframe_insert("time", frame=frame)
    first = positions_at(ocean, 1)
    assert positions_at(ocean, 11).tobytes() == first.tobytes()
    assert positions_at(ocean, 21).tobytes() == first.tobytes()


def test_a_loop_moves_on_smoothly_across_its_seam(ocean):
    """Truth: no jump where the loop closes: the step from N to N + 1 is as long as the step from 1 to 2."""
    ocean.ocean_lod.time.loop_frames = 48

    def step(frame):
        return np.abs(positions_at(ocean, frame + 1) - positions_at(ocean, frame)).max()

    assert step(48) == pytest.approx(step(1), rel=0.5)
    assert step(47) == pytest.approx(step(1), rel=0.5)


def test_a_shot_is_retimed_by_keys(ocean):
    """Truth: keyed times are followed, with speed and offset; a sub-frame lies between its keys (linear)."""
    scene, clock = bpy.context.scene, ocean.ocean_lod.time
    clock.source = "KEYED"
    for frame, time in ((1, 0.0), (11, 50.0), (21, 40.0)):
        clock.time = time
        clock.keyframe_insert("time", frame=frame)
    for curve in curves_of(ocean):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    for frame, subframe, time in ((11, 0.0, 50.0), (6, 0.5, 27.5), (16, 0.0, 45.0), (99, 0.0, 40.0)):
        scene.frame_set(frame, subframe=subframe)
        assert_surface_is_of_time(ocean, time)
    clock.speed, clock.offset = 0.5, 7.0
    scene.frame_set(16)
    assert_surface_is_of_time(ocean, 45.0 * 0.5 + 7.0)


def curves_of(ob):
    action = ob.animation_data.action
    if hasattr(action, "fcurves"):  # Blender 4.5
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
            for curve in bag.fcurves]  # fmt: skip


def test_another_frame_rate_leaves_the_sea_in_real_time(ocean):
    """Truth: the same second of the shot shows the same sea at any frame rate."""
    scene = bpy.context.scene
    for fps, fps_base, frame in ((24, 1.0, 48), (50, 1.0, 100), (30, 1.001, 60)):
        scene.render.fps, scene.render.fps_base = fps, fps_base
        scene.frame_set(frame)
        assert_surface_is_of_time(ocean, frame * fps_base / fps)


def test_time_remapping_slows_the_sea(ocean):
    scene = bpy.context.scene
    scene.render.frame_map_old, scene.render.frame_map_new = 100, 200
    scene.frame_set(480)
    assert_surface_is_of_time(ocean, 10.0)


def test_the_loop_changes_the_waves_a_little_and_the_clock_not_at_all(ocean):
    """Truth: with a loop the surface is still the direct sum of its waves, at the frame's time."""
    ocean.ocean_lod.time.loop_frames = 240
    scene = bpy.context.scene
    scene.frame_set(100)
    ocean_settings = ocean_object.read_ocean(ocean, scene)
    surface = Surface(ocean_settings)
    centre = ocean_settings.grid.cells // 2
    line = ocean_settings.grid.lines(0)[centre]
    expected = surface_points(surface.waves, line, line, 100 / 24).position
    distance = np.linalg.norm(mesh.read_positions(ocean.data) - np.asarray(expected), axis=1)
    assert distance.min() < 1e-4
