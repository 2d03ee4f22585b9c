# SPDX-License-Identifier: GPL-3.0-or-later
"""An ocean in an empty file, as the Add menu makes it."""

import bpy

import ocean_lod_addon


def fresh_ocean(cells: int, levels: int, cell_size: float):
    """The ocean and its scene, with the extension registered: the caller unregisters it."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    bpy.ops.mesh.ocean_lod_add(preset="moderate", cells=cells, levels=levels, cell_size=cell_size)
    return bpy.context.object, bpy.context.scene
