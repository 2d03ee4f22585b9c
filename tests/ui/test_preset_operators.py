# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets from the panel: what is saved loads back identically, and mistakes are one clear line."""

import dataclasses
import json

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core import presets
from ocean_lod_addon.core.foam_settings import Foam
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.parameters import Choice, Integer, Number, Switch, parameters_of
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.scene import mesh, properties
from ocean_lod_addon.ui import preset_library


@pytest.fixture(autouse=True)
def no_presets_of_the_user():
    """Each test begins and ends without presets of the user's own."""
    yield
    for name in preset_library.user_names():
        preset_library.remove(name)


def preset_of(ob, title="", description=""):
    return properties.read_preset(ob.ocean_lod, title, description)


def set_randomly(group, settings_class, random):
    """Give every setting a random value, as an artist's mouse would: any float32 in its range."""
    for name, parameter in parameters_of(settings_class).items():
        match parameter:
            case Number():
                low = max(parameter.minimum, -1e4)
                high = min(parameter.maximum, 1e4) if parameter.soft_maximum is None else parameter.soft_maximum
                setattr(group, name, random.uniform(low, high))
            case Integer():
                setattr(group, name, int(random.integers(parameter.minimum, min(parameter.maximum, 300) + 1)))
            case Choice():
                setattr(group, name, random.choice([option.key for option in parameter.options]))
            case Switch():
                setattr(group, name, bool(random.integers(2)))


def randomise(ob, seed):
    random = np.random.default_rng(seed)
    with properties.many_changes():
        sea = ob.ocean_lod.sea
        set_randomly(sea, Sea, random)
        sea.systems.clear()
        for number in range(random.integers(1, 4)):
            system = sea.systems.add()
            set_randomly(system, WaveSystem, random)
            system.name = f"Système {number} 🌊"
        set_randomly(ob.ocean_lod.material, MaterialSettings, random)
        effort = ob.ocean_lod.foam.memory_steps
        set_randomly(ob.ocean_lod.foam, Foam, random)
        ob.ocean_lod.foam.memory_steps = effort


def test_a_new_ocean_begins_with_the_first_choice(ocean):
    bpy.ops.mesh.ocean_lod_add(cells=16, levels=2)
    assert preset_of(bpy.context.object).sea == presets.load(preset_library.FIRST_CHOICE).sea


@pytest.mark.parametrize("name", presets.names())
def test_a_loaded_preset_reads_back_as_its_file(ocean, name):
    """Truth: numbers that people write survive Blender's float32 and its angles in radians, exactly."""
    assert bpy.ops.object.ocean_lod_load_preset(preset=name) == {"FINISHED"}
    preset = presets.load(name)
    read = preset_of(ocean)
    assert read.sea == preset.sea
    assert read.material == preset.material
    assert np.isfinite(mesh.read_positions(ocean.data)).all()


@pytest.mark.parametrize("seed", range(12))
def test_a_saved_preset_loads_back_identically(ocean, seed, tmp_path):
    """Truth: equal settings after save, another sea, load; and a second save gives the same bytes."""
    randomise(ocean, seed)
    before = preset_of(ocean, "Mine", "As I like it")
    saved = bpy.ops.object.ocean_lod_save_preset(name="Mine", description="As I like it")
    assert saved == {"FINISHED"}
    assert presets.read(preset_library.path_of("Mine")) == before
    bpy.ops.object.ocean_lod_load_preset(preset="calm")
    assert preset_of(ocean, "Mine", "As I like it") != before
    bpy.ops.object.ocean_lod_load_preset(preset="Mine")
    assert preset_of(ocean, "Mine", "As I like it") == before
    first = preset_library.path_of("Mine").read_bytes()
    bpy.ops.object.ocean_lod_save_preset(name="Mine", description="As I like it", overwrite=True)
    assert preset_library.path_of("Mine").read_bytes() == first


def test_files_hold_what_was_typed(ocean):
    """Truth: 45 degrees and 9.3 m/s are 45.0 and 9.3 in the file, not their float32 expansions."""
    system = ocean.ocean_lod.sea.systems[0]
    system.direction = np.radians(45.0)
    system.wind_speed = 9.3
    system.directional_cutoff = np.pi
    bpy.ops.object.ocean_lod_save_preset(name="Typed")
    (saved,) = json.loads(preset_library.path_of("Typed").read_text())["sea"]["systems"]
    assert (saved["direction_deg"], saved["wind_speed_m_s"], saved["directional_cutoff_deg"]) == (45.0, 9.3, 180.0)


def test_saved_presets_are_listed_with_the_built_in_ones(ocean):
    bpy.ops.object.ocean_lod_save_preset(name="Zuider Zee", description="Short and steep")
    items = preset_library.items(None, bpy.context)
    listed = {item[0]: item for item in items if item[0]}
    assert set(listed) == {*presets.names(), "Zuider Zee"}
    assert listed["Zuider Zee"][1:3] == ("Zuider Zee", "Short and steep")
    assert [item[1] for item in items if not item[0]] == ["Looks", "Beaufort Scale", "Yours"]
    numbers = [item[4] for item in items if item[0]]
    assert len(set(numbers)) == len(numbers)


