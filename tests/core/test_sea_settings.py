# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a sea: ranges, defaults, tables that drive them, use as a key."""

import math
from dataclasses import replace

import pytest

from ocean_lod_addon.core.dispersion import Water
from ocean_lod_addon.core.errors import OutOfRangeError
from ocean_lod_addon.core.parameters import (
    Choice,
    Number,
    mapping_from_settings,
    parameters_of,
    settings_from_mapping,
)
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectra.table import SPECTRA, spectrum_of
from ocean_lod_addon.core.spreading.table import SPREADINGS
from ocean_lod_addon.core.wind import wind_at_height


@pytest.mark.parametrize("cls", [Sea, WaveSystem])
def test_every_number_is_checked_at_both_ends(cls):
    """Truth: the ends are allowed, one step beyond and NaN are not, and the line names value and range."""
    for name, parameter in parameters_of(cls).items():
        if not isinstance(parameter, Number):
            continue
        for allowed in (parameter.minimum, parameter.maximum):
            assert getattr(cls(**{name: allowed}), name) == allowed
        below, above = math.nextafter(parameter.minimum, -math.inf), math.nextafter(parameter.maximum, math.inf)
        for wrong in (below, above, math.nan, math.inf, "1", None, True):
            with pytest.raises(OutOfRangeError, match=f"^{name} is .*allowed is "):
                cls(**{name: wrong})


@pytest.mark.parametrize("cls", [Sea, WaveSystem])
def test_every_parameter_is_explained(cls):
    """Truth: each has a label and a tooltip that is a sentence, without a full stop as Blender asks."""
    for parameter in parameters_of(cls).values():
        assert parameter.label
        assert len(parameter.description) > 20
        assert not parameter.description.endswith(".")
        if isinstance(parameter, Choice):
            assert all(option.description for option in parameter.options)


def test_the_tables_drive_the_choices():
    """Truth: what can be chosen is what is in the tables, and the settings that rows name exist."""
    parameters = parameters_of(WaveSystem)
    assert [option.key for option in parameters["spectrum"].options] == list(SPECTRA)
    assert [option.key for option in parameters["spreading"].options] == list(SPREADINGS)
    for kind in SPECTRA.values():
        assert {*kind.wind_settings, *kind.height_settings} <= set(parameters)
    for kind in SPREADINGS.values():
        assert set(kind.settings) <= set(parameters)


@pytest.mark.parametrize("key", SPECTRA)
def test_a_spectrum_depends_on_the_settings_its_row_names_and_no_others(key):
    """Truth: the panel shows the settings of the row; changing any other number changes nothing."""
    water, kind = Water(20.0), SPECTRA[key]
    other = {
        "wind_speed": 7.0,
        "fetch": 2e4,
        "significant_wave_height": 1.3,
        "period": 5.5,
        "period_kind": "mean",
        "peak_enhancement": 6.0,
    }
    for sized_by, settings in (("wind", kind.wind_settings), ("height", kind.height_settings)):
        base = WaveSystem(spectrum=key, sized_by=sized_by)
        for name, value in other.items():
            same = spectrum_of(base, water) == spectrum_of(replace(base, **{name: value}), water)
            assert same == (name not in settings), name


def test_a_sea_is_a_key():
    """Truth: equal settings are equal and hash alike; different ones are not equal."""
    assert hash(Sea()) == hash(Sea())
    assert {Sea(): 1}[Sea((WaveSystem(),))] == 1
    assert Sea() != Sea((WaveSystem(direction=0.1),))
    with pytest.raises(OutOfRangeError, match="systems"):
        Sea([WaveSystem()])


def test_files_give_the_same_settings_back():
    """Truth: what is written reads back as equal settings."""
    system = WaveSystem(
        "Swell", spectrum="jonswap", sized_by="height", period=12.5, direction=math.radians(-135.0)
    )
    assert settings_from_mapping(WaveSystem, mapping_from_settings(system), "test") == system


def test_depth_of_the_water():
    """Truth: deep unless the switch is on; surface tension only on request."""
    assert Sea(depth=3.0).water.depth == math.inf
    assert Sea(depth=3.0, finite_depth=True).water.depth == 3.0
    assert Sea().water.surface_tension == 0.0
    assert Sea(surface_tension=True).water.surface_tension > 7e-5


@pytest.mark.parametrize(
    ("height", "ratio"), [(5.0, 0.938), (7.5, 0.974), (10.0, 1.0), (12.5, 1.020), (19.5, 1.060)]
)
def test_wind_at_the_heights_of_the_formulas(height, ratio):
    """Truth: the log law's ratios to U10, to the three digits of THEORY section 3."""
    assert wind_at_height(10.0, height) == pytest.approx(10.0 * ratio, abs=0.006)
