# SPDX-License-Identifier: GPL-3.0-or-later
"""The "Ocean" tab of the 3D viewport's sidebar."""

import bpy

from ..core.errors import OceanError
from ..core.lod import Grid
from ..core.material_settings import MaterialSettings
from ..core.parameters import parameters_of
from ..core.readback_text import (
    CONSPICUOUS_SHIFT,
    Line,
    fact_lines,
    formula_wind_lines,
    loop_lines,
    quantity,
    statistics_lines,
)
from ..core.relevant_settings import direction_settings, size_settings
from ..core.roughness import roughening_system
from ..scene import ocean_object, properties
from .layouts import draw_lines, draw_settings, draw_text
from .menus import OCEAN_LOD_MT_preset_files
from .operators import (
    MESH_OT_ocean_lod_add,
    OBJECT_OT_ocean_lod_add_system,
    OBJECT_OT_ocean_lod_remove_system,
)
from .preset_operators import OBJECT_OT_ocean_lod_load_preset, OBJECT_OT_ocean_lod_save_preset
from .readback_cache import report_for


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
            draw_text(context, box, problem, icon="ERROR")
        row = layout.row(align=True)
        row.operator_menu_enum(OBJECT_OT_ocean_lod_load_preset.bl_idname, "preset", text="Sea Preset")
        row.operator(OBJECT_OT_ocean_lod_save_preset.bl_idname, text="", icon="ADD")
        row.menu(OCEAN_LOD_MT_preset_files.__name__, text="", icon="DOWNARROW_HLT")


class OCEAN_LOD_PT_systems(_OceanPanel, bpy.types.Panel):
    """Wave systems."""

    bl_label = "Wave Systems"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        sea = context.object.ocean_lod.sea
        row = layout.row()
        row.template_list("OCEAN_LOD_UL_systems", "", sea, "systems", sea, "active_system", rows=2)
        column = row.column(align=True)
        column.operator_menu_enum(OBJECT_OT_ocean_lod_add_system.bl_idname, "kind", text="", icon="ADD")
        column.operator(OBJECT_OT_ocean_lod_remove_system.bl_idname, text="", icon="REMOVE")
        if sea.active_system < len(sea.systems):
            layout.use_property_split = True
            _draw_system(context, layout, sea.systems[sea.active_system])


def _draw_system(context, layout, system):
    """The settings of a system that have an effect, in the order in which an artist decides them."""
    ocean = context.object.ocean_lod
    settings = properties.read_system(system)
    by_wind = settings.sized_by == "wind"
    column = layout.column()
    column.prop(system, "spectrum")
    column.prop(system, "sized_by")
    if by_wind:
        column.prop(system, "beaufort", slider=True)
    draw_settings(layout, system, size_settings(settings))
    if not by_wind and _roughens(ocean, system):
        layout.prop(system, "wind_speed")
    if settings.spectrum == "tma" and not ocean.sea.finite_depth:
        draw_text(context, layout, "TMA needs Finite Depth, below under Water Body", icon="INFO")
    draw_settings(layout, system, direction_settings(settings))
    draw_settings(layout, system, ("wave_share", "seed"))


def _roughens(ocean, system):
    """Whether the surface's roughness comes from this system's wind."""
    index = roughening_system(properties.read_sea(ocean))
    return index is not None and ocean.sea.systems[index] == system


class OCEAN_LOD_PT_winds(_OceanPanel, bpy.types.Panel):
    """The wind of the active system at the heights of the formulas."""

    bl_label = "Wind in the Formulas"
    bl_parent_id = "OCEAN_LOD_PT_systems"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(_active_wind_lines(context))

    def draw(self, context):
        draw_lines(self.layout, _active_wind_lines(context), name_share=0.48)


def _active_wind_lines(context):
    sea = context.object.ocean_lod.sea
    if sea.active_system >= len(sea.systems):
        return []
    return formula_wind_lines(properties.read_system(sea.systems[sea.active_system]))


