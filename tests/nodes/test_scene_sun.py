# SPDX-License-Identifier: GPL-3.0-or-later
"""Which sun a scene has, and that claiming it can be undone."""

import math

import bpy
import pytest

from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.nodes.material import ensure_material, set_sun
from ocean_lod_addon.nodes.scene_sun import claim_sun, release_sun, scene_sun
from ocean_lod_addon.nodes.water_group import WATER


@pytest.fixture(autouse=True)
def _empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def add_sun(energy, elevation_degrees=90.0, name="Sun"):
    sun = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
    sun.data.energy = energy
    sun.rotation_euler = (0.0, math.radians(90.0 - elevation_degrees), 0.0)
    bpy.context.scene.collection.objects.link(sun)
    bpy.context.view_layer.update()
    return sun


def add_sky():
    world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    world.node_tree.links.new(sky.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])
    bpy.context.scene.world = world
    return sky


def test_a_scene_without_sun_has_none():
    assert scene_sun(bpy.context.scene) is None
    bpy.context.scene.world = bpy.data.worlds.new("Grey")
    assert scene_sun(bpy.context.scene) is None


def test_a_sun_light_shines_along_its_z_axis_with_its_strength():
    lamp = add_sun(3.0, elevation_degrees=30.0)
    lamp.data.color, lamp.data.angle = (1.0, 0.5, 0.25), 0.02
    sun = scene_sun(bpy.context.scene)
    assert sun.direction == pytest.approx((math.cos(math.radians(30.0)), 0.0, 0.5), abs=1e-6)
    assert sun.irradiance == pytest.approx((3.0, 1.5, 0.75), rel=1e-6)
    assert sun.angular_diameter == pytest.approx(0.02)
    assert sun.shines_in_eevee


def test_the_strongest_visible_sun_is_taken():
    add_sun(1.0)
    strongest = add_sun(5.0)
    assert scene_sun(bpy.context.scene).irradiance[0] == pytest.approx(5.0)
    strongest.hide_render = True
    assert scene_sun(bpy.context.scene).irradiance[0] == pytest.approx(1.0)


def test_a_sky_texture_is_a_sun_where_it_shows_a_disc():
    sky = add_sky()
    sky.sun_intensity, sky.sun_elevation, sky.sun_rotation = 0.5, math.radians(30.0), math.radians(90.0)
    sun = scene_sun(bpy.context.scene)
    assert sun.direction == pytest.approx((math.cos(math.radians(30.0)), 0.0, 0.5), abs=1e-6)
    assert not sun.shines_in_eevee
    sky.sun_intensity = 1.0
    assert scene_sun(bpy.context.scene).irradiance == pytest.approx([2.0 * part for part in sun.irradiance])
    sky.sun_disc = False
    assert scene_sun(bpy.context.scene) is None


def test_a_sky_model_without_a_disc_or_a_colored_sky_is_no_sun():
    sky = add_sky()
    sky_type = sky.sky_type
    sky.sky_type = "PREETHAM"
    assert scene_sun(bpy.context.scene) is None
    sky.sky_type = sky_type
    assert scene_sun(bpy.context.scene) is not None
    tree = bpy.context.scene.world.node_tree
    gamma = tree.nodes.new("ShaderNodeGamma")
    tree.links.new(sky.outputs[0], gamma.inputs[0])
    tree.links.new(gamma.outputs[0], tree.nodes["Background"].inputs["Color"])
    assert scene_sun(bpy.context.scene) is None


def test_claiming_a_sun_twice_and_releasing_it_gives_it_back():
    lamp = add_sun(1.0)
    lamp.data.specular_factor = 0.75
    for _ in range(2):
        claim_sun(bpy.context.scene, MaterialSettings(sun_model="formula"))
    assert lamp.data.specular_factor == 0.0
    assert not lamp.visible_glossy
    claim_sun(bpy.context.scene, MaterialSettings())
    assert lamp.visible_glossy
    release_sun(bpy.context.scene)
    assert lamp.data.specular_factor == 0.75


def test_eevee_reflects_all_of_a_claimed_sky_and_gets_its_limits_back():
    scene = bpy.context.scene
    limit = scene.eevee.clamp_surface_indirect
    claim_sun(scene, MaterialSettings())
    assert scene.eevee.clamp_surface_indirect == limit > 0.0  # no sky, no claim
    add_sky()
    scene.world.sun_threshold = 12.0
    for _ in range(2):
        claim_sun(scene, MaterialSettings())
    assert scene.eevee.clamp_surface_indirect == scene.world.sun_threshold == 0.0
    release_sun(scene)
    assert (scene.eevee.clamp_surface_indirect, scene.world.sun_threshold) == (limit, 12.0)


def test_the_material_takes_the_sun_and_loses_it():
    material = ensure_material("Ocean", MaterialSettings())
    sockets = material.node_tree.nodes[WATER.name].inputs
    add_sun(3.0, elevation_degrees=30.0)
    set_sun(material, scene_sun(bpy.context.scene))
    assert tuple(sockets["Sun Irradiance"].default_value)[:3] == (3.0, 3.0, 3.0)
    assert sockets["Sun Direction"].default_value[2] == pytest.approx(0.5)
    set_sun(material, None)
    assert tuple(sockets["Sun Irradiance"].default_value)[:3] == (0.0, 0.0, 0.0)
