# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sea says of itself."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from ocean_lod_addon.core.beaufort import BEAUFORT_SCALE, beaufort_force, typical_wind
from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.dispersion import DEEP_WATER
from ocean_lod_addon.core.readback import loop_distortion, sea_report
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectra.table import SHORTEST_GRAVITY_WAVE, spectrum_of
from ocean_lod_addon.core.waves import TWO_PI

SHORTEST = 0.5
SWELL = WaveSystem(
    name="Swell", spectrum="jonswap", sized_by="height", significant_wave_height=3.0, period=14.0, direction=2.0
)


def report(sea):
    return sea_report(sea, discretise(sea, SHORTEST), SHORTEST)


def test_theory_of_a_wind_sea():
    """Truth: closed forms of Pierson-Moskowitz, THEORY section 3.

    1e-7: the tail of m2. The mean wavelength is 2 pi over the mean wavenumber m2 / (g m0). 1e-3: Tp on its grid.
    """
    sea = Sea()
    spectrum = spectrum_of(sea.systems[0], DEEP_WATER)
    m0, m1, m2 = (spectrum.moment(n) for n in range(3))
    theory = report(sea).theoretical
    assert theory.significant_wave_height == pytest.approx(4.0 * math.sqrt(m0), rel=1e-12)
    assert theory.peak_period == pytest.approx(TWO_PI / spectrum.peak_frequency, rel=1e-3)
    assert theory.mean_period == pytest.approx(TWO_PI * m0 / m1, rel=1e-9)
    assert theory.zero_crossing_period == pytest.approx(TWO_PI * math.sqrt(m0 / m2), rel=1e-7)
    assert theory.mean_wavelength == pytest.approx(TWO_PI * GRAVITY * m0 / m2, rel=1e-7)
    shortest = math.sqrt(GRAVITY * TWO_PI / SHORTEST_GRAVITY_WAVE)
    total = theory.slope_variance_along + theory.slope_variance_across
    assert total == pytest.approx(spectrum.deep_slope_variance_below(shortest), rel=1e-12)


def test_the_waves_have_what_the_theory_says():
    """Truth: with many waves the samples' statistics go to the spectrum's up to the cut-off.

    Height to the energy beyond it (4e-5 for 0.5 m waves), periods and length to 1 % (tail of m2), Tp to 2 % (bin).
    """
    sea = Sea(wave_count=512)
    result = report(sea)
    theory, sample = result.theoretical, result.sampled
    assert sample.significant_wave_height == pytest.approx(theory.significant_wave_height, rel=1e-4)
    assert sample.peak_period == pytest.approx(theory.peak_period, rel=0.02)
    for name in ("mean_period", "zero_crossing_period", "mean_wavelength"):
        assert getattr(sample, name) == pytest.approx(getattr(theory, name), rel=0.01)
    assert result.energy_share == pytest.approx(1.0, abs=1e-4)
    spectrum = spectrum_of(sea.systems[0], DEEP_WATER)
    cutoffs = [math.sqrt(GRAVITY * TWO_PI / length) for length in (SHORTEST, SHORTEST_GRAVITY_WAVE)]
    resolved, whole = (spectrum.deep_slope_variance_below(cutoff) for cutoff in cutoffs)
    assert result.slope_variance_share == pytest.approx(resolved / whole, rel=1e-12)


def test_slopes_turn_with_the_system():
    """Truth: slope variances are a tensor: a system across the axis swaps along and across. 1e-12: rounding."""
    wind = WaveSystem()
    across_wind = replace(wind, sized_by="height", direction=0.5 * math.pi)
    calm = replace(wind, wind_speed=0.0)  # sets the axis and has no waves
    turned = report(Sea((calm, across_wind)))
    straight = report(Sea((calm, replace(across_wind, direction=0.0))))
    for kind in ("theoretical", "sampled"):
        one, other = getattr(turned, kind), getattr(straight, kind)
        if kind == "theoretical":
            assert one.slope_variance_along == pytest.approx(other.slope_variance_across, rel=1e-12)
        total = one.slope_variance_along + one.slope_variance_across
        assert total == pytest.approx(other.slope_variance_along + other.slope_variance_across, rel=1e-12)


