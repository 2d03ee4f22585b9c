# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel about ripples."""

import bpy

from ..scene import ocean_object
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
        draw_settings(layout, ripples, ("kind",))
        if ripples.kind != "off":
            draw_settings(layout, ripples, ("resolution",))
        if ripples.kind == "spectral":
            draw_settings(layout, ripples, ("shortest_wavelength", "longest_wavelength"))
        draw_settings(layout, ripples, ("gusts",))
        if ripples.gusts:
            draw_settings(layout, ripples, ("gust_strength", "gust_size"))


CLASSES = (OCEAN_LOD_PT_ripples,)
