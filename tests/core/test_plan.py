# SPDX-License-Identifier: GPL-3.0-or-later
"""What the plan turns on and off, and that its sentences hold the number that decided."""

import dataclasses
import functools
import itertools
import json

import numpy as np
import pytest

from ocean_lod_addon.core.column_blocks import POSITION, TANGENTS, VELOCITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.effects import AUTO, OFF, ON, Effects
from ocean_lod_addon.core.foam_settings import Foam
from ocean_lod_addon.core.framing import Framing
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.parameters import parameters_of
from ocean_lod_addon.core.plan import VISIBLE_PIXELS, Facts, Settings, decide, effective, lost_slope_variance
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.shot_fit import ShotNeeds
from ocean_lod_addon.core.waves import WaveSet

NEAR = ShotNeeds(nearest=5.0, pixel_angle=1e-3, height=3.0)
FROM_SPACE = ShotNeeds(nearest=400e3, pixel_angle=1e-3, height=400e3)
SETTINGS = Settings(Sea(wave_count=32), Grid(), Framing(), MaterialSettings(), Ripples(), Foam(), Effects())
CALM = dataclasses.replace(SETTINGS, sea=Sea(systems=(WaveSystem(wind_speed=0.0),)))


waves_of = functools.cache(discretise)


def plan_of(settings=SETTINGS, **facts):
    waves = waves_of(settings.sea, settings.grid.shortest_wavelength)
    return decide(Facts(**({"camera": NEAR} | facts)), settings, waves)


def changed(**effects):
    return dataclasses.replace(SETTINGS, effects=Effects(**effects))


def why(plan, effect):
    return next(decision.why for decision in plan.decisions if decision.effect == effect)


def test_every_effect_is_decided_once_and_in_a_sentence():
    plan = plan_of()
    assert [decision.effect for decision in plan.decisions] == list(parameters_of(Effects))
    assert all(decision.why[0].isupper() for decision in plan.decisions)


def test_nothing_is_computed_that_only_space_can_not_see():
    """From 400 km up a pixel of 1 mrad is 400 m wide: no wave moves, ripples and normals are roughness."""
    wide = dataclasses.replace(SETTINGS, grid=Grid(levels=20))
    plan = plan_of(wide, camera=FROM_SPACE)
    assert not plan.on("horizontal_displacement")
    assert not plan.on("ripples")
    assert not plan.on("foam")
    assert plan.on("curved_earth")
    assert "pixels" in why(plan, "horizontal_displacement")


def test_sideways_motion_of_a_tenth_of_a_pixel_decides():
    """One wave with A = 0.1 m moves by 0.1 / sqrt(2) m rms: VISIBLE_PIXELS at 707.1 m with pixels of 1 mrad."""
    wave = WaveSet([0.1], [1.0], [3.1], [0.0], [0.0], [1.0], [0])
    edge = 0.1 / np.sqrt(2.0) / 1e-3 / VISIBLE_PIXELS
    for distance, on in ((0.999 * edge, True), (1.001 * edge, False)):
        facts = Facts(camera=ShotNeeds(distance, 1e-3, 3.0))
        assert decide(facts, SETTINGS, wave).on("horizontal_displacement") == on


@pytest.mark.parametrize(
    ("facts", "on"),
    [
        ({"engine": "CYCLES", "shutter": 0.02}, True),
        ({"engine": "CYCLES", "shutter": 0.0}, False),
        ({"engine": "EEVEE", "shutter": 0.02}, False),
        ({"engine": "CYCLES", "shutter": 0.02, "final": False}, False),
        ({"engine": "CYCLES", "shutter": 4.0}, False),
    ],
)
def test_velocity_is_for_cycles_blur_while_paths_are_straight(facts, on):
    plan = plan_of(camera=ShotNeeds(20.0, 1e-3, 3.0), **facts)
    assert plan.on("velocity") == on
    assert (VELOCITY in plan.blocks) == ("velocity" in plan.attributes) == on


def test_normals_of_the_mesh_lose_what_the_plan_says():
    """Faces of a height field by central differences: rms slope of one wave over k A / sqrt(2), squared."""
    k, h = 2.0 * np.pi / 4.0, 0.5
    wave = WaveSet([0.01], [k], [4.0], [0.0], [0.0], [0.0], [0])
    x = np.arange(0.0, 40.0, h)
    left, right = (surface_points(wave, x + step, 0.0 * x, 0.0).position[:, 2] for step in (-h, h))
    seen = np.mean(((right - left) / (2.0 * h)) ** 2) / (0.5 * (k * 0.01) ** 2)
    assert lost_slope_variance(h, wave) == pytest.approx(1.0 - seen, rel=1e-9)


def test_a_calm_sea_seen_by_nobody_computes_next_to_nothing():
    plan = plan_of(CALM, sees_water=False)
    assert plan.tiles == "none"
    assert plan.blocks == ()
    assert plan.attributes == ()
    assert [decision.effect for decision in plan.decisions if decision.on] == ["curved_earth"]
    assert plan_of(CALM, sees_water=False, final=False).tiles == "all"


def test_seen_in_reflections_only_shading_is_plain():
    plan = plan_of(visible_to_camera=False)
    assert plan.tiles == "all", "what a mirror shows may lie outside the frame"
    assert not plan.on("analytic_normals")
    assert not plan.on("ripples")
    assert plan.on("horizontal_displacement")
    assert plan.blocks == (POSITION,)


def test_an_ocean_that_no_ray_sees_is_not_moved():
    hidden = {"visible_to_camera": False, "visible_to_light": False}
    assert plan_of(**hidden).tiles == "all", "its shadow is seen"
    assert plan_of(**hidden, casts_shadows=False).tiles == "none"
    assert plan_of(**hidden, casts_shadows=False).columns == 0


