# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators: thin, undoable wrappers around `scene`."""

import bpy

from ..core import presets
from ..core.errors import OceanError
from ..core.lod import Grid
from ..core.parameters import parameters_of
from ..core.sea import WaveSystem
from ..scene import ocean_object, properties, rna
from . import preset_library

SWELL = WaveSystem(
    name="Swell",
    spectrum="jonswap",
    sized_by="height",
    significant_wave_height=1.5,
    period=12.0,
    peak_enhancement=6.0,
    spreading="cos2s",
    spreading_exponent=40.0,
    wave_share=0.25,
)
WIND_SEA = WaveSystem(wave_share=0.75)
"""What Add Wave System offers, before the artist changes it."""


def _unchanged(_operator, _context):
    """Operator properties refresh nothing: the operator runs again from its redo panel."""


class MESH_OT_ocean_lod_add(bpy.types.Operator):
    """Add an ocean from the camera's feet to the horizon, moved by a calibrated sea state"""

    bl_idname = "mesh.ocean_lod_add"
    bl_label = "Ocean (Multi-LOD)"
    bl_options = {"REGISTER", "UNDO"}
    __annotations__ = {
        "preset": bpy.props.EnumProperty(
            name="Sea",
            description="Sea state to begin with",
            items=preset_library.items,
            default=preset_library.first_choice(),
        ),
        "seed": bpy.props.IntProperty(
            name="Seed", description="Another number gives another sea of the same kind", min=0
        ),
        **rna.annotations(Grid, _unchanged),
    }

    def execute(self, context):
        try:
            preset = preset_library.load(self.preset)
            sea = presets.with_seed(preset.sea, self.seed)
            ob = ocean_object.create(context.scene, sea, rna.read(Grid, self), preset.material, foam=preset.foam)
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


class OceanOperator:
    """What operators on the active ocean share."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)


class OBJECT_OT_ocean_lod_add_system(OceanOperator, bpy.types.Operator):
    """Add a wave system, such as a swell from a distant storm. Its energy adds to the sea's, and the waves that
    were there stay as they were"""

    bl_idname = "object.ocean_lod_add_system"
    bl_label = "Add Wave System"
    __annotations__ = {
        "kind": bpy.props.EnumProperty(
            name="Kind",
            description="What the wave system begins as",
            items=[
                ("SWELL", "Swell", "Long waves from a distant storm, sized by height and period"),
                ("WIND_SEA", "Wind Sea", "Waves of a local wind, sized by its speed"),
            ],
        )
    }

    def execute(self, context):
        ob = context.object
        sea = ob.ocean_lod.sea
        with properties.many_changes():
            rna.write(SWELL if self.kind == "SWELL" else WIND_SEA, sea.systems.add())
            sea.active_system = len(sea.systems) - 1
        ocean_object.refresh(ob, context.scene)
        return {"FINISHED"}


class OBJECT_OT_ocean_lod_remove_system(OceanOperator, bpy.types.Operator):
    """Remove the selected wave system. To see the sea without it, switch it off instead: that leaves the waves of
    the systems below it as they are"""

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
    OBJECT_OT_ocean_lod_add_system,
    OBJECT_OT_ocean_lod_remove_system,
)
