# SPDX-License-Identifier: GPL-3.0-or-later
"""The same sea in Cycles and in EEVEE: sky, body and sun, each by the means of its engine."""

import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel
from ocean_lod_addon.core.optics.reflected_share import reflected_light_reference
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes
from ocean_lod_addon.nodes.material import ensure_material, set_sun
from ocean_lod_addon.nodes.scene_sun import claim_sun, scene_sun
from tests.render.fan_sea import FanSea
from tests.render.flat_sea import FlatSea, direction, slope_tensor
from tests.render.ross_reference import CLOSURE_FRESNEL, closure_excess, sky_share

pytestmark = pytest.mark.render

OPS = NumpyOps()

ROUGHNESSES = (0.05, 0.1, 0.15, 0.2, 0.25)
SLOPES = [GaussianSlopes(sigma, sigma) for sigma in ROUGHNESSES]

TENSORS = [slope_tensor(sigma, sigma) for sigma in (0.1, 0.15, 0.2, 0.25)]
TENSORS += [slope_tensor(0.18, 0.15, 0), slope_tensor(0.18, 0.15, 90), slope_tensor(0.2, 0.13, 40)]

MEAN_RADIANCE_TOLERANCE = 0.15
"""What the engines may differ by over a glitter path, and over the sky's reflection."""


@pytest.fixture
def sea():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return FlatSea(ensure_material("Ocean", MaterialSettings()), TENSORS)


def give_sun(sea, to_sun, irradiance):
    """A Sun light of the real sun's size, which the material knows of."""
    sea.shine(to_sun, irradiance)
    sea.sun.data.angle = math.radians(0.53)
    sea.sun.data.use_shadow = False  # nothing casts one, and EEVEE takes its time over them
    bpy.context.view_layer.update()
    (material,) = sea.sea.data.materials
    set_sun(material, scene_sun(sea.scene))


def sky_shares(to_viewer):
    """What each strip reflects of a uniform sky: by this Blender's closure, and with the exact Fresnel."""
    formulas = {"closure": CLOSURE_FRESNEL, "exact": fresnel.exact}
    return {
        name: np.array([sky_share(to_viewer, tensor, formula) for tensor in TENSORS])
        for name, formula in formulas.items()
    }


@pytest.mark.parametrize(("falloff", "tolerance"), [(None, 0.07), (0.8, 0.15)])
def test_eevee_reflects_the_sky_as_the_facets_do(falloff, tolerance, tmp_path):
    """Truth: the quadrature of the BRDF. Under a uniform sky the fit of the share shows (6 %), and 1 % of EEVEE's
    probe; under one that falls to a fifth from horizon to zenith, the direction that EEVEE looks in, too.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    black = MaterialSettings(tint_red=0.0, tint_green=0.0, tint_blue=0.0)
    sea = FanSea(ensure_material("Ocean", black), [slope_tensor(sigma, sigma) for sigma in ROUGHNESSES])
    sea.set_sky(1.0, falloff)
    eevee = sea.picture_of_eevee(tmp_path / "sea.exr", samples=4)[::4, :, 1]
    lights = [
        [reflected_light_reference(OPS, tuple(view), slopes, WATER_REFRACTIVE_INDEX) for view, slopes in row]
        for row in (zip(views, SLOPES, strict=True) for views in sea.to_viewer[::4])
    ]
    fall = falloff or 0.0
    truth = np.array([[share * (1.0 - fall * to_light[2]) for share, to_light in row] for row in lights])
    assert eevee == pytest.approx(truth, rel=tolerance)
    assert np.mean(eevee / truth) == pytest.approx(1.0, abs=tolerance / 3.0)


def test_sky_and_body_agree(sea, tmp_path):
    """Under a uniform sky, which shows the reflected share and what it leaves to the water.

    What Schlick's Fresnel reflects more than the exact one, in Cycles before Blender 5, comes from quadrature.
    """
    sea.set_sky(1.0)
    shares = sky_shares(sea.look_along_x(15.0))
    cycles = sea.render_cycles(tmp_path / "sea.exr", samples=256, bounces=4)
    eevee = sea.render_eevee(tmp_path / "sea.exr", samples=4)
    more = shares["closure"] - shares["exact"]
    assert eevee + more[:, np.newaxis] == pytest.approx(cycles, rel=0.06)


def test_a_bright_physical_sky_is_not_cut_off(sea, tmp_path):
    """Its radiance passes 10, where EEVEE by default cuts off what is reflected: half of this sea's light.

    Schlick's Fresnel, in Cycles before Blender 5, is allowed for as under a uniform sky.
    """
    sea.set_physical_sky(40.0)
    shares = sky_shares(sea.look_along_x(5.0))
    claim_sun(sea.scene, MaterialSettings())
    cycles = sea.render_cycles(tmp_path / "sea.exr", samples=256).mean(axis=1)
    eevee = sea.render_eevee(tmp_path / "sea.exr", samples=4).mean(axis=1)
    assert cycles.max() > 1.0
    assert eevee * shares["closure"] / shares["exact"] == pytest.approx(cycles, rel=MEAN_RADIANCE_TOLERANCE)


def test_the_glitter_path_of_a_low_sun_agrees_and_is_there_once(sea, tmp_path):
    """A Sun light that is not claimed adds its own round highlight to the path; claimed, the sun is there once.

    1 %: Cycles' fit to Smith's Lambda, and EEVEE's half floats.
    """
    elevation = 12.0
    to_viewer, to_sun = sea.look_along_x(elevation), direction(elevation + 1.0, 3.0)
    give_sun(sea, to_sun, 3.0)
    cycles = sea.render_cycles(tmp_path / "sea.exr", samples=64)
    twice = sea.render_eevee(tmp_path / "sea.exr", samples=2)
    claim_sun(sea.scene, MaterialSettings())
    once = sea.render_eevee(tmp_path / "sea.exr", samples=2)
    assert once * closure_excess(to_viewer, to_sun) == pytest.approx(cycles, rel=0.01)
    highlight = (twice - once) / once
    assert np.all(highlight > 0.15)


def test_glitter_strength_scales_the_sun_alone_in_cycles(sea, tmp_path):
    """Truth: radiance is linear in the strength, with the closure's own sun at 1 and none of it at 0.

    2 %: the closure's Lambda and its Fresnel differ from the formula's by less at 45 degrees.
    """
    sea.look_along_x(45.0)
    give_sun(sea, direction(50.0, 5.0), 3.0)
    pictures = {}
    for strength in (0.0, 0.5, 1.0, 2.0):
        settings = MaterialSettings(tint_red=0.0, tint_green=0.0, tint_blue=0.0, glitter_strength=strength)
        ensure_material("Ocean", settings)
        pictures[strength] = sea.render_cycles(tmp_path / "sea.exr", samples=64)
    full = pictures[1.0]
    for strength, picture in pictures.items():
        assert picture == pytest.approx(strength * full, abs=0.02 * full.max())
