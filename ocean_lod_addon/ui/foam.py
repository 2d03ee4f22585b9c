# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel about foam."""

import bpy

from ..core.foam_settings import Foam
from ..core.parameters import parameters_of
from ..scene import ocean_object
from .layouts import draw_settings


class OCEAN_LOD_PT_foam(bpy.types.Panel):
    """Whitecaps, and the foam that they leave."""

    bl_label = "Foam"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ocean"
    bl_parent_id = "OCEAN_LOD_PT_ocean"
    bl_options = {"DEFAULT_CLOSED"}
    bl_order = 1  # after the panels about the plane

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        draw_settings(layout, context.object.ocean_lod.effects, ("foam",))
        draw_settings(layout, context.object.ocean_lod.foam, parameters_of(Foam))


CLASSES = (OCEAN_LOD_PT_foam,)
