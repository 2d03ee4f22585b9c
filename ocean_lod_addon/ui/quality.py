# SPDX-License-Identifier: GPL-3.0-or-later
"""What a frame costs, and the quality that a time allows."""

import bpy

from ..core.cost.budget import milliseconds
from ..core.cost.model import STAGES
from ..core.cost.quality import QUALITIES
from ..core.errors import OceanError
from ..core.readback_text import Line
from ..scene import costing, frame_times, ocean_object, properties
from .layouts import draw_lines, draw_text

_ITEMS = [(name, quality.label, quality.description) for name, quality in QUALITIES.items()]


_BUTTONS_PER_ROW = 3
"""As many as show their names in a sidebar of Blender's own width."""


class _QualityOperator:
    """What these operators share."""

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)


class OBJECT_OT_ocean_lod_set_quality(_QualityOperator, bpy.types.Operator):
    """Draw the same sea with more or less effort: the density of the mesh, how far waves stay geometry, and the
    images of ripples. Waves stay where they are"""

    bl_idname = "object.ocean_lod_set_quality"
    bl_label = "Set Quality"
    bl_options = {"REGISTER", "UNDO"}
    __annotations__ = {
        "quality": bpy.props.EnumProperty(
            name="Quality", description="How much effort is spent", items=_ITEMS, default="standard"
        )
    }

    def execute(self, context):
        try:
            costing.set_quality(context.object, context.scene, self.quality)
        except OceanError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class OBJECT_OT_ocean_lod_meet_budget(_QualityOperator, bpy.types.Operator):
    """Choose the most accurate quality whose frames take the budget at most on this machine, once: another machine
    renders the same, in its own time. Measures this machine first if that has not been done"""

    bl_idname = "object.ocean_lod_meet_budget"
    bl_label = "Fit Quality to Budget"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        ob = context.object
        try:
            choice = costing.meet_budget(ob, context.scene, 1e-3 * ob.ocean_lod.quality.budget, final=False)
        except OceanError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO" if choice.fits else "WARNING"}, choice.explain())
        return {"FINISHED"}


class OBJECT_OT_ocean_lod_measure_machine(_QualityOperator, bpy.types.Operator):
    """Measure how fast this machine is, to predict the time of a frame: takes about a second"""

    bl_idname = "object.ocean_lod_measure_machine"
    bl_label = "Measure This Machine"
    bl_options = {"REGISTER"}

    def execute(self, context):
        context.window_manager.progress_begin(0, 1)
        try:
            costing.measure_machine()
        finally:
            context.window_manager.progress_end()
        return {"FINISHED"}


class OCEAN_LOD_PT_quality(_QualityOperator, bpy.types.Panel):
    """Quality and time of a frame."""

    bl_label = "Quality"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ocean"
    bl_parent_id = "OCEAN_LOD_PT_ocean"
    bl_order = 1  # after the panels about the plane

    def draw(self, context):
        layout, ob = self.layout, context.object
        _, name = properties.sized_plane(ob.ocean_lod)
        grid = layout.grid_flow(columns=_BUTTONS_PER_ROW, row_major=True, even_columns=True, align=True)
        for key, quality in QUALITIES.items():
            operator = grid.operator(
                OBJECT_OT_ocean_lod_set_quality.bl_idname, text=quality.label, depress=key == name
            )
            operator.quality = key
        row = layout.row(align=True)
        row.prop(ob.ocean_lod.quality, "budget")
        row.operator(OBJECT_OT_ocean_lod_meet_budget.bl_idname, text="Fit")
        try:
            predicted = costing.predict(ob, context.scene, final=False)
        except OceanError:
            return  # the top panel says what is wrong
        if not predicted:
            layout.operator(OBJECT_OT_ocean_lod_measure_machine.bl_idname, icon="TIME")
        draw_lines(layout.box(), time_lines(predicted, frame_times.of_last_frame(ob)), name_share=0.4)
        if predicted and 1e3 * sum(predicted.values()) > ob.ocean_lod.quality.budget:
            draw_text(context, layout, "A frame is predicted to take longer than the budget", icon="ERROR")


_TOGETHER = {"factors": "products", "foam_products": "products"}
"""Stages that a frame can not tell apart, and where they are counted."""


def time_lines(predicted: dict[str, float], measured: dict[str, float]) -> list[Line]:
    """Predicted and measured time of each stage in the viewport, then of what was both predicted and measured."""
    together = {}
    for stage, seconds in predicted.items():
        shown = _TOGETHER.get(stage, stage)
        together[shown] = together.get(shown, 0.0) + seconds
    lines = [Line("ms a frame", ("Predicted", "Last"))]
    for stage in STAGES:
        if stage in together or stage in measured:
            lines.append(Line(STAGES[stage].label, (_text(together.get(stage)), _text(measured.get(stage)))))
    total = sum(together.values()) if together else None
    seen = sum(measured.values()) if measured else None
    return [*lines, Line("Together", (_text(total), _text(seen)))]


def _text(seconds):
    return "-" if seconds is None else milliseconds(seconds).removesuffix(" ms")


CLASSES = (
    OBJECT_OT_ocean_lod_set_quality,
    OBJECT_OT_ocean_lod_meet_budget,
    OBJECT_OT_ocean_lod_measure_machine,
    OCEAN_LOD_PT_quality,
)
