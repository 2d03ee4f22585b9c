# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators on sea presets: load, save, remove, and files anywhere."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..core import presets
from ..core.errors import OceanError
from ..scene import ocean_object, properties
from . import preset_library
from .operators import OceanOperator

_FILE_FILTER = "*.json"


def _apply(preset, context):
    ob = context.object
    properties.write_preset(preset, ob.ocean_lod)
    ocean_object.refresh(ob, context.scene)
    ocean_object.refresh_material(ob, context.scene)


class _PresetOperator(OceanOperator):
    """An operator on the active ocean whose work may fail in a way that the artist can mend."""

    def execute(self, context):
        try:
            self.work(context)
        except OceanError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class OBJECT_OT_ocean_lod_load_preset(_PresetOperator, bpy.types.Operator):
    """Replace the sea state, water and foam of this ocean by a preset's"""

    bl_idname = "object.ocean_lod_load_preset"
    bl_label = "Load Sea Preset"
    __annotations__ = {
        "preset": bpy.props.EnumProperty(
            name="Sea",
            description="Sea state to load",
            items=preset_library.items,
            default=preset_library.first_choice(),
        )
    }

    def work(self, context):
        _apply(preset_library.load(self.preset), context)


class OBJECT_OT_ocean_lod_save_preset(_PresetOperator, bpy.types.Operator):
    """Save the sea state, water and foam of this ocean as a preset of yours"""

    bl_idname = "object.ocean_lod_save_preset"
    bl_label = "Save Sea Preset"
    bl_options = {"REGISTER"}
    __annotations__ = {
        "name": bpy.props.StringProperty(name="Name", description="What the preset is called", default="My Sea"),
        "description": bpy.props.StringProperty(
            name="Description", description="What the sea looks like, for the tooltip"
        ),
        "overwrite": bpy.props.BoolProperty(
            name="Overwrite",
            description="Replace your preset of this name",
            options={"SKIP_SAVE"},
        ),
    }

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self, width=400, confirm_text="Save")

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "name")
        layout.prop(self, "description")
        if self.name in preset_library.user_names():
            row = layout.row()
            row.alert = True
            row.prop(self, "overwrite", text=f"Overwrite {self.name}")

    def work(self, context):
        if self.name in preset_library.user_names() and not self.overwrite:
            raise OceanError(f"preset {self.name!r} exists: choose Overwrite, or another name")
        preset = properties.read_preset(context.object.ocean_lod, self.name, self.description)
        path = preset_library.save(self.name, preset)
        self.report({"INFO"}, f"Saved {path}")


class OBJECT_OT_ocean_lod_remove_preset(_PresetOperator, bpy.types.Operator):
    """Delete the file of one of your own presets"""

    bl_idname = "object.ocean_lod_remove_preset"
    bl_label = "Remove Sea Preset"
    bl_options = {"REGISTER"}
    __annotations__ = {
        "preset": bpy.props.EnumProperty(
            name="Sea", description="Preset to remove", items=preset_library.user_items
        )
    }

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(preset_library.user_names())

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(
            self, event, title="Remove Sea Preset", message=f"Delete {self.preset!r}?", confirm_text="Delete"
        )

    def work(self, _context):
        preset_library.remove(self.preset)


class OBJECT_OT_ocean_lod_import_preset(_PresetOperator, ImportHelper, bpy.types.Operator):
    """Replace the sea state, water and foam of this ocean by those of a preset file"""

    bl_idname = "object.ocean_lod_import_preset"
    bl_label = "Import Sea Preset"
    filename_ext = ".json"
    __annotations__ = {"filter_glob": bpy.props.StringProperty(default=_FILE_FILTER, options={"HIDDEN"})}

    def work(self, context):
        _apply(presets.read(Path(self.filepath)), context)


class OBJECT_OT_ocean_lod_export_preset(_PresetOperator, ExportHelper, bpy.types.Operator):
    """Write the sea state, water and foam of this ocean to a preset file"""

    bl_idname = "object.ocean_lod_export_preset"
    bl_label = "Export Sea Preset"
    bl_options = {"REGISTER"}
    filename_ext = ".json"
    __annotations__ = {"filter_glob": bpy.props.StringProperty(default=_FILE_FILTER, options={"HIDDEN"})}

    def work(self, context):
        path = Path(self.filepath)
        title = path.stem.replace("_", " ")
        presets.write(properties.read_preset(context.object.ocean_lod, title, ""), path)
        self.report({"INFO"}, f"Saved {path}")


CLASSES = (
    OBJECT_OT_ocean_lod_load_preset,
    OBJECT_OT_ocean_lod_save_preset,
    OBJECT_OT_ocean_lod_remove_preset,
    OBJECT_OT_ocean_lod_import_preset,
    OBJECT_OT_ocean_lod_export_preset,
)
