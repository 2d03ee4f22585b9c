# SPDX-License-Identifier: GPL-3.0-or-later
"""Preset files: the built-in ones are calibrated, and any preset survives being written and read."""

import dataclasses
import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ocean_lod_addon.core import presets
from ocean_lod_addon.core.beaufort import beaufort_force, typical_wind
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.errors import OceanError
from ocean_lod_addon.core.foam_settings import Foam
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.parameters import Choice, Integer, Number, Switch, parameters_of
from ocean_lod_addon.core.presets import Preset
from ocean_lod_addon.core.readback import theoretical_statistics, wind_axis
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.shot import Shot

LOOKS = {
    "calm",
    "moderate",
    "storm",
    "long_atlantic_swell",
    "fetch_limited_lake",
    "north_sea_storm",
    "tropical_trade_wind",
    "swell_crossing_wind_sea",
    "shallow_beach_approach",
}
BEAUFORT = [f"beaufort_{number:02d}" for number in range(13)]

WMO_PROBABLE_HEIGHTS = (0.0, 0.1, 0.2, 0.6, 1.0, 2.0, 3.0, 4.0, 5.5, 7.0, 9.0, 11.5, 14.0)
"""m, in the open sea, of the World Meteorological Organization's table."""


def statistics(name):
    sea = presets.load(name).sea
    return theoretical_statistics(sea, wind_axis(sea))


def test_what_comes_with_the_extension():
    assert set(presets.names()) == LOOKS | set(BEAUFORT)


@pytest.mark.parametrize("name", presets.names())
def test_a_preset_explains_itself_and_makes_waves(name):
    """Truth: a title, a sentence without a full stop (Blender's rule for tooltips), and finite waves."""
    preset = presets.load(name)
    assert preset.title
    assert len(preset.description) > 20
    assert not preset.description.endswith(".")
    waves = discretise(preset.sea, 0.4)
    assert np.isfinite(waves.amplitude).all()
    assert (len(waves) == 0) == (name == "beaufort_00")


@pytest.mark.parametrize("number", range(13))
def test_beaufort_presets_have_their_force(number):
    """Truth: the middle wind of the force, v = 0.836 B^1.5, to the 0.05 m/s that it is rounded to."""
    preset = presets.load(BEAUFORT[number])
    (system,) = preset.sea.systems
    assert system.wind_speed == pytest.approx(typical_wind(number), abs=0.05 + 1e-9)
    force = beaufort_force(system.wind_speed)
    assert force.number == number
    assert preset.title == f"Beaufort {number}: {force.name}"


@pytest.mark.parametrize("number", range(3, 13))
def test_beaufort_presets_have_the_waves_of_their_force(number):
    """Truth: WMO's probable wave height. Tolerance: half the table's last digit, 0.05 m, or 2 %.

    Below force 3 the table gives waves that no spectrum of that wind has: what a ship sees of older waves.
    """
    expected = WMO_PROBABLE_HEIGHTS[number]
    assert statistics(BEAUFORT[number]).significant_wave_height == pytest.approx(expected, rel=0.02, abs=0.05)


@pytest.mark.parametrize(
    ("name", "height", "period"),
    [
        ("long_atlantic_swell", 2.5, 15.0),
        ("fetch_limited_lake", 0.3, 2.0),
        ("north_sea_storm", 6.4, 11.0),
        ("tropical_trade_wind", 1.9, 10.0),
        ("shallow_beach_approach", 0.8, 9.0),
    ],
)
def test_looks_are_what_their_names_say(name, height, period):
    """Truth: heights and peak periods that buoys of such places report, to one digit (10 %)."""
    found = statistics(name)
    assert found.significant_wave_height == pytest.approx(height, rel=0.1)
    assert found.peak_period == pytest.approx(period, rel=0.1)


def test_a_crossing_sea_has_two_directions():
    wind, swell = presets.load("swell_crossing_wind_sea").sea.systems
    assert abs(math.degrees(wind.direction - swell.direction)) == pytest.approx(90.0)


@pytest.mark.parametrize("name", presets.names())
def test_built_in_presets_survive_a_round_trip(name, tmp_path):
    """Truth: written with all keys and read again, the preset is equal."""
    preset = presets.load(name)
    path = tmp_path / "copy.json"
    presets.write(preset, path)
    assert presets.read(path) == preset
    assert [path.name for path in tmp_path.iterdir()] == ["copy.json"], "no other file is left behind"


def values_of(parameter):
    """Any value that a setting allows; angles as degrees with nine decimals, which is what files keep."""
    match parameter:
        case Number(unit="rad"):
            low, high = math.degrees(parameter.minimum), math.degrees(parameter.maximum)
            return st.floats(low, high).map(lambda degrees: math.radians(round(degrees, 6)))
        case Number():
            return st.floats(parameter.minimum, parameter.maximum)
        case Integer():
            return st.integers(parameter.minimum, parameter.maximum)
        case Choice():
            return st.sampled_from([option.key for option in parameter.options])
        case Switch():
            return st.booleans()
    return st.text(max_size=30).filter(lambda text: text.isprintable())


