# SPDX-License-Identifier: GPL-3.0-or-later
"""The entry in Add > Mesh."""

import bpy

from .operators import MESH_OT_ocean_lod_add


def _add_mesh_entry(menu, _context):
    menu.layout.operator(MESH_OT_ocean_lod_add.bl_idname, icon="MOD_OCEAN")


def register():
    """Append the entry."""
    bpy.types.VIEW3D_MT_mesh_add.append(_add_mesh_entry)


def unregister():
    """Remove the entry."""
    bpy.types.VIEW3D_MT_mesh_add.remove(_add_mesh_entry)
