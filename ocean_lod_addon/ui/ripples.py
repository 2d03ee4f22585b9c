# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel about ripples."""

import bpy

from ..scene import ocean_object, properties
from .layouts import draw_settings


class OCEAN_LOD_PT_ripples(bpy.types.Panel):
    """The waves between the mesh and roughness."""

    bl_label = "Ripples"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ocean"
    bl_parent_id = "OCEAN_LOD_PT_ocean"
    bl_order = 1  # after the panels about the plane

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        ripples = context.object.ocean_lod.ripples
        if bpy.app.version < properties.RIPPLES_SINCE:
            layout.label(text="Ripples need Blender 5: here they are roughness", icon="INFO")
            return
        draw_settings(layout, ripples, ("kind",))
        if ripples.kind == "off":
            return
        draw_settings(layout, ripples, ("resolution",))
        if ripples.kind == "spectral":
            draw_settings(layout, ripples, ("shortest_wavelength", "longest_wavelength"))


CLASSES = (OCEAN_LOD_PT_ripples,)
