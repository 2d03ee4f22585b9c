# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes come and go with the plan, and hold what the direct sum says."""

import math

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.foam.whitecaps import Whitecaps
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.ripples.bump import Bump
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene import ocean_object
from tests.fresh_ocean import fresh_ocean

EFFECT_ATTRIBUTES = {"custom_normal", "velocity", "ocean_foam", "ocean_foam_whitecaps", "ocean_rest_position"}
FOAM = {"ocean_foam", "ocean_foam_whitecaps", "ocean_rest_position"}


@pytest.fixture
def shot(tmp_path):
    """An ocean and a camera in Cycles, where a picture is 16 x 16."""
    ocean, scene = fresh_ocean(cells=32, levels=4, cell_size=0.25)
    ocean.ocean_lod.ripples.kind = "off"
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.rotation_euler = (math.radians(70), 0.0, math.radians(-90))
    camera.location = (0.0, 0.0, 5.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.filepath = str(tmp_path / "frame")
    scene.render.engine = "CYCLES"
    scene.cycles.samples = scene.eevee.taa_render_samples = 1
    scene.render.resolution_x = scene.render.resolution_y = 16
    yield ocean, scene
    ocean_lod_addon.unregister()


def effect_attributes(ocean):
    return {attribute.name for attribute in ocean.data.attributes} & EFFECT_ATTRIBUTES


def vectors(ocean, name):
    values = np.empty((len(ocean.data.vertices), 3), np.float32)
    ocean.data.attributes[name].data.foreach_get("vector", values.ravel())
    return values


@pytest.mark.parametrize(
    ("engine", "blur", "expected"),
    [
        ("CYCLES", False, {"custom_normal"} | FOAM),
        ("CYCLES", True, {"custom_normal", "velocity"} | FOAM),
        ("EEVEE", True, {"custom_normal"} | FOAM),
    ],
)
def test_a_render_leaves_exactly_the_attributes_that_its_plan_names(shot, engine, blur, expected):
    ocean, scene = shot
    if engine == "EEVEE":
        offered = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
        scene.render.engine = next(name for name in offered if name.startswith("BLENDER_EEVEE"))
    scene.render.use_motion_blur = blur
    bpy.ops.render.render()
    assert set(ocean_object.plan(ocean, scene).attributes) == expected == effect_attributes(ocean)


def test_settings_take_attributes_away_and_bring_them_back(shot):
    ocean, _ = shot
    effects = ocean.ocean_lod.effects
    effects.velocity, effects.analytic_normals, effects.foam = "on", "off", "off"
    assert effect_attributes(ocean) == {"velocity"}
    effects.velocity, effects.foam = "off", "auto"
    assert effect_attributes(ocean) == FOAM
    effects.foam = "off"
    assert effect_attributes(ocean) == set()
    effects.analytic_normals = "auto"
    assert effect_attributes(ocean) == {"custom_normal"}


def test_attributes_hold_the_water_s_velocity_and_the_surface_s_normal(shot):
    """In the middle of the plane, where all windows are 1; frame 30 of 24 a second, float32."""
    ocean, scene = shot
    scene.camera = None
    ocean.ocean_lod.effects.velocity = "on"
    scene.frame_set(30)
    asked = ocean_object.read_ocean(ocean, scene)
    waves = discretise(asked.sea, asked.grid.shortest_wavelength)
    point = surface_points(waves, 0.0, 0.0, 30 / 24)
    positions = mesh_arrays.read_positions(ocean.data)
    middle = int(np.argmin(np.abs(positions - point.position).sum(axis=1)))
    assert np.abs(positions[middle] - point.position).max() < 1e-5
    assert np.abs(vectors(ocean, "velocity")[middle] - point.velocity).max() < 1e-5
    assert np.abs(vectors(ocean, "custom_normal")[middle] - point.normal).max() < 1e-5


def test_blender_shades_with_the_surface_s_normals(shot):
    ocean, scene = shot
    scene.frame_set(12)
    evaluated = ocean.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    shaded = np.array([evaluated.corner_normals[loop].vector[:] for loop in range(0, 600, 7)])
    corners = [evaluated.loops[loop].vertex_index for loop in range(0, 600, 7)]
    assert np.abs(shaded - vectors(ocean, "custom_normal")[corners]).max() < 1e-6


def test_off_moves_nothing_sideways(shot):
    ocean, scene = shot
    scene.camera = None
    ocean.ocean_lod.effects.horizontal_displacement = "off"
    positions = mesh_arrays.read_positions(ocean.data)[:, :2]
    assert np.array_equal(positions, np.round(positions / 0.25) * 0.25)
    assert ocean.ocean_lod.sea.choppiness == 1.0, "the artist's setting stays"


def foam_of(ocean):
    values = np.empty(len(ocean.data.vertices), np.float32)
    ocean.data.attributes["ocean_foam"].data.foreach_get("value", values)
    return values


def test_frame_100_alone_has_the_foam_of_frame_100_after_all_others(shot):
    ocean, scene = shot
    ocean.ocean_lod.sea.systems[0].wind_speed = 20.0
    scene.frame_set(100)
    alone = foam_of(ocean)
    for frame in range(1, 101):
        scene.frame_set(frame)
    assert alone.max() > 0.5
    assert np.array_equal(foam_of(ocean), alone)


def test_foam_comes_and_goes_without_breaking_an_artist_s_material(shot):
    """A shader mixed in behind the water stays where it is, whatever foam does."""
    ocean, _ = shot
    effects, tree = ocean.ocean_lod.effects, ocean.data.materials[0].node_tree
    output = tree.nodes["Output Cycles"]
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.location = (700.0, -77.0)
    before = output.inputs["Surface"].links[0].from_node
    tree.links.new(output.inputs["Surface"].links[0].from_socket, mix.inputs[1])
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    assert before.name == "Ocean LOD Foam"
    tree.nodes["Ocean LOD Foam"].inputs["Grain"].default_value = 7.0
    ocean.ocean_lod.foam.reflectance = 0.4
    assert tree.nodes["Ocean LOD Foam"].inputs["Grain"].default_value == 7.0
    assert tree.nodes["Ocean LOD Foam"].inputs["Foam Color"].default_value[0] == pytest.approx(0.4)
    for word, behind in (("off", "Ocean LOD Water"), ("on", "Ocean LOD Foam"), ("off", "Ocean LOD Water")):
        effects.foam = word
        assert output.inputs["Surface"].links[0].from_node == mix
        assert mix.inputs[1].links[0].from_node.name == behind
        assert tuple(mix.location) == (700.0, -77.0)
        assert ("Ocean LOD Foam" in tree.nodes) == (word == "on")
        assert ("Ocean LOD Foam" in bpy.data.node_groups) == (word == "on")


def test_frames_without_water_cost_nothing(shot, monkeypatch):
    """The camera looks at the sea, then at the sky: no wave, ripple or foam is evaluated for the second half."""
    ocean, scene = shot
    ocean.ocean_lod.ripples.kind = "spectral"
    evaluated = []
    steps = [(FrameKernel, name) for name in ("__init__", "fill_factors", "products", "evaluate")]
    for owner, name in [*steps, (Bump, "image"), (Whitecaps, "foam")]:
        whole = getattr(owner, name)

        def counted(*arguments, whole=whole, **more):
            evaluated.append(scene.frame_current)
            return whole(*arguments, **more)

        monkeypatch.setattr(owner, name, counted)
    camera = scene.camera
    for frame, degrees in ((1, 70.0), (2, 70.0), (3, 150.0), (4, 150.0)):
        camera.rotation_euler[0] = math.radians(degrees)
        camera.keyframe_insert("rotation_euler", frame=frame)
    scene.frame_start, scene.frame_end = 1, 4
    evaluated.clear()
    during = []
    handler = bpy.app.handlers.render_post
    handler.append(lambda *_: during.append(set(evaluated)))
    try:
        bpy.ops.render.render(animation=True)
    finally:
        handler.pop()
    assert during == [{1}, {1, 2}, {1, 2}, {1, 2}]
    scene.frame_set(4)
    assert ocean_object.plan(ocean, scene).tiles == "none"


@pytest.mark.parametrize(("at_the_frame", "within_the_shutter"), [(70.0, 150.0), (150.0, 70.0)])
def test_a_frame_s_decision_holds_while_its_shutter_is_open(shot, monkeypatch, at_the_frame, within_the_shutter):
    """A camera that turns from the sea to the sky within the shutter sees water that moves all the time; one that
    turns to the sea sees none that begins to."""
    ocean, scene = shot
    ocean.ocean_lod.effects.velocity = "off"  # so that Cycles asks for the instants of the shutter
    camera = scene.camera
    for frame, degrees in ((1.7, within_the_shutter), (2.0, at_the_frame), (2.3, within_the_shutter)):
        camera.rotation_euler[0] = math.radians(degrees)
        camera.keyframe_insert("rotation_euler", frame=frame)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.8
    scene.frame_set(2)
    rendering, evaluated = [], set()
    whole = FrameKernel.evaluate

    def counted(*arguments, **more):
        if rendering:
            evaluated.add(round(scene.frame_current_final, 3))
        return whole(*arguments, **more)

    monkeypatch.setattr(FrameKernel, "evaluate", counted)
    begin, end = bpy.app.handlers.render_pre, bpy.app.handlers.render_post
    begin.append(lambda *_: rendering.append(True))
    end.append(lambda *_: rendering.clear())
    try:
        bpy.ops.render.render()
    finally:
        begin.pop()
        end.pop()
    if at_the_frame == 70.0:
        assert {1.6, 2.0, 2.4} <= evaluated
    else:
        assert not evaluated
