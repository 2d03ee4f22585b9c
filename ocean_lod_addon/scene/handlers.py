# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender calls: at each frame for every visible ocean, around renders, and after edits of the scene."""

import bpy
from bpy.app.handlers import persistent

from . import ocean_material, ocean_object, placing


@persistent
def update_oceans(scene, depsgraph=None):
    """Move all oceans of the scene to its current frame; called by Blender after each frame change."""
    if depsgraph is None:
        depsgraph = bpy.context.evaluated_depsgraph_get()
    for ob in ocean_object.visible_oceans(scene, depsgraph):
        ocean_object.update_reporting(ob, scene, depsgraph)


@persistent
def follow_edit(scene, depsgraph):
    """Called by Blender after an edit: where objects, materials or lights have changed, the sun may have."""
    lamp_moved = any(getattr(update.id, "type", None) == "LIGHT" for update in depsgraph.updates)
    if lamp_moved or any(map(depsgraph.id_type_updated, ("COLLECTION", "LIGHT", "WORLD"))):
        ocean_material.settle_sun(scene, [ob for ob in scene.objects if ocean_object.is_ocean(ob)])


@persistent
def begin_render(scene, *_):
    """Called by Blender before a render: without a window, attributes can come and go here.

    With one this runs in a worker thread, where they can not; settings that were changed there have been followed.
    """
    if bpy.app.background:
        for ob in scene.objects:
            ocean_object.prepare_render(ob, scene)


@persistent
def begin_frame(scene, *_):
    """Called by Blender before a frame is rendered: its sub-frames belong to it."""
    placing.begin_rendered_frame(scene)


@persistent
def end_frame(scene, *_):
    """Called by Blender after a frame was rendered, and when rendering ends in any way."""
    placing.end_rendered_frame(scene)


def _subscriptions():
    handlers = bpy.app.handlers
    return (
        (handlers.frame_change_post, update_oceans),
        (handlers.depsgraph_update_post, follow_edit),
        (handlers.render_init, begin_render),
        (handlers.render_pre, begin_frame),
        (handlers.render_post, end_frame),
        (handlers.render_complete, end_frame),
        (handlers.render_cancel, end_frame),
    )


def register():
    """Start listening."""
    for event, handler in _subscriptions():
        event.append(handler)


def unregister():
    """Stop listening."""
    for event, handler in reversed(_subscriptions()):
        event.remove(handler)
