# SPDX-License-Identifier: GPL-3.0-or-later
"""Data that is only needed for a while."""

import contextlib

import bpy


@contextlib.contextmanager
def fresh_data():
    """What is made in Blender within this context is removed after it."""
    kinds = (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.node_groups, bpy.data.images)
    scenes = set(bpy.data.scenes)
    before = [set(kind) for kind in kinds]
    try:
        yield
    finally:
        for scene in set(bpy.data.scenes) - scenes:
            bpy.data.scenes.remove(scene)
        for kind, kept in zip(kinds, before, strict=True):
            bpy.data.batch_remove(set(kind) - kept)