def assert_refused(operator, line, **arguments):
    with pytest.raises(RuntimeError) as caught:
        operator("EXEC_DEFAULT", **arguments)
    text = str(caught.value).strip()
    assert line in text
    assert "Traceback" not in text
    assert len(text.splitlines()) == 1


def test_overwriting_needs_a_yes(ocean):
    save = bpy.ops.object.ocean_lod_save_preset
    save(name="Mine")
    first = preset_library.path_of("Mine").read_text()
    ocean.ocean_lod.sea.systems[0].wind_speed = 22.0
    assert_refused(save, "'Mine' exists: choose Overwrite, or another name", name="Mine")
    assert preset_library.path_of("Mine").read_text() == first
    assert save(name="Mine", overwrite=True) == {"FINISHED"}
    assert preset_library.load("Mine").sea.systems[0].wind_speed == 22.0
    ocean.ocean_lod.sea.systems[0].wind_speed = 23.0
    assert_refused(save, "exists", name="Mine")  # the yes of last time does not count


@pytest.mark.parametrize("overwrite", [False, True])
def test_built_in_presets_can_not_be_overwritten(ocean, overwrite):
    before = presets.load("storm")
    assert_refused(
        bpy.ops.object.ocean_lod_save_preset, "comes with the extension", name="storm", overwrite=overwrite
    )
    assert presets.load("storm") == before


@pytest.mark.parametrize("name", ["", "a/b", "..", "nul"])
def test_names_that_are_no_file_names_are_refused(ocean, name):
    assert_refused(bpy.ops.object.ocean_lod_save_preset, "preset name is", name=name)
    assert preset_library.user_names() == []


def test_a_preset_of_the_user_can_be_removed(ocean):
    remove = bpy.ops.object.ocean_lod_remove_preset
    assert not remove.poll()
    bpy.ops.object.ocean_lod_save_preset(name="Mine")
    assert remove.poll()
    assert remove("EXEC_DEFAULT", preset="Mine") == {"FINISHED"}
    assert preset_library.user_names() == []
    assert not preset_library.path_of("Mine").exists()


def test_a_broken_file_of_the_user_is_listed_with_its_error(ocean):
    """Truth: one bad file spoils neither the menu nor the ocean."""
    bpy.ops.object.ocean_lod_save_preset(name="Broken")
    preset_library.path_of("Broken").write_text('{"schema_version": 1, "sea": {"wave_count": 0}}')
    before = preset_of(ocean)
    listed = {item[0]: item[2] for item in preset_library.items(None, bpy.context)}
    assert "wave_count is 0, allowed is 1 to 4096" in listed["Broken"]
    assert_refused(bpy.ops.object.ocean_lod_load_preset, "wave_count is 0", preset="Broken")
    assert preset_of(ocean) == before


def test_export_and_import_are_a_round_trip(ocean, tmp_path):
    path = tmp_path / "my sea.json"
    randomise(ocean, 99)
    before = preset_of(ocean)
    assert bpy.ops.object.ocean_lod_export_preset(filepath=str(path)) == {"FINISHED"}
    assert presets.read(path) == dataclasses.replace(before, title="my sea")
    bpy.ops.object.ocean_lod_load_preset(preset="calm")
    assert bpy.ops.object.ocean_lod_import_preset(filepath=str(path)) == {"FINISHED"}
    assert preset_of(ocean) == before


@pytest.mark.parametrize(
    ("content", "line"),
    [
        ("", "not JSON"),
        ("[]", "expected a table"),
        ('{"schema_version": 2}', "schema_version is 2, allowed is 1"),
        ('{"schema_version": 1, "sea": {"depth_m": -1}}', "depth_m is -1, allowed is 0.05 to 100000 m"),
    ],
)
def test_files_that_are_no_presets_leave_the_ocean_as_it_is(ocean, tmp_path, content, line):
    path = tmp_path / "bad.json"
    path.write_text(content)
    before = preset_of(ocean)
    assert_refused(bpy.ops.object.ocean_lod_import_preset, line, filepath=str(path))
    assert preset_of(ocean) == before


def test_places_that_can_not_be_written_are_named(ocean, tmp_path):
    path = tmp_path / "missing folder" / "a.json"
    assert_refused(bpy.ops.object.ocean_lod_export_preset, "can not be written", filepath=str(path))
    assert_refused(bpy.ops.object.ocean_lod_import_preset, "can not be read", filepath=str(path))


def test_a_loaded_preset_leaves_the_shots_clock_alone(ocean):
    """Truth: loop, speed and offset belong to the shot, and stay when another sea is tried."""
    clock = ocean.ocean_lod.time
    clock.loop_frames, clock.speed, clock.offset = 100, 0.5, 20.0
    bpy.ops.object.ocean_lod_load_preset(preset="beaufort_07")
    assert (clock.loop_frames, clock.speed, clock.offset) == (100, 0.5, 20.0)
