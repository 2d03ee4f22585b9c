# SPDX-License-Identifier: GPL-3.0-or-later
"""The "Ocean" tab of the 3D viewport's sidebar."""

import bpy

from ..core.lod import Grid
from ..core.material_settings import MaterialSettings
from ..core.parameters import parameters_of
from ..scene import ocean_object
from .operators import (
    MESH_OT_ocean_lod_add,
    OBJECT_OT_ocean_lod_add_system,
    OBJECT_OT_ocean_lod_load_preset,
    OBJECT_OT_ocean_lod_remove_system,
)


class OCEAN_LOD_UL_systems(bpy.types.UIList):
    """The wave systems of a sea."""

    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property):
        icon = "FORCE_WIND" if item.sized_by == "wind" else "MOD_WAVE"
        layout.prop(item, "name", text="", emboss=False, icon=icon)
        layout.prop(item, "enabled", text="")


class _OceanPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ocean"

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)


class OCEAN_LOD_PT_ocean(_OceanPanel, bpy.types.Panel):
    """The ocean, or how to add one."""

    bl_label = "Ocean"

    @classmethod
    def poll(cls, _context):
        return True

    def draw(self, context):
        layout = self.layout
        ob = context.object
        if not ocean_object.is_ocean(ob):
            layout.operator(MESH_OT_ocean_lod_add.bl_idname, text="Add Ocean", icon="MOD_OCEAN")
            return
        problem = ocean_object.problem(ob)
        if problem:
            box = layout.box()
            box.alert = True
            box.label(text=problem, icon="ERROR")
        layout.operator_menu_enum(OBJECT_OT_ocean_lod_load_preset.bl_idname, "preset", text="Sea Preset")


class OCEAN_LOD_PT_systems(_OceanPanel, bpy.types.Panel):
    """Wave systems."""

    bl_label = "Waves"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        sea = context.object.ocean_lod.sea
        row = layout.row()
        row.template_list("OCEAN_LOD_UL_systems", "", sea, "systems", sea, "active_system", rows=2)
        column = row.column(align=True)
        column.operator(OBJECT_OT_ocean_lod_add_system.bl_idname, text="", icon="ADD")
        column.operator(OBJECT_OT_ocean_lod_remove_system.bl_idname, text="", icon="REMOVE")
        if sea.active_system < len(sea.systems):
            layout.use_property_split = True
            _draw_system(layout, sea.systems[sea.active_system])


def _draw_system(layout, system):
    column = layout.column()
    column.prop(system, "spectrum")
    column.prop(system, "sized_by")
    if system.sized_by == "wind":
        column.prop(system, "wind_speed")
        column.prop(system, "fetch")
    else:
        column.prop(system, "significant_wave_height")
        column.prop(system, "period")
        column.prop(system, "period_kind")
        column.prop(system, "wind_speed", text="Local Wind (m/s)")
    column.prop(system, "peak_enhancement")
    column = layout.column()
    column.prop(system, "direction")
    column.prop(system, "spreading")
    column.prop(system, "spreading_exponent")
    column.prop(system, "directional_cutoff")
    column = layout.column()
    column.prop(system, "wave_share")
    column.prop(system, "seed")


class OCEAN_LOD_PT_sea(_OceanPanel, bpy.types.Panel):
    """What all wave systems share."""

    bl_label = "Sea"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        sea = context.object.ocean_lod.sea
        layout.prop(sea, "choppiness")
        layout.prop(sea, "finite_depth")
        row = layout.row()
        row.active = sea.finite_depth
        row.prop(sea, "depth")
        column = layout.column()
        column.prop(sea, "wave_count")
        column.prop(sea, "directions")
        column.prop(sea, "seed")
        column.prop(sea, "surface_tension")


class OCEAN_LOD_PT_time(_OceanPanel, bpy.types.Panel):
    """The sea's clock."""

    bl_label = "Time"
    bl_parent_id = "OCEAN_LOD_PT_ocean"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        time = context.object.ocean_lod.time
        layout.prop(time, "source")
        row = layout.row()
        row.active = time.source == "KEYED"
        row.prop(time, "time")
        layout.prop(time, "speed")
        layout.prop(time, "offset")
        layout.prop(time, "loop_frames")


class OCEAN_LOD_PT_mesh(_OceanPanel, bpy.types.Panel):
    """The plane's shape."""

    bl_label = "Mesh"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        ob = context.object
        for name in parameters_of(Grid):
            layout.prop(ob.ocean_lod.grid, name)
        layout.label(text=f"{len(ob.data.vertices):,} vertices, reaching {_reach(ob):,.0f} m")


def _reach(ob):
    grid = ob.ocean_lod.grid
    return grid.cell_size * 2.0 ** (grid.levels - 1) * grid.cells / 2


class OCEAN_LOD_PT_material(_OceanPanel, bpy.types.Panel):
    """The water."""

    bl_label = "Water"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in parameters_of(MaterialSettings):
            layout.prop(context.object.ocean_lod.material, name)


CLASSES = (
    OCEAN_LOD_UL_systems,
    OCEAN_LOD_PT_ocean,
    OCEAN_LOD_PT_systems,
    OCEAN_LOD_PT_sea,
    OCEAN_LOD_PT_time,
    OCEAN_LOD_PT_mesh,
    OCEAN_LOD_PT_material,
)
