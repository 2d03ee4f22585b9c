# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame-change handler: every visible ocean, at the frame and sub-frame being evaluated."""

import bpy
from bpy.app.handlers import persistent

from . import ocean_object


@persistent
def update_oceans(scene, depsgraph=None):
    """Move all oceans of the scene to its current frame; called by Blender after each frame change."""
    if depsgraph is None:
        depsgraph = bpy.context.evaluated_depsgraph_get()
    for ob in ocean_object.visible_oceans(scene, depsgraph):
        ocean_object.update_reporting(ob, scene, depsgraph)


def register():
    """Start listening to frame changes."""
    bpy.app.handlers.frame_change_post.append(update_oceans)


def unregister():
    """Stop listening to frame changes."""
    bpy.app.handlers.frame_change_post.remove(update_oceans)
