# SPDX-License-Identifier: GPL-3.0-or-later
"""Every operator that changes something can be undone and redone; the others change nothing."""

import inspect

import bpy
import numpy as np
import pytest

from ocean_lod_addon import ui
from ocean_lod_addon.core import presets
from ocean_lod_addon.scene import mesh, ocean_object, properties

LEAVES_THE_SCENE_ALONE = {
    "object.ocean_lod_save_preset",
    "object.ocean_lod_remove_preset",
    "object.ocean_lod_export_preset",
    "object.ocean_lod_measure_machine",
}
"""They write a file, or learn how fast the machine is."""


def state():
    """All that an artist sees of the oceans in the scene."""
    seen = {}
    for ob in bpy.data.objects:
        seen[ob.name] = (
            properties.read_preset(ob.ocean_lod, "", ""),
            ob.ocean_lod.sea.active_system,
            mesh.read_positions(ob.data).tobytes(),
        )
    return seen


def exported(tmp_path):
    path = tmp_path / "sea.json"
    presets.write(presets.load("long_atlantic_swell"), path)
    return str(path)


OPERATIONS = {
    "add": lambda _: bpy.ops.mesh.ocean_lod_add("EXEC_DEFAULT", True, preset="calm", cells=16, levels=2),
    "load preset": lambda _: bpy.ops.object.ocean_lod_load_preset("EXEC_DEFAULT", True, preset="storm"),
    "import preset": lambda path: bpy.ops.object.ocean_lod_import_preset(
        "EXEC_DEFAULT", True, filepath=exported(path)
    ),
    "add swell": lambda _: bpy.ops.object.ocean_lod_add_system("EXEC_DEFAULT", True, kind="SWELL"),
    "add wind sea": lambda _: bpy.ops.object.ocean_lod_add_system("EXEC_DEFAULT", True, kind="WIND_SEA"),
    "remove system": lambda _: bpy.ops.object.ocean_lod_remove_system("EXEC_DEFAULT", True),
}


@pytest.mark.parametrize("name", OPERATIONS)
def test_undo_and_redo(ocean, name, tmp_path):
    """Truth: undo gives the state before, bit for bit, redo the state after; operators push their step."""
    bpy.ops.object.ocean_lod_add_system(kind="SWELL")
    bpy.ops.ed.undo_push(message="before")
    before = state()
    assert OPERATIONS[name](tmp_path) == {"FINISHED"}
    after = state()
    assert after != before
    bpy.ops.ed.undo()
    assert state() == before
    bpy.ops.ed.redo()
    assert state() == after


def parts():
    """What effects put into a file: attributes, nodes and what links them, groups and images."""
    (ob,) = (ob for ob in bpy.data.objects if ob.ocean_lod.is_ocean)
    tree = ob.data.materials[0].node_tree
    links = ((link.from_node, link.from_socket, link.to_node, link.to_socket) for link in tree.links)
    return (
        {attribute.name for attribute in ob.data.attributes},
        {tuple(end.name for end in link) for link in links},
        {group.name for group in bpy.data.node_groups},
        {image.name for image in bpy.data.images},
    )


def test_effects_can_be_undone_and_redone(ocean):
    """Truth: parts come back and go as they were, an artist's own node stays, and the ocean moves on."""
    tree = ocean.data.materials[0].node_tree
    own = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(tree.nodes["Ocean LOD Foam"].outputs["Cycles"], own.inputs[1])
    bpy.ops.ed.undo_push(message="before")
    before = parts()
    effects = ocean.ocean_lod.effects
    effects.foam, effects.ripples, effects.gusts, effects.see_through = "off", "off", "on", "on"
    bpy.ops.ed.undo_push(message="after")
    after = parts()
    assert ("Ocean LOD Water", "Cycles", own.name, "Shader") in after[1]
    for ours, theirs in zip(before, after, strict=True):
        assert ours != theirs
    bpy.ops.ed.undo()
    assert parts() == before
    bpy.context.scene.frame_set(7)
    assert parts() == before
    bpy.ops.ed.redo()
    assert parts() == after
    bpy.context.scene.frame_set(8)
    (ob,) = (ob for ob in bpy.data.objects if ob.ocean_lod.is_ocean)
    assert ocean_object.problem(ob) == ""


def test_every_operator_that_changes_the_scene_has_an_undo_step():
    for cls in ui._CLASSES:
        if issubclass(cls, bpy.types.Operator):
            undoable = "UNDO" in cls.bl_options
            assert undoable == (cls.bl_idname not in LEAVES_THE_SCENE_ALONE), cls.bl_idname


def test_every_operator_and_panel_is_explained():
    """Truth: tooltips (docstrings of operators) are sentences without a full stop, as Blender asks."""
    for cls in ui._CLASSES:
        if issubclass(cls, bpy.types.Operator):
            text = inspect.getdoc(cls)
            assert len(text) > 20
            assert not text.endswith(".")


def test_a_new_system_leaves_the_waves_that_were_there(ocean):
    """Truth: adding a system of no energy changes no vertex; a swell changes them."""
    before = mesh.read_positions(ocean.data)
    bpy.ops.object.ocean_lod_add_system(kind="WIND_SEA")
    ocean.ocean_lod.sea.systems[1].wind_speed = 0.0
    assert np.array_equal(mesh.read_positions(ocean.data), before)
    bpy.ops.object.ocean_lod_add_system(kind="SWELL")
    assert not np.array_equal(mesh.read_positions(ocean.data), before)


def test_the_last_system_can_not_be_removed(ocean):
    assert not bpy.ops.object.ocean_lod_remove_system.poll()
    bpy.ops.object.ocean_lod_add_system()
    assert bpy.ops.object.ocean_lod_remove_system.poll()
    bpy.ops.object.ocean_lod_remove_system()
    assert len(ocean.ocean_lod.sea.systems) == 1


def test_operators_on_an_ocean_need_one(ocean):
    bpy.context.view_layer.objects.active = None
    for cls in ui._CLASSES:
        if issubclass(cls, bpy.types.Operator) and cls.bl_idname.startswith("object."):
            assert not getattr(bpy.ops.object, cls.bl_idname.removeprefix("object.")).poll()
