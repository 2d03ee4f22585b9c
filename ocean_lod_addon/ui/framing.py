# SPDX-License-Identifier: GPL-3.0-or-later
"""How the plane follows the camera and is sized for the shot."""

import bpy

from ..core.errors import OceanError
from ..core.framing import Framing
from ..core.parameters import parameters_of
from ..scene import ocean_object, shot_sizing


class OBJECT_OT_ocean_lod_fit_to_shot(bpy.types.Operator):
    """Size the cells, their number, the reach of the ocean and the lengths of its ripples for the camera's path
    through the whole animation"""

    bl_idname = "object.ocean_lod_fit_to_shot"
    bl_label = "Fit Plane to Shot"
    bl_options = {"REGISTER", "UNDO"}
    __annotations__ = {
        "pixels_per_cell": bpy.props.FloatProperty(
            name="Pixels per Cell",
            description="Size of the cells in pixels at the nearest water in frame; less is finer and slower",
            default=8.0,
            min=1.0,
            max=100.0,
        )
    }

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)

    def execute(self, context):
        try:
            shot_sizing.fit_to_shot(context.object, context, self.pixels_per_cell)
        except OceanError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class OCEAN_LOD_PT_framing(bpy.types.Panel):
    """The plane and the camera."""

    bl_label = "Framing"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ocean"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        framing = context.object.ocean_lod.framing
        for name in parameters_of(Framing):
            layout.prop(framing, name)
        layout.operator(OBJECT_OT_ocean_lod_fit_to_shot.bl_idname, icon="CAMERA_DATA")


CLASSES = (OBJECT_OT_ocean_lod_fit_to_shot, OCEAN_LOD_PT_framing)
