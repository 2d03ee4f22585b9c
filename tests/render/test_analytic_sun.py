# SPDX-License-Identifier: GPL-3.0-or-later
"""The analytic sun group is the Ross BRDF: to float32 in Cycles, to EEVEE's half floats there."""

import itertools
import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.sun import Sun
from ocean_lod_addon.nodes.material import NODE_NAME, set_sun, set_wind
from tests.render.fan_sea import FanSea
from tests.render.flat_sea import FlatSea, direction, slope_tensor
from tests.render.ross_reference import lobe_peak, skewed_sun_radiance, sun_radiance
from tests.render.test_closure_reflection import IN_LOBE, SUN_OFFSETS, TENSORS, black_water

pytestmark = pytest.mark.render

CYCLES_TOLERANCE = 1e-3
"""float32 through 120 nodes, the exponent of the slope density magnifying what is left of 1e-7."""

EEVEE_TOLERANCE = 5e-3
"""EEVEE keeps colours in half floats, 2^-11 = 0.0005 each, and a few of them."""

IRRADIANCE = 0.5
"""Keeps the brightest pixel (sigma 0.02: 1/(8 pi 0.02^2) = 100 times F) far below the largest half float."""


def check_cycles(sea, path, elevation, offset):
    """Compare every strip in the lobe with the reference for one place of viewer and sun; how many they were."""
    (material,) = sea.sea.data.materials
    higher, aside = offset
    to_viewer = sea.look_along_x(elevation)
    to_sun = direction(min(max(elevation + higher, 0.5), 90.0), aside)
    set_sun(material, Sun(tuple(to_sun), (IRRADIANCE, 0.5 * IRRADIANCE, 0.0), 0.0))
    picture = sea.render_cycles(path) / IRRADIANCE
    truth = np.array([sun_radiance(to_viewer, to_sun, tensor) for tensor in TENSORS])
    inside = truth > IN_LOBE * np.array([lobe_peak(to_viewer, tensor) for tensor in TENSORS])
    ratio = picture[inside, 0] / truth[inside]
    message = f"elevation {elevation}, sun {higher:+} {aside:+}: {ratio}"
    assert np.all(np.abs(ratio - 1.0) < CYCLES_TOLERANCE), message
    assert picture[inside, 1] == pytest.approx(0.5 * picture[inside, 0], rel=CYCLES_TOLERANCE)
    assert np.all(picture[:, 2] == 0.0)
    return int(inside.sum())


def test_cycles_shows_the_formula(tmp_path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    sea = FlatSea(black_water(sun_model="formula"), TENSORS)
    places = itertools.product((90.0, 75.0, 60.0, 45.0, 30.0, 20.0, 12.0, 7.0, 4.0, 2.0, 1.0), SUN_OFFSETS)
    compared = [check_cycles(sea, tmp_path / "sea.exr", *place) for place in places]
    assert sum(compared) > 300  # of 44 places times 18 strips; the others lie outside their lobe


def test_slopes_of_a_bumped_normal_add_to_the_unresolved_ones(tmp_path):
    """Truth: the Ross BRDF with a resolved slope (THEORY section 6), which is not that of a turned frame."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material = black_water(sun_model="formula")
    sea = FlatSea(material, TENSORS)
    to_viewer, to_sun = sea.look_along_x(25.0), direction(35.0, 8.0)
    set_sun(material, Sun(tuple(to_sun), (1.0, 1.0, 1.0), 0.0))
    normal = np.array([-0.08, 0.05, 1.0]) / np.linalg.norm([-0.08, 0.05, 1.0])
    source = material.node_tree.nodes.new("ShaderNodeCombineXYZ")
    for socket, value in zip(source.inputs, normal, strict=True):
        socket.default_value = value
    material.node_tree.links.new(source.outputs[0], material.node_tree.nodes[NODE_NAME].inputs["Normal"])
    picture = sea.render_cycles(tmp_path / "sea.exr")[:, 0]
    truth = np.array([sun_radiance(to_viewer, to_sun, tensor, normal=normal) for tensor in TENSORS])
    flat = np.array([sun_radiance(to_viewer, to_sun, tensor) for tensor in TENSORS])
    bright = truth > 1e-3 * truth.max()
    assert picture[bright] == pytest.approx(truth[bright], rel=CYCLES_TOLERANCE)
    assert np.all(np.abs(truth / flat - 1.0)[bright] > 0.02)


@pytest.mark.parametrize(("wind_degrees", "turned"), [(0.0, False), (35.0, False), (35.0, True)])
def test_skewed_slopes_follow_the_wind_and_the_object(wind_degrees, turned, tmp_path):
    """Truth: the Gram-Charlier BRDF in float64; turned, the object stands the other way and its wind with it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material = black_water(sun_model="formula", skewed_slopes=True)
    tensors = [slope_tensor(0.2, 0.15, wind_degrees)] * 4
    sea = FlatSea(material, tensors)
    sea.sea.rotation_euler = (0.0, 0.0, math.pi if turned else 0.0)
    set_wind(material, 11.0, math.radians(wind_degrees))
    wind_direction = math.radians(wind_degrees + 180.0 * turned)
    skews = []
    for view_elevation, sun in itertools.product((60.0, 15.0), ((70.0, 0.0), (25.0, 5.0), (10.0, -20.0))):
        to_viewer, to_sun = sea.look_along_x(view_elevation), direction(*sun)
        set_sun(material, Sun(tuple(to_sun), (1.0, 1.0, 1.0), 0.0))
        picture = sea.render_cycles(tmp_path / "sea.exr")[:, 0]
        truth = skewed_sun_radiance(to_viewer, to_sun, tensors[0], 11.0, wind_direction)
        skews.append(truth / sun_radiance(to_viewer, to_sun, tensors[0]) - 1.0)
        assert picture == pytest.approx(truth, rel=CYCLES_TOLERANCE)
    assert max(map(abs, skews)) > 0.1  # so the test would see Gaussian slopes, or the wrong wind


@pytest.mark.parametrize(("sun", "compared"), [((2.0, 0.0), 600), ((50.0, -15.0), 1500)])
def test_eevee_shows_the_formula(sun, compared, tmp_path):
    """Every strip from 80 degrees above the horizon down to 1, for a sun on the horizon and a high one: one
    picture each, since EEVEE takes seconds to start."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material = black_water()
    sea, to_sun = FanSea(material, TENSORS), direction(*sun)
    set_sun(material, Sun(tuple(to_sun), (IRRADIANCE, 0.5 * IRRADIANCE, 0.0), 0.0))
    picture = sea.picture_of_eevee(tmp_path / "sea.exr") / IRRADIANCE
    truth, peak = (
        np.array([[radiance(*pixel) for pixel in zip(row, TENSORS, strict=True)] for row in sea.to_viewer])
        for radiance in (lambda view, tensor: sun_radiance(view, to_sun, tensor), lobe_peak)
    )
    inside = truth > IN_LOBE * peak
    assert inside.sum() > compared
    assert picture[inside, 0] == pytest.approx(truth[inside], rel=EEVEE_TOLERANCE)
    assert np.median(np.abs(picture[inside, 0] / truth[inside] - 1.0)) < CYCLES_TOLERANCE
    assert picture[inside, 1] == pytest.approx(0.5 * picture[inside, 0], rel=EEVEE_TOLERANCE)
    assert np.all(picture[:, :, 2] == 0.0)
