# SPDX-License-Identifier: GPL-3.0-or-later
"""Looking into the water with Cycles: what gets through the surface, and what the water takes of it."""

import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel
from ocean_lod_addon.core.optics.water_types import WATER_TYPES, rgb_absorption
from ocean_lod_addon.nodes.material import NODE_NAME, ensure_material, water_color
from tests.render.flat_sea import FlatSea, direction, slope_tensor

pytestmark = pytest.mark.render

NEARLY_FLAT = [slope_tensor(0.01, 0.01)] * 4

SUN_ELEVATION, SUN_IRRADIANCE = 50.0, 4.0


def clear_sea(settings):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    sea = FlatSea(ensure_material("Ocean", settings), NEARLY_FLAT)
    sea.look_along_x(90.0)
    sea.shine(direction(SUN_ELEVATION), SUN_IRRADIANCE)  # along the strips: the sea is narrow across them
    return sea


def add_bottom(depth, albedo):
    material = bpy.data.materials.new("Bottom")
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    diffuse = material.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (albedo, albedo, albedo, 1.0)
    output = material.node_tree.nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    mesh = bpy.data.meshes.new("Bottom")
    mesh.from_pydata([(-99, -99, -depth), (99, -99, -depth), (99, 99, -depth), (-99, 99, -depth)], [], [range(4)])
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Bottom", mesh))


def test_the_bottom_shows_through_as_much_water_as_the_light_crosses(tmp_path):
    """Truth: E sin(elevation) (1 - F_sun) T_down albedo/pi T_up (1 - F_nadir)/n^2, T by Beer and Lambert along the
    sun's straight way down and the vertical way up. 2 %: the mean Fresnel fit and 64 samples of a smooth lobe.
    """
    depth, albedo = 3.0, 0.5
    sea = clear_sea(MaterialSettings(water_type="coastal", see_through=True))
    add_bottom(depth, albedo)
    (material,) = sea.sea.data.materials
    material.node_tree.nodes[NODE_NAME].inputs["Backscattering"].default_value = (0.0, 0.0, 0.0)
    sea.scene.cycles.diffuse_bounces = 0
    picture = sea.render_cycles(tmp_path / "sea.exr", samples=64, bounces=8).mean(axis=0)

    sine = math.sin(math.radians(SUN_ELEVATION))
    F_sun = fresnel.exact(NumpyOps(), sine, WATER_REFRACTIVE_INDEX)
    F_view = fresnel.normal_incidence(WATER_REFRACTIVE_INDEX)
    path = depth / sine + depth
    truth = SUN_IRRADIANCE * sine * (1.0 - F_sun) * (1.0 - F_view) * albedo / math.pi
    truth = truth / WATER_REFRACTIVE_INDEX**2 * np.exp(-rgb_absorption(WATER_TYPES["coastal"]) * path)
    assert picture == pytest.approx(truth, rel=0.02)


@pytest.mark.parametrize("water_type", ["clear_ocean", "ocean", "coastal"])
def test_deep_clear_water_has_the_color_of_the_opaque_body(water_type, tmp_path):
    """Two independent ways to the same light: a path-traced volume, and the reflectance formula of Lee et al. of
    an opaque body. They differ by what that formula averages over (the sun's height, how backscattering depends
    on direction, three channels for a spectrum): its authors give 10 to 20 %; 25 % is allowed, for the channels
    that matter. (Not a river: in water that turbid the isotropic volume is half as bright.)
    """
    settings = MaterialSettings(water_type=water_type, see_through=True)
    sea = clear_sea(settings)
    add_bottom(400.0, 0.0)  # Cycles does not scatter in a volume that never ends
    sea.scene.cycles.volume_bounces = 12
    picture = sea.render_cycles(tmp_path / "sea.exr", samples=256, bounces=12).mean(axis=0)
    sine = math.sin(math.radians(SUN_ELEVATION))
    truth = np.array(water_color(settings)[:3]) * SUN_IRRADIANCE * sine / math.pi
    matters = truth > 0.2 * truth.max()
    assert picture[matters] == pytest.approx(truth[matters], rel=0.25)


def test_switching_back_gives_the_opaque_material_again(tmp_path):
    """Links, values and the artist's own nodes stay with their sockets through both exchanges."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material = ensure_material("Ocean", MaterialSettings(roughness=0.5))
    tree = material.node_tree
    value = tree.nodes.new("ShaderNodeValue")
    tree.links.new(value.outputs[0], tree.nodes[NODE_NAME].inputs["Glitter Strength"])
    tree.nodes[NODE_NAME].inputs["Tint"].default_value = (0.1, 0.2, 0.3, 1.0)
    for see_through in (True, False):
        assert ensure_material("Ocean", MaterialSettings(roughness=0.5, see_through=see_through)) == material
        inputs = tree.nodes[NODE_NAME].inputs
        assert inputs["Roughness"].default_value == 0.5
        assert tuple(inputs["Tint"].default_value)[:3] == pytest.approx((0.1, 0.2, 0.3))
        assert inputs["Glitter Strength"].links[0].from_node == value
        assert inputs["Slope Variance"].is_linked
        for engine in ("Cycles", "EEVEE"):
            source = tree.nodes[f"Output {engine}"].inputs["Surface"].links[0].from_socket
            assert (source.node.name, source.name) == (NODE_NAME, engine)
        assert tree.nodes["Output Cycles"].inputs["Volume"].is_linked == see_through
    assert [material.name for material in bpy.data.materials] == ["Ocean"]