def test_with_another_material_the_water_is_not_made_but_foam_is_an_attribute():
    plan = plan_of(shows_water=False)
    assert not any(plan.on(effect) for effect in ("ripples", "skewed_slopes", "see_through"))
    assert plan.on("foam")
    assert "not linked" in why(plan, "ripples")


def test_a_whitecap_between_the_samples_of_a_pixel_is_noise():
    """Half a pixel wide it covers a quarter of one: four samples find it, three may not, and it is too few to mean
    anything: 1 % of the sea hides 0.4 %, half a step of 255."""
    distance = 2.0 * 2.6 / 1e-3
    assert plan_of(camera=ShotNeeds(distance, 1e-3, 3.0), samples=5).on("foam")
    assert not plan_of(camera=ShotNeeds(distance, 1e-3, 3.0), samples=3).on("foam")


@pytest.mark.parametrize("effect", parameters_of(Effects))
def test_off_is_off(effect):
    everything = dict.fromkeys(parameters_of(Effects), ON)
    assert plan_of(changed(**everything), engine="EEVEE").on(effect)
    assert not plan_of(changed(**everything | {effect: OFF}), engine="EEVEE").on(effect)


def test_on_is_on_even_where_it_does_not_show():
    everything = changed(**dict.fromkeys(parameters_of(Effects), ON))
    plan = plan_of(everything, camera=FROM_SPACE, engine="EEVEE")
    assert all(decision.on for decision in plan.decisions)
    assert "Auto would not" in why(plan, "horizontal_displacement")
    assert plan.blocks == (POSITION, TANGENTS, VELOCITY)


def test_gusts_blow_where_they_are_asked_for_and_there_is_wind():
    asked = dataclasses.replace(SETTINGS, ripples=Ripples(gusts=True))
    assert not plan_of().on("gusts")
    assert plan_of(asked).on("gusts")
    calm = dataclasses.replace(asked, sea=Sea(systems=(WaveSystem(wind_speed=0.0),)))
    assert not plan_of(calm).on("gusts")


@pytest.mark.parametrize(("wind", "on"), [(3.9, False), (6.0, True)])
def test_foam_needs_waves_that_break(wind, on):
    sea = Sea(systems=(WaveSystem(wind_speed=wind),), wave_count=32)
    for word in (AUTO, ON):
        assert plan_of(dataclasses.replace(changed(foam=word), sea=sea)).on("foam") == on


def test_foam_that_changes_no_pixel_is_off():
    """A whitecap of 2.6 m, half a wave a sixteenth as long as the peak's 83 m at 10 m/s, of reflectance 0.55:

    1 of 255 steps where it covers 1 / (0.55 x 255) of a pixel, 31 m wide.
    """
    edge = 2.6 * np.sqrt(0.55 * 255.0) / 1e-3
    assert plan_of(camera=ShotNeeds(0.8 * edge, 1e-3, 3.0), samples=1000).on("foam")
    assert not plan_of(camera=ShotNeeds(1.2 * edge, 1e-3, 3.0), samples=1000).on("foam")
    assert "255 steps" in why(plan_of(), "foam")


def test_what_can_not_be_is_not_turned_on():
    """No skew in Cycles' closure, no ripples of kind off."""
    off = dataclasses.replace(
        changed(skewed_slopes=ON, ripples=ON), ripples=Ripples(kind="off")
    )
    plan = plan_of(off)
    assert not plan.on("skewed_slopes")
    assert not plan.on("ripples")


def test_every_pair_of_choices_gives_a_plan_whose_parts_agree():
    names = list(parameters_of(Effects))
    for (first, second), (a, b) in itertools.product(
        itertools.combinations(names, 2), itertools.product((AUTO, ON, OFF), repeat=2)
    ):
        settings = changed(**{first: a, second: b})
        plan = plan_of(settings, engine="EEVEE")
        foam, ripples = plan.on("foam"), plan.on("ripples")
        amplitudes = sum(name.startswith("ocean_ripple_amplitude_") for name in plan.attributes)
        assert (amplitudes > 0) == (plan.images > 0) == ripples
        looked_up = 2 * foam + (foam or ripples) + amplitudes + plan.on("gusts")
        assert len(plan.attributes) == len(plan.blocks) - 1 + looked_up
        assert plan.nodes == ("Ocean LOD Water", *["Ocean LOD Ripples"] * ripples, *["Ocean LOD Foam"] * foam)
        assert plan.columns == sum(block.columns for block in plan.blocks) + 16 * foam
        used = effective(settings, plan)
        assert (used.sea.choppiness > 0.0) == plan.on("horizontal_displacement")
        assert used.sea.finite_depth == plan.on("finite_depth")
        assert used.framing.curved_earth == plan.on("curved_earth")
        assert used.material.see_through == plan.on("see_through")
        assert used.material.skewed_slopes == plan.on("skewed_slopes")
        assert (used.ripples.kind != "off") == plan.on("ripples")
        assert used.ripples.gusts == plan.on("gusts")
        assert (used.foam is not None) == foam


def test_a_plan_becomes_json_whatever_decides():
    """Numbers of NumPy decide some effects; JSON knows none of them."""
    for settings in (SETTINGS, CALM):
        for facts in ({}, {"camera": None}, {"camera": FROM_SPACE}, {"sees_water": False}):
            plan = plan_of(settings, **facts).to_json()
            assert json.loads(json.dumps(plan)) == plan


def test_the_plan_depends_on_its_arguments_alone():
    assert plan_of() == plan_of()
