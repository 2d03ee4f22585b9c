# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that the panel shows are exactly those that change the waves."""

import dataclasses

import numpy as np
import pytest

from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.parameters import parameters_of
from ocean_lod_addon.core.relevant_settings import relevant_settings
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectra.table import SPECTRA
from ocean_lod_addon.core.spreading.table import SPREADINGS

OTHER_VALUES = {
    "name": "Other",
    "enabled": False,
    "sized_by": "wind",
    "wind_speed": 7.0,
    "fetch": 2e4,
    "significant_wave_height": 1.3,
    "period": 5.5,
    "period_kind": "mean",
    "peak_enhancement": 6.0,
    "spreading_exponent": 3.0,
    "direction": 1.0,
    "directional_cutoff": 0.5,
    "wave_share": 0.5,
    "seed": 3,
}


def waves_of(system):
    waves = discretise(Sea((system,), wave_count=16, finite_depth=True), 1.0)
    return [getattr(waves, field.name) for field in dataclasses.fields(waves)]


@pytest.mark.parametrize("sized_by", ["wind", "height"])
@pytest.mark.parametrize("spreading", SPREADINGS)
@pytest.mark.parametrize("spectrum", SPECTRA)
def test_relevant_settings_change_the_waves_and_others_do_not(spectrum, spreading, sized_by):
    system = WaveSystem(spectrum=spectrum, spreading=spreading, sized_by=sized_by, fetch=5e4)
    before = waves_of(system)
    relevant = relevant_settings(system)
    assert set(relevant) <= set(parameters_of(WaveSystem))
    for name, value in OTHER_VALUES.items():
        if value == getattr(system, name):
            continue
        after = waves_of(dataclasses.replace(system, **{name: value}))
        same = all(np.array_equal(a, b) for a, b in zip(before, after, strict=True))
        assert same == (name not in relevant), name
