# SPDX-License-Identifier: GPL-3.0-or-later
"""Data that is only needed for a while."""

import contextlib

import bpy


@contextlib.contextmanager
def fresh_data():
    """What is made in Blender within this context is removed after it."""
    data = bpy.data
    kinds = (data.objects, data.meshes, data.cameras, data.materials, data.worlds, data.node_groups, data.images)
    scenes = set(data.scenes)
    before = [set(kind) for kind in kinds]
    try:
        yield
    finally:
        for scene in set(bpy.data.scenes) - scenes:
            bpy.data.scenes.remove(scene)
        for kind, kept in zip(kinds, before, strict=True):
            bpy.data.batch_remove(set(kind) - kept)
