# SPDX-License-Identifier: GPL-3.0-or-later
"""The entry in Add > Mesh, and the menu of what can be done with presets."""

import bpy

from .operators import MESH_OT_ocean_lod_add
from .preset_operators import (
    OBJECT_OT_ocean_lod_export_preset,
    OBJECT_OT_ocean_lod_import_preset,
    OBJECT_OT_ocean_lod_remove_preset,
)


class OCEAN_LOD_MT_preset_files(bpy.types.Menu):
    """What can be done with preset files."""

    bl_label = "Preset Files"

    def draw(self, context):
        layout = self.layout
        layout.operator(OBJECT_OT_ocean_lod_import_preset.bl_idname, text="Import...", icon="IMPORT")
        layout.operator(OBJECT_OT_ocean_lod_export_preset.bl_idname, text="Export...", icon="EXPORT")
        layout.separator()
        if OBJECT_OT_ocean_lod_remove_preset.poll(context):
            layout.operator_menu_enum(
                OBJECT_OT_ocean_lod_remove_preset.bl_idname, "preset", text="Remove", icon="TRASH"
            )


CLASSES = (OCEAN_LOD_MT_preset_files,)


def _add_mesh_entry(menu, _context):
    menu.layout.operator(MESH_OT_ocean_lod_add.bl_idname, icon="MOD_OCEAN")


def register():
    """Append the entry."""
    bpy.types.VIEW3D_MT_mesh_add.append(_add_mesh_entry)


def unregister():
    """Remove the entry."""
    bpy.types.VIEW3D_MT_mesh_add.remove(_add_mesh_entry)
