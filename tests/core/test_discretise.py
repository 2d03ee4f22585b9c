# SPDX-License-Identifier: GPL-3.0-or-later
"""From a sea to its waves: energy, slope variance, seeding, hard cases."""

from dataclasses import fields, replace

import numpy as np
import pytest

from ocean_lod_addon.core.discretise import bin_edges, discretise, system_waves
from ocean_lod_addon.core.dispersion import angular_frequency
from ocean_lod_addon.core.errors import OutOfRangeError
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.waves import TWO_PI

WIND_SEA = WaveSystem(seed=3)
SWELL = WaveSystem(name="Swell", direction=np.pi, wind_speed=15.0, wave_share=0.25, seed=8)


def arrays(waves):
    return {field.name: getattr(waves, field.name) for field in fields(waves) if field.name != "loop_period"}


def slope_variances(waves, direction):
    """Along and across `direction`."""
    variance = 0.5 * (waves.wavenumber * waves.amplitude) ** 2
    along = np.cos(waves.direction - direction) ** 2
    return np.sum(variance * along), np.sum(variance * (1.0 - along))


def test_adding_a_system_leaves_the_waves_of_the_others():
    """Truth: a wave depends on its own system alone; equal bit for bit."""
    one, two = discretise(Sea((WIND_SEA,)), 0.5), discretise(Sea((WIND_SEA, SWELL)), 0.5)
    assert len(two) == len(one) + 32
    for name, values in arrays(one).items():
        np.testing.assert_array_equal(getattr(two, name)[: len(one)], values)


def test_a_disabled_system_leaves_the_waves_of_the_others():
    """Truth: the second system keeps its place, and so its draws, when the first is switched off."""
    both = discretise(Sea((WIND_SEA, SWELL)), 0.5)
    second = discretise(Sea((replace(WIND_SEA, enabled=False), SWELL)), 0.5)
    for name, values in arrays(second).items():
        np.testing.assert_array_equal(getattr(both, name)[-len(second) :], values)


def test_more_bins_of_the_same_width_append_waves():
    """Truth: with the same bins, a shorter cut-off adds waves at the end; equal bit for bit."""
    sea = Sea((WIND_SEA,))
    edges = bin_edges(0.8, 20.0, 160)
    long_set, short_set = system_waves(sea, 0, edges, 8), system_waves(sea, 0, edges[: 8 * 9 + 1], 8)
    for longer, shorter in zip(long_set, short_set, strict=True):
        np.testing.assert_array_equal(longer[:72], shorter)


def test_more_waves_keep_the_draws_of_those_that_were_there():
    """Truth: phase number i is draw number i of the system, however many waves there are."""
    few, many = discretise(Sea((WIND_SEA,)), 0.5), discretise(Sea((WIND_SEA,), wave_count=512), 0.5)
    np.testing.assert_array_equal(many.phase[: len(few)], few.phase)


def test_energies_of_systems_add():
    """Truth: m0 of a sea is the sum of its systems'; 1e-14: one sum in another order."""
    parts = [discretise(Sea((WIND_SEA, replace(SWELL, enabled=False))), 0.5), discretise(Sea((SWELL,)), 0.5)]
    both = discretise(Sea((WIND_SEA, SWELL)), 0.5)
    m0 = [0.5 * np.sum(waves.amplitude**2) for waves in (*parts, both)]
    assert m0[2] == pytest.approx(m0[0] + m0[1], rel=1e-14)


@pytest.mark.parametrize("depth", [0.05, 5.0, 1e5])
def test_waves_obey_dispersion(depth):
    """Truth: omega(k) of every wave is the water's. 1e-13: the solver's own rounding."""
    sea = Sea((WIND_SEA,), finite_depth=True, depth=depth)
    waves = discretise(sea, 0.2)
    np.testing.assert_allclose(waves.angular_frequency, angular_frequency(waves.wavenumber, sea.water), rtol=1e-13)
    np.testing.assert_allclose(waves.orbit_ratio, 1.0 / np.tanh(waves.wavenumber * depth), rtol=1e-13)


@pytest.mark.parametrize(
    "sea",
    [
        Sea((replace(WIND_SEA, wind_speed=0.0),)),
        Sea((replace(WIND_SEA, enabled=False),)),
        Sea((replace(WIND_SEA, sized_by="height", significant_wave_height=0.0),)),
        Sea((replace(WIND_SEA, wave_share=0.0),)),
        Sea((replace(WIND_SEA, wind_speed=0.01),)),
        Sea(()),
    ],
)
def test_a_sea_without_energy_has_no_waves(sea):
    """Truth: nothing to show, and nothing that is not a number."""
    assert len(discretise(sea, 0.5)) == 0


@pytest.mark.parametrize("wavelength", [0.0, -1.0, np.nan, np.inf])
def test_shortest_wavelength_is_checked(wavelength):
    with pytest.raises(OutOfRangeError, match="shortest wavelength"):
        discretise(Sea(), wavelength)


def test_directions_follow_the_system():
    """Truth: turning a system turns every wave by as much. 1e-14: one sum and one mod 2 pi, relative to 2 pi."""
    straight, turned = discretise(Sea((WIND_SEA,)), 0.5), discretise(Sea((replace(WIND_SEA, direction=2.0),)), 0.5)
    difference = np.mod(turned.direction - straight.direction - 2.0 + np.pi, TWO_PI) - np.pi
    np.testing.assert_allclose(difference, 0.0, atol=1e-14 * TWO_PI)
    np.testing.assert_allclose(slope_variances(turned, 2.0), slope_variances(straight, 0.0), rtol=1e-12)