def settings_of(cls, **others):
    fields = {name: values_of(parameter) for name, parameter in parameters_of(cls).items()}
    return st.builds(cls, **fields, **others)


PRESETS = st.builds(
    Preset,
    title=st.text(max_size=20).filter(str.isprintable),
    description=st.text(max_size=50).filter(str.isprintable),
    sea=settings_of(Sea, systems=st.lists(settings_of(WaveSystem), min_size=1, max_size=3).map(tuple)),
    material=settings_of(MaterialSettings),
    foam=settings_of(Foam).map(lambda foam: dataclasses.replace(foam, memory_steps=Foam().memory_steps)),
    shot=settings_of(Shot),
)


@settings(max_examples=60, deadline=None)
@given(PRESETS)
def test_any_preset_survives_a_round_trip(preset):
    assert presets.parse(presets.to_text(preset), "test") == preset


def test_only_what_differs_needs_to_be_in_a_file():
    """Truth: the schema's version alone is the default sea; one key changes one setting."""
    assert presets.parse('{"schema_version": 1}', "test") == Preset()
    text = '{"schema_version": 1, "sea": {"systems": [{"direction_deg": 45}]}}'
    system = dataclasses.replace(WaveSystem(), direction=math.radians(45.0))
    assert presets.parse(text, "test") == Preset(sea=Sea((system,)))


def test_foam_is_a_look_whose_effort_is_not_in_files():
    text = '{"schema_version": 1, "foam": {"coverage": 2, "decay_time_s": 5, "grain_m": 1, "reflectance": 0.5}}'
    preset = presets.parse(text, "test")
    assert preset.foam == Foam(coverage=2.0, decay_time=5.0, grain=1.0, reflectance=0.5)
    assert json.loads(presets.to_text(preset))["foam"] == json.loads(text)["foam"]
    with pytest.raises(OceanError, match=r"mine: foam: unknown key 'memory_steps', allowed is coverage, "):
        presets.parse('{"schema_version": 1, "foam": {"memory_steps": 3}}', "mine")
    with pytest.raises(OceanError, match=r"mine: foam: decay_time_s is -1"):
        presets.parse('{"schema_version": 1, "foam": {"decay_time_s": -1}}', "mine")


def test_files_say_all_settings_in_units_people_use():
    content = json.loads(presets.to_text(Preset(sea=Sea((WaveSystem(direction=math.radians(45.0)),)))))
    assert content["sea"]["systems"][0]["direction_deg"] == 45.0
    assert "loop_period" not in str(content)


def test_a_byte_order_mark_is_no_error(tmp_path):
    path = tmp_path / "notepad.json"
    path.write_text('{"schema_version": 1}', encoding="utf-8-sig")
    assert presets.read(path) == Preset()


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        '{"schema_version": 1, "sea": {"wave_count": ' + "9" * 5000 + "}}",
        '{"schema_version": 1, "sea": {"depth_m": 1e999}}',
        '{"schema_version": 1, "sea": {"systems": [[]]}}',
        '{"schema_version": 1, "title": 3}',
        '{"schema_version": 1, "material": []}',
        '{"schema_version": 1, "sea": {"loop_period_s": 10}}',
        '{"schema_version": "1"}',
    ],
)
def test_hostile_files_are_one_clear_line(text):
    with pytest.raises(OceanError, match=r"^mine\.json: ") as caught:
        presets.parse(text, "mine.json")
    assert "\n" not in str(caught.value)


def test_a_file_that_can_not_be_read_or_written_is_named(tmp_path):
    with pytest.raises(OceanError, match=r"missing\.json: can not be read"):
        presets.read(tmp_path / "missing.json")
    (tmp_path / "binary.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(OceanError, match=r"binary\.json: can not be read"):
        presets.read(tmp_path / "binary.json")
    with pytest.raises(OceanError, match="can not be written"):
        presets.write(Preset(), tmp_path / "missing folder" / "a.json")


@pytest.mark.parametrize("name", ["Storm 2", "große See", "sea-1.5_b", "嵐"])
def test_names_that_files_can_have(name, tmp_path):
    presets.check_name(name)
    presets.write(Preset(title=name), tmp_path / f"{name}.json")
    assert presets.names(tmp_path) == [name]
    assert presets.load(name, tmp_path).title == name


@pytest.mark.parametrize(
    "name", ["", " ", "a/b", "..", "a\\b", "a:b", "nul", "COM1.x", " a", "a.", "a\nb", "a" * 61]
)
def test_names_that_files_can_not_have(name):
    with pytest.raises(OceanError, match=r"preset name is .*allowed is 1 to 60 letters"):
        presets.check_name(name)


def test_another_seed_is_another_sea_of_the_same_kind():
    sea = Sea(seed=2**31 - 1)
    assert presets.with_seed(sea, 0) == sea
    assert presets.with_seed(sea, 1) == dataclasses.replace(sea, seed=0)
