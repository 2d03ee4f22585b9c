# SPDX-License-Identifier: GPL-3.0-or-later
"""The same sea in Cycles and in EEVEE: sky, body and sun, each by the means of its engine."""

import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.nodes.material import ensure_material, set_sun
from ocean_lod_addon.nodes.reflection_group import HAS_EXACT_FRESNEL
from ocean_lod_addon.nodes.scene_sun import claim_sun, scene_sun
from tests.render.flat_sea import FlatSea, direction, slope_tensor

pytestmark = pytest.mark.render

TENSORS = [slope_tensor(sigma, sigma) for sigma in (0.1, 0.15, 0.2, 0.25)]
TENSORS += [slope_tensor(0.18, 0.15, 0), slope_tensor(0.18, 0.15, 90), slope_tensor(0.2, 0.13, 40)]

MEAN_RADIANCE_TOLERANCE = 0.15
"""What the engines may differ by over a glitter path, and over the sky's reflection."""

SCHLICK_TOLERANCE = 0.25
"""Before Blender 5 the closure has Schlick's Fresnel, up to 23 % off; the formula has the exact one everywhere."""


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


def test_sky_and_body_agree(sea, tmp_path):
    """Under a uniform sky: the reflected share of the fit against what Cycles integrates."""
    sea.set_sky(1.0)
    sea.look_along_x(15.0)
    cycles = sea.render_cycles(tmp_path / "sea.exr", samples=256, bounces=4)
    eevee = sea.render_eevee(tmp_path / "sea.exr", samples=2)
    tolerance = MEAN_RADIANCE_TOLERANCE if HAS_EXACT_FRESNEL else SCHLICK_TOLERANCE
    assert eevee == pytest.approx(cycles, rel=tolerance)


def test_the_glitter_path_of_a_low_sun_agrees_and_is_there_once(sea, tmp_path):
    """A Sun light that is not claimed adds its own round highlight to the path; claimed, the sun is there once."""
    elevation = 12.0
    sea.look_along_x(elevation)
    give_sun(sea, direction(elevation + 1.0, 3.0), 3.0)
    cycles = sea.render_cycles(tmp_path / "sea.exr", samples=64)
    twice = sea.render_eevee(tmp_path / "sea.exr", samples=2)
    claim_sun(sea.scene, MaterialSettings())
    once = sea.render_eevee(tmp_path / "sea.exr", samples=2)
    tolerance = MEAN_RADIANCE_TOLERANCE if HAS_EXACT_FRESNEL else SCHLICK_TOLERANCE
    assert once.mean() == pytest.approx(cycles.mean(), rel=MEAN_RADIANCE_TOLERANCE)
    assert once == pytest.approx(cycles, rel=tolerance)
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