def test_a_swell_and_a_wind_sea():
    """Truth: squares of heights add; the peak is that of the swell, which has the larger density."""
    wind_sea = WaveSystem(wind_speed=6.0)
    both = report(Sea((wind_sea, SWELL)))
    parts = [report(Sea((system,))).theoretical.significant_wave_height for system in (wind_sea, SWELL)]
    assert both.theoretical.significant_wave_height == pytest.approx(math.hypot(*parts), rel=1e-12)
    assert both.theoretical.peak_period == pytest.approx(14.0, rel=1e-3)
    assert both.sampled.peak_period == pytest.approx(14.0, rel=0.03)
    assert (both.beaufort_number, both.beaufort_name, both.wind_speed) == (4, "Moderate breeze", 6.0)


def test_a_swell_alone_has_no_wind():
    result = report(Sea((SWELL,)))
    assert result.beaufort_number is None
    assert result.wind_speed is None
    assert result.wind_direction == SWELL.direction


def test_a_flat_sea_reads_back_as_flat():
    """Truth: no height, no slopes, and no period rather than one that is not a number."""
    for sea in (Sea((WaveSystem(wind_speed=0.0),)), Sea(())):
        result = report(sea)
        assert result.theoretical.significant_wave_height == 0.0
        assert result.sampled.significant_wave_height == 0.0
        assert result.sampled.peak_period is None
        assert result.energy_share is None
        assert result.wave_count == 0


def test_json_keys_have_units_and_values_are_plain():
    """Truth: strict JSON, no NaN; keys end in their units."""
    text = json.dumps(report(Sea((WaveSystem(), SWELL), loop_period=30.0)).to_json(), allow_nan=False)
    data = json.loads(text)
    assert set(data["sampled"]) == {
        "significant_wave_height_m",
        "peak_period_s",
        "mean_period_s",
        "zero_crossing_period_s",
        "mean_wavelength_m",
        "slope_variance_along",
        "slope_variance_across",
    }
    assert data["wind_speed_m_s"] == 10.0
    assert set(data["loop"]) == {"largest_frequency_shift", "rms_frequency_shift", "slope_variance_ratio"}
    json.dumps(report(Sea(())).to_json(), allow_nan=False)


def test_loop_distortion():
    """Truth: shifts are at most half a step pi / T over the frequency; a long loop distorts little."""
    for period in (15.0, 120.0, 1e4):
        sea = Sea(loop_period=period)
        distortion = loop_distortion(sea, SHORTEST)
        slowest = discretise(Sea(), SHORTEST).angular_frequency[0]
        assert 0.0 < distortion.rms_frequency_shift <= distortion.largest_frequency_shift
        assert distortion.largest_frequency_shift <= np.pi / period / slowest * (1.0 + 1e-9)
    assert distortion.rms_frequency_shift < 1e-3
    assert distortion.slope_variance_ratio == pytest.approx(1.0, abs=1e-4)
    assert report(Sea()).loop is None


@pytest.mark.parametrize(
    ("wind_speed", "number"),
    [(0.0, 0), (0.29, 0), (0.3, 1), (5.49, 3), (5.5, 4), (10.8, 6), (17.2, 8), (32.6, 11), (32.7, 12), (80.0, 12)],
)
def test_beaufort(wind_speed, number):
    """Truth: the WMO table of wind speeds in m/s."""
    assert beaufort_force(wind_speed).number == number


def test_typical_winds_are_of_their_force():
    """Truth: v = 0.836 B^1.5 lies within force B of the table."""
    assert [beaufort_force(typical_wind(force.number)).number for force in BEAUFORT_SCALE] == list(range(13))
