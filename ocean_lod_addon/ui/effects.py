# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of effects: what is computed, what is not, and why."""

import bpy

from ..core.errors import OceanError
from ..scene import ocean_object
from .layouts import draw_text


class OCEAN_LOD_PT_effects(bpy.types.Panel):
    """What a picture rendered at this frame would compute."""

    bl_label = "Effects"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ocean"
    bl_parent_id = "OCEAN_LOD_PT_ocean"
    bl_options = {"DEFAULT_CLOSED"}
    bl_order = 2  # after the panels about the surface

    @classmethod
    def poll(cls, context):
        return ocean_object.is_ocean(context.object)

    def draw(self, context):
        try:
            plan = ocean_object.plan(context.object, context.scene)
        except OceanError:
            return  # the top panel says what is wrong
        effects = context.object.ocean_lod.effects
        for decision in plan.decisions:
            box = self.layout.box()
            row = box.row()
            row.label(text=decision.label, icon="CHECKBOX_HLT" if decision.on else "CHECKBOX_DEHLT")
            row.prop(effects, decision.effect, text="")
            draw_text(context, box, decision.why)
        column = self.layout.column()
        draw_text(context, column, f"Tiles that move: {plan.tiles}. {plan.why_tiles}")
        draw_text(context, column, f"{plan.waves} waves, {plan.columns} numbers per vertex, {plan.images} images")


CLASSES = (OCEAN_LOD_PT_effects,)
