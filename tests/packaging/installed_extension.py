# SPDX-License-Identifier: GPL-3.0-or-later
"""Not a test: what test_extension.py runs in a fresh Blender in which only the installed extension can be found.

    installed_extension.py toggle             enable and disable it twice
    installed_extension.py render SEA EMPTY   render an ocean to SEA, and the same view without it to EMPTY
"""

import os
import sys
import traceback
from math import radians

import bpy

MODULE = "bl_ext.user_default.ocean_lod"


def handler_counts() -> dict[str, int]:
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {name: len(handlers) for name, handlers in lists.items() if isinstance(handlers, list)}


def toggle() -> None:
    before = handler_counts()
    for _ in range(2):
        bpy.ops.preferences.addon_enable(module=MODULE)
        assert MODULE in bpy.context.preferences.addons
        assert hasattr(bpy.types, "MESH_OT_ocean_lod_add")
        bpy.ops.preferences.addon_disable(module=MODULE)
        assert MODULE not in bpy.context.preferences.addons
        assert not hasattr(bpy.types, "MESH_OT_ocean_lod_add")
        assert handler_counts() == before
    assert "ocean_lod_addon" not in sys.modules, "the installed package was loaded under a second name"


def render(sea: str, empty: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)  # this disables every extension, so it comes first
    bpy.ops.preferences.addon_enable(module=MODULE)
    scene = bpy.context.scene
    bpy.ops.mesh.ocean_lod_add()
    ocean = bpy.context.object

    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0.0, 0.0, 5.0)
    camera.rotation_euler = (radians(80.0), 0.0, 0.0)  # a little below the horizon
    scene.collection.objects.link(camera)
    scene.camera = camera
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.rotation_euler = (radians(-60.0), 0.0, 0.0)  # ahead of the camera, for glitter
    scene.collection.objects.link(sun)

    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 64, 36, 100
    scene.frame_set(7)
    for path, hidden in ((sea, False), (empty, True)):
        ocean.hide_render = hidden
        scene.render.filepath = path
        bpy.ops.render.render(write_still=True)


exit_code = 1
try:
    {"toggle": toggle, "render": render}[sys.argv[1]](*sys.argv[2:])
    exit_code = 0
except Exception:  # noqa: BLE001  the traceback is for the test that reads this process's output
    traceback.print_exc()
finally:
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(exit_code)  # bpy 4.5 can hang while the interpreter shuts down
