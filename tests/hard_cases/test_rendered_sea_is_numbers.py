# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the sea in both engines hold numbers only: no NaN, no infinity, no spike."""

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.nodes.material import ensure_material, set_sun
from ocean_lod_addon.nodes.scene_sun import scene_sun
from tests.render.flat_sea import FlatSea, direction, slope_tensor

pytestmark = pytest.mark.render

TENSORS = [(0.0, 0.0, 0.0), (1e-30, 0.0, 0.0), (1.4e-6, 1.4e-6, 0.0), (-1e-6, 2e-6, 0.0), (3.0, 3.0, 0.0)]
TENSORS += [slope_tensor(0.3, 3e-4, turn) for turn in (0, 90, 37)] + [slope_tensor(0.18, 0.15, 20)]
"""Calm, slightly negative as rounding leaves it, absurd, 1000:1, and a sea."""

ANGLES = (
    (0.05, 0.01, 0.0),
    (0.05, 3.0, 0.5),
    (3.0, 3.0, 2.0),
    (30.0, -0.5, 0.0),
    (90.0, 90.0, 0.0),
)
"""Elevation of the view, elevation and azimuth of the sun, degrees."""


def pictures(sea, tmp_path, with_eevee):
    """The picture of each pair of view and sun in each engine, and which it is. EEVEE always shows the formula."""
    (material,) = sea.sea.data.materials
    sea.set_sky(1.0)
    renders = (sea.render_cycles, sea.render_eevee) if with_eevee else (sea.render_cycles,)
    for view, elevation, azimuth in ANGLES:
        sea.look_along_x(view)
        sea.shine(direction(elevation, azimuth))
        sea.sun.data.use_shadow = False
        bpy.context.view_layer.update()
        set_sun(material, scene_sun(sea.scene))
        for render in renders:
            yield render(tmp_path / "sea.exr"), f"{render.__name__}, view {view}, sun {elevation} {azimuth}"


@pytest.mark.parametrize("sun_model", ["closure", "formula"])
def test_flat_seas_of_any_roughness(sun_model, tmp_path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    sea = FlatSea(ensure_material("Ocean", MaterialSettings(sun_model=sun_model)), TENSORS)
    for picture, where in pictures(sea, tmp_path, with_eevee=sun_model == "formula"):
        assert np.isfinite(picture).all(), where
        assert (picture >= 0.0).all(), where


@pytest.mark.parametrize("engine", ["cycles", "eevee"])
def test_a_folding_storm_at_grazing_light(engine, tmp_path):
    """A low camera in a storm with choppiness 2: folds, overhangs and zero-area cells in frame."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    registered = hasattr(bpy.types.Object, "ocean_lod")
    if not registered:
        ocean_lod_addon.register()
    bpy.ops.mesh.ocean_lod_add(preset="storm", cells=64, levels=5, cell_size=0.1)
    ob = bpy.context.object
    ob.ocean_lod.sea.choppiness = 2.0
    (material,) = ob.data.materials
    sea = FlatSea(material, [(0.02, 0.02, 0.0)])
    sea.sea.hide_render = True
    sea.set_sky(1.0)
    camera = sea.camera
    camera.data.type, camera.data.clip_end = "PERSP", 1e5
    render = sea.scene.render
    render.resolution_x, render.resolution_y = 48, 27
    for height, sun in ((1.0, 1.0), (30.0, 8.0)):
        camera.location, camera.rotation_euler = (0.0, 0.0, height), (1.55, 0.0, -np.pi / 2)
        sea.shine(direction(sun, 5.0))
        sea.sun.data.use_shadow = False
        bpy.context.view_layer.update()
        set_sun(material, scene_sun(sea.scene))
        sea.scene.frame_set(int(height))
        pictures = sea.render_cycles if engine == "cycles" else sea.render_eevee
        picture = pictures(tmp_path / "sea.exr", samples=2)
        assert np.isfinite(picture).all()
        assert (picture >= 0.0).all()
        assert picture.max() < 1.0e3, "fireflies: sky 1, sun 1, lobes of at most some hundred per steradian"
    if not registered:
        ocean_lod_addon.unregister()
