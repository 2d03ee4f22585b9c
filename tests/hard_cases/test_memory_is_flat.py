# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames leave nothing behind: memory stays flat however long the shot.

A frame that left one array of positions behind would cost 0.23 MiB each time, so that the growth allowed is some
frames' worth. `make fuzz` asks for 2000 frames.
"""

import os
import resource
import sys

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.scene import mesh, ocean_object

FRAMES = int(os.environ.get("OCEAN_LOD_FRAMES", "200"))

GRID = {"cells": 64, "levels": 6, "cell_size": 0.25}

ALLOWED_GROWTH = 16 * 2**20
"""Bytes by which the peaks of the second and the last quarter may differ: what allocators keep for themselves."""


def memory() -> int:
    """Bytes of memory in use, or where the system does not say, the most that were."""
    try:
        with open("/proc/self/statm") as statm:
            return int(statm.read().split()[1]) * resource.getpagesize()
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


@pytest.fixture
def ocean():
    """An ocean on which everything is switched on that a frame writes, before a camera that flies over it."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    bpy.ops.mesh.ocean_lod_add(preset="moderate", **GRID)
    ob, scene = bpy.context.object, bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.rotation_euler.x = 1.4
    scene.collection.objects.link(camera)
    scene.camera = camera
    for frame, place in ((1, (0.0, 0.0, 2.0)), (FRAMES, (40.0 * FRAMES, 0.0, 30.0))):
        camera.location = place
        camera.keyframe_insert("location", frame=frame)
    scene.render.use_motion_blur = True
    ob.ocean_lod.effects.velocity = ob.ocean_lod.effects.analytic_normals = "on"
    ob.ocean_lod.ripples.resolution = "256"
    yield ob
    ocean_lod_addon.unregister()


def growth(frames):
    """Bytes by which the peak of the last quarter of the frames exceeds that of the second quarter."""
    used = []
    for frame in range(1, frames + 1):
        bpy.context.scene.frame_set(frame)
        used.append(memory())
    quarter = frames // 4
    return max(used[-quarter:]) - max(used[quarter : 2 * quarter])


@pytest.mark.parametrize("keyed", [False, True])
def test_memory_is_flat(ocean, keyed):
    """Truth: a frame is a function of settings and time. With keyed wind every frame is another sea.

    The wind goes up and down, as the memory of a sea depends on it: long waves reach further.
    """
    if keyed:
        system = ocean.ocean_lod.sea.systems[0]
        for number, frame in enumerate(range(1, FRAMES + 1, 10)):
            system.wind_speed = (6.0, 9.0)[number % 2] + 0.1 * frame / FRAMES
            system.keyframe_insert("wind_speed", frame=frame)
    first = mesh.read_positions(ocean.data)
    frames = FRAMES // 4 if keyed else FRAMES  # each of these is built anew, and leaves far more behind if any
    grown = growth(frames)
    assert ocean_object.problem(ocean) == ""
    assert not np.array_equal(mesh.read_positions(ocean.data), first)
    assert grown <= ALLOWED_GROWTH, f"{grown / 2**20:.1f} MiB more after {frames} frames"
    print(f"{grown / 2**20:.1f} MiB more after {frames} frames")
