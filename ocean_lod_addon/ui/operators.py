# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators: thin, undoable wrappers around `scene`."""

import bpy

from ..core import presets
from ..core.errors import OceanError
from ..core.lod import Grid
from ..core.parameters import parameters_of
from ..scene import ocean_object, properties, rna

_preset_items_kept: list[tuple[str, str, str]] = []
"""Blender does not keep the texts of a dynamic enum alive: Python must."""


def _preset_items(_operator, _context):
    _preset_items_kept[:] = [
        (name, name.replace("_", " ").capitalize(), presets.load(name).description) for name in presets.names()
    ]
    return _preset_items_kept


def _unchanged(_operator, _context):
    """Operator properties refresh nothing: the operator runs again from its redo panel."""


class MESH_OT_ocean_lod_add(bpy.types.Operator):
    """Add an ocean from the camera's feet to the horizon, moved by a calibrated sea state"""

    bl_idname = "mesh.ocean_lod_add"
    bl_label = "Ocean (Multi-LOD)"
    bl_options = {"REGISTER", "UNDO"}
    __annotations__ = {
        "preset": bpy.props.EnumProperty(name="Sea", description="Sea state to begin with", items=_preset_items),
        "seed": bpy.props.IntProperty(
            name="Seed", description="Another number gives another sea of the same kind", min=0
        ),
        **rna.annotations(Grid, _unchanged),
    }

    def execute(self, context):
        try:
            preset = presets.load(self.preset)
            sea = presets.with_seed(preset.sea, self.seed)
            ob = ocean_object.create(context.scene, sea, rna.read(Grid, self), preset.material)
        except OceanError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.collection.objects.link(ob)
        ob.location = context.scene.cursor.location
        for other in context.selected_objects:
            other.select_set(False)
        ob.select_set(True)
        context.view_layer.objects.active = ob
        return {"FINISHED"}

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("preset", "seed", *parameters_of(Grid)):
            layout.prop(self, name)


class _OceanOperator:
    """What operators on the active ocean share."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)


class OBJECT_OT_ocean_lod_load_preset(_OceanOperator, bpy.types.Operator):
    """Replace the sea state and the water of this ocean by a preset's"""

    bl_idname = "object.ocean_lod_load_preset"
    bl_label = "Load Sea Preset"
    __annotations__ = {
        "preset": bpy.props.EnumProperty(name="Sea", description="Sea state to load", items=_preset_items)
    }

    def execute(self, context):
        try:
            preset = presets.load(self.preset)
        except OceanError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        ob = context.object
        properties.write_sea(preset.sea, ob.ocean_lod)
        properties.write_material(preset.material, ob.ocean_lod)
        ocean_object.refresh(ob, context.scene)
        ocean_object.refresh_material(ob, context.scene)
        return {"FINISHED"}


class OBJECT_OT_ocean_lod_add_system(_OceanOperator, bpy.types.Operator):
    """Add a wave system, such as a swell from a distant storm; its energy adds to the sea's"""

    bl_idname = "object.ocean_lod_add_system"
    bl_label = "Add Wave System"

    def execute(self, context):
        ob = context.object
        sea = ob.ocean_lod.sea
        with properties.many_changes():
            system = sea.systems.add()
            system.name = f"System {len(sea.systems)}"
            sea.active_system = len(sea.systems) - 1
        ocean_object.refresh(ob, context.scene)
        return {"FINISHED"}


class OBJECT_OT_ocean_lod_remove_system(_OceanOperator, bpy.types.Operator):
    """Remove the selected wave system"""

    bl_idname = "object.ocean_lod_remove_system"
    bl_label = "Remove Wave System"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and len(context.object.ocean_lod.sea.systems) > 1

    def execute(self, context):
        ob = context.object
        sea = ob.ocean_lod.sea
        sea.systems.remove(sea.active_system)
        sea.active_system = min(sea.active_system, len(sea.systems) - 1)
        ocean_object.refresh(ob, context.scene)
        return {"FINISHED"}


CLASSES = (
    MESH_OT_ocean_lod_add,
    OBJECT_OT_ocean_lod_load_preset,
    OBJECT_OT_ocean_lod_add_system,
    OBJECT_OT_ocean_lod_remove_system,
)
