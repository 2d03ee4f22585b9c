# SPDX-License-Identifier: GPL-3.0-or-later
"""Seas at the ends of every range, brought in as preset files: each builds an ocean without NaN."""

import json
import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core import presets
from ocean_lod_addon.core.spectra.table import SPECTRA
from ocean_lod_addon.core.spreading.table import SPREADINGS
from ocean_lod_addon.nodes.material import NODE_NAME
from ocean_lod_addon.scene import mesh, ocean_object, properties

BY_HEIGHT = {"spectrum": "jonswap", "sized_by": "height"}
SWELL = {**BY_HEIGHT, "significant_wave_height_m": 3.0, "period_s": 14.0, "spreading": "cos2s"}


def one(**system):
    return {"systems": [system]}


HARD = {
    "wind 0": one(wind_speed_m_s=0.0),
    "wind 1e-3": one(wind_speed_m_s=0.001),
    "wind 60": one(wind_speed_m_s=60.0),
    "wind 80": one(wind_speed_m_s=80.0),
    "depth 0.05 m": one(**SWELL | {"significant_wave_height_m": 0.03}) | {"finite_depth": True, "depth_m": 0.05},
    "depth 0.05 m, TMA": one(spectrum="tma", wind_speed_m_s=3.0) | {"finite_depth": True, "depth_m": 0.05},
    "depth 1e5 m": one() | {"finite_depth": True, "depth_m": 1e5},
    "fetch 10 m": one(spectrum="jonswap", fetch_m=10.0),
    "fetch 1e7 m": one(spectrum="jonswap", fetch_m=1e7),
    "fetch 10 m, Elfouhaily": one(spectrum="elfouhaily", spreading="elfouhaily", fetch_m=10.0),
    "gamma 1": one(**SWELL, peak_enhancement=1.0),
    "gamma 20": one(**SWELL, peak_enhancement=20.0),
    "period 0.2 s": one(**BY_HEIGHT, period_s=0.2, significant_wave_height_m=0.01),
    "period 40 s": one(**BY_HEIGHT, period_s=40.0),
    "height 0": one(**BY_HEIGHT, significant_wave_height_m=0.0),
    "height 30 m": one(**BY_HEIGHT, significant_wave_height_m=30.0, period_s=18.0),
    "one wave": one() | {"wave_count": 1},
    "2000 waves": one() | {"wave_count": 2000},
    "64 waves a band": one() | {"wave_count": 64, "directions": 64},
    "one direction": one(directional_cutoff_deg=1.0),
    "widest fan": one(spreading="cos2s", spreading_exponent=0.1),
    "narrowest fan": one(spreading="cos2s", spreading_exponent=1000.0),
    "opposite swell": {"systems": [{"wind_speed_m_s": 12.0}, {**SWELL, "direction_deg": 180.0}]},
    "zero-energy system": {"systems": [{"wind_speed_m_s": 12.0}, {**SWELL, "significant_wave_height_m": 0.0}]},
    "no share": {"systems": [{"wave_share": 0.0}, {"enabled": False}]},
    "height field": one() | {"choppiness": 0.0},
    "folded crests": one(wind_speed_m_s=25.0) | {"choppiness": 2.0},
    "capillary waves": one(spectrum="elfouhaily", spreading="elfouhaily") | {"surface_tension": True},
}
HARD |= {f"{name} in a light wind": one(spectrum=name, wind_speed_m_s=0.5) for name in SPECTRA}
HARD |= {f"{name} in a hurricane": one(spreading=name, wind_speed_m_s=60.0) for name in SPREADINGS}

FLAT = {"wind 0", "wind 1e-3", "height 0", "no share"}
"""A wind of 1 mm/s raises no wave that a mesh could show."""