class OCEAN_LOD_PT_sea(_OceanPanel, bpy.types.Panel):
    """What all wave systems share."""

    bl_label = "Water Body"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        sea = context.object.ocean_lod.sea
        layout.prop(sea, "choppiness")
        column = layout.column()
        column.prop(sea, "finite_depth")
        row = column.row()
        row.active = sea.finite_depth
        row.prop(sea, "depth")
        draw_settings(layout, sea, ("wave_count", "directions", "seed", "surface_tension"))


class OCEAN_LOD_PT_readback(_OceanPanel, bpy.types.Panel):
    """What the sea is, in numbers."""

    bl_label = "Read-Back"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        report, current = _report(context)
        if report is None:
            layout.label(text="Measuring...")
            return
        layout.active = current
        heading = Line("", ("Spectrum", "Waves"))
        draw_lines(layout.box(), [heading, *statistics_lines(report)], name_share=0.46)
        draw_lines(layout.box(), fact_lines(report), name_share=0.5)


def _ocean(context):
    """What the active ocean is made from; None if its settings do not go together, as the top panel says."""
    try:
        return ocean_object.read_ocean(context.object, context.scene)
    except OceanError:
        return None


def _report(context):
    ocean = _ocean(context)
    return report_for(ocean) if ocean else (None, False)


class OCEAN_LOD_PT_time(_OceanPanel, bpy.types.Panel):
    """The sea's clock."""

    bl_label = "Time"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        time = context.object.ocean_lod.time
        keyed = time.source == "KEYED"
        draw_settings(layout, time, ("source", *(("time",) if keyed else ()), "speed", "offset", "loop_frames"))
        ocean = _ocean(context)
        if ocean and ocean.sea.loop_period:
            _draw_loop(context, layout, ocean, keyed)


def _draw_loop(context, layout, ocean, keyed):
    report, current = report_for(ocean)
    period = ocean.sea.loop_period
    column = layout.box().column()
    column.active = current
    draw_text(context, column, f"The sea repeats every {quantity(period, 's')} of its clock", icon="FILE_REFRESH")
    if keyed:
        time = properties.read_time(context.object.ocean_lod)
        advance = quantity(period / abs(time.speed), "s")
        draw_text(context, column, f"Key Time to advance {advance} in {time.loop_frames} frames", icon="BLANK1")
    if report is None or report.loop is None:
        return
    draw_lines(column, loop_lines(report.loop), name_share=0.6)
    if report.loop.rms_frequency_shift > CONSPICUOUS_SHIFT:
        draw_text(context, column, "Waves run visibly too fast or too slow: a longer loop is truer", icon="ERROR")


class OCEAN_LOD_PT_mesh(_OceanPanel, bpy.types.Panel):
    """The plane's shape."""

    bl_label = "Mesh"
    bl_parent_id = "OCEAN_LOD_PT_ocean"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        ob = context.object
        draw_settings(layout, ob.ocean_lod.grid, parameters_of(Grid))
        layout.label(text=f"{len(ob.data.vertices):,} vertices, reaching {_reach(ob):,.0f} m")


def _reach(ob):
    grid = ob.ocean_lod.grid
    return grid.cell_size * 2.0 ** (grid.levels - 1) * grid.cells / 2


class OCEAN_LOD_PT_material(_OceanPanel, bpy.types.Panel):
    """The water."""

    bl_label = "Water"
    bl_parent_id = "OCEAN_LOD_PT_ocean"
    bl_order = 1  # after the panels about the plane

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        material = context.object.ocean_lod.material
        for parameter in parameters_of(MaterialSettings):
            row = layout.row()
            row.active = parameter != "eevee_depth" or material.see_through
            draw_settings(row, material, (parameter,))


CLASSES = (
    OCEAN_LOD_UL_systems,
    OCEAN_LOD_PT_ocean,
    OCEAN_LOD_PT_systems,
    OCEAN_LOD_PT_winds,
    OCEAN_LOD_PT_sea,
    OCEAN_LOD_PT_readback,
    OCEAN_LOD_PT_time,
    OCEAN_LOD_PT_mesh,
    OCEAN_LOD_PT_material,
)
