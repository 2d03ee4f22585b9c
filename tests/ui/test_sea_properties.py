# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings as Blender properties: they keep what was typed, in names that fit the sidebar."""

import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.beaufort import beaufort_force
from ocean_lod_addon.core.framing import Framing
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.ocean_time import OceanTime
from ocean_lod_addon.core.parameters import Number, Switch, parameters_of
from ocean_lod_addon.core.readback import theoretical_statistics
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.scene import mesh, ocean_object, properties, rna
from ocean_lod_addon.ui import readback_cache

WIDEST_LABEL = 13
"""Letters beside a field in a sidebar of Blender's own width, measured on a picture of it ("Height Hs (m)")."""


@pytest.mark.parametrize("degrees", [0.0, 1.0, 45.0, -30.0, 180.0, 123.456, -0.001, 359.99, 22.5, 33.3333])
def test_angles_are_the_degrees_that_were_typed(degrees):
    """Truth: float32 keeps seven digits; the shortest number of degrees with the same float32 is the typed one."""
    kept = float(np.float32(math.radians(degrees)))
    assert math.degrees(rna.typed_angle(kept)) == pytest.approx(degrees, rel=1e-12)


def test_any_float32_angle_stays_itself():
    """Truth: reading, writing and reading again changes nothing, for any angle that Blender can hold."""
    random = np.random.default_rng(5)
    for kept in random.uniform(-2 * np.pi, 2 * np.pi, 2000).astype(np.float32):
        typed = rna.typed_angle(float(kept))
        assert np.float32(typed) == kept
        assert rna.typed_angle(float(np.float32(typed))) == typed


@pytest.mark.parametrize("number", range(13))
def test_a_typed_beaufort_number_gives_a_wind_of_that_force(ocean, number):
    system = ocean.ocean_lod.sea.systems[0]
    system.beaufort = number
    assert system.beaufort == number
    assert beaufort_force(properties.read_system(system).wind_speed).number == number


def test_the_sea_follows_the_beaufort_number(ocean):
    """Truth: the height of a fully developed sea grows with the square of the wind."""

    def height_over_square_of_wind():
        sea = properties.read_sea(ocean.ocean_lod)
        return theoretical_statistics(sea, 0.0).significant_wave_height / sea.systems[0].wind_speed ** 2

    before = height_over_square_of_wind(), mesh.read_positions(ocean.data)
    ocean.ocean_lod.sea.systems[0].beaufort = 9
    assert height_over_square_of_wind() == pytest.approx(before[0], rel=1e-9)
    assert not np.array_equal(mesh.read_positions(ocean.data), before[1])


@pytest.mark.parametrize("cls", [WaveSystem, Sea, OceanTime, Grid, Framing, MaterialSettings, Ripples])
def test_names_fit_beside_their_fields(cls):
    """Truth: Blender cuts a longer name; a switch stands beside its name, with room to spare."""
    for parameter in parameters_of(cls).values():
        has_unit = isinstance(parameter, Number) and parameter.unit not in ("", "rad")
        label = f"{parameter.label} ({parameter.unit})" if has_unit else parameter.label
        assert isinstance(parameter, Switch) or len(label) <= WIDEST_LABEL, label


def test_reports_follow_the_settings_between_redraws(ocean):
    """Truth: asking for a report costs no computation; the timer makes it once the settings rest."""
    readback_cache.unregister()
    ocean.ocean_lod.sea.seed = 4711
    settings = ocean_object.read_ocean(ocean, bpy.context.scene)
    assert readback_cache.report_for(settings)[1] is False
    assert bpy.app.timers.is_registered(readback_cache.compute_wanted)
    wait = readback_cache.compute_wanted()
    assert 0.0 < wait <= 0.3
    while wait is not None:
        wait = readback_cache.compute_wanted()
    report, current = readback_cache.report_for(settings)
    assert current
    assert report.theoretical.significant_wave_height == pytest.approx(2.16, abs=0.01)
    ocean.ocean_lod.sea.seed = 4712
    other, current = readback_cache.report_for(ocean_object.read_ocean(ocean, bpy.context.scene))
    assert (other, current) == (report, False), "the last report is shown until the new one is there"
    readback_cache.unregister()
    assert not bpy.app.timers.is_registered(readback_cache.compute_wanted)