@pytest.mark.parametrize("name", HARD)
def test_hard_seas_build_and_move(ocean, name, tmp_path):
    """Truth: finite vertices that move, or a mirror where there is nothing to move the water; no complaint."""
    ocean.ocean_lod.grid.cell_size = 0.005  # fine enough for the smallest of these waves
    path = tmp_path / "hard.json"
    path.write_text(json.dumps({"schema_version": 1, "sea": HARD[name]}))
    assert bpy.ops.object.ocean_lod_import_preset(filepath=str(path)) == {"FINISHED"}
    assert properties.read_preset(ocean.ocean_lod, "", "").sea == presets.read(path).sea
    first = mesh.read_positions(ocean.data)
    bpy.context.scene.frame_set(40)
    second = mesh.read_positions(ocean.data)
    assert ocean_object.problem(ocean) == ""
    assert np.isfinite(first).all()
    assert np.isfinite(second).all()
    assert np.array_equal(first, second) == (name in FLAT)
    assert (not first[:, 2].any()) == (name in FLAT)


@pytest.mark.parametrize("frames", [1, 2, 24, 1_000_000])
def test_loops_of_any_length_build(ocean, frames):
    """Truth: a loop of one frame is nonsense that must not break anything; frame 1 and frame N + 1 are equal."""
    ocean.ocean_lod.time.loop_frames = frames
    scene = bpy.context.scene
    scene.frame_set(1)
    first = mesh.read_positions(ocean.data)
    assert np.isfinite(first).all()
    scene.frame_set(1 + frames)
    assert mesh.read_positions(ocean.data).tobytes() == first.tobytes()


def test_a_clock_that_stands_still_is_no_loop(ocean):
    clock = ocean.ocean_lod.time
    clock.loop_frames, clock.speed = 50, 0.0
    assert ocean_object.read_ocean(ocean, bpy.context.scene).sea.loop_period == 0.0
    bpy.context.scene.frame_set(7)
    first = mesh.read_positions(ocean.data)
    bpy.context.scene.frame_set(30)
    assert np.array_equal(mesh.read_positions(ocean.data), first)


def test_extremes_typed_into_the_panel_are_kept_in_range(ocean):
    system = ocean.ocean_lod.sea.systems[0]
    system.wind_speed, system.direction, system.fetch = 1e6, 100.0, -5.0
    assert (system.wind_speed, system.fetch) == (80.0, 10.0)
    assert system.direction == pytest.approx(2 * math.pi)
    assert ocean_object.problem(ocean) == ""


def test_water_shallower_than_the_waves_is_one_clear_line(ocean):
    """Truth: the ocean stays as it was, the panel says why, and mending the depth moves it again."""
    sea = ocean.ocean_lod.sea
    before = mesh.read_positions(ocean.data)
    sea.depth, sea.finite_depth = 0.1, True
    assert ocean_object.problem(ocean) == (
        "significant wave height is 2.16 m in water 0.1 m deep, allowed is up to the depth:"
        " make the water deeper or the waves lower"
    )
    assert np.array_equal(mesh.read_positions(ocean.data), before)
    ocean.ocean_lod.effects.finite_depth = "off"
    assert ocean_object.problem(ocean) == ""
    ocean.ocean_lod.effects.finite_depth = "auto"
    sea.depth = 5.0
    assert ocean_object.problem(ocean) == ""
    assert not np.array_equal(mesh.read_positions(ocean.data), before)


def test_a_material_setting_beside_settings_that_do_not_go_together(ocean, capfd):
    """Truth: no traceback on the terminal, and the material is right once the settings are mended."""
    ripples, material = ocean.ocean_lod.ripples, ocean.ocean_lod.material
    ripples.shortest_wavelength = 7.0  # more than half of the longest
    material.glitter_strength = 0.375
    ripples.shortest_wavelength = 0.006
    assert ocean_object.problem(ocean) == ""
    assert "Traceback" not in capfd.readouterr().err
    water = ocean.data.materials[0].node_tree.nodes[NODE_NAME]
    assert water.inputs["Glitter Strength"].default_value == 0.375
