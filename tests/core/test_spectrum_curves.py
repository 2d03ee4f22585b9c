# SPDX-License-Identifier: GPL-3.0-or-later
"""The curves of the plots enclose the energy that the sea has."""

import math

import numpy as np
import pytest

from ocean_lod_addon.core.directional import elevation_spectrum
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.dispersion import angular_frequency, group_speed
from ocean_lod_addon.core.readback import theoretical_statistics
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectrum_curves import (
    directional_density,
    energy_by_direction,
    sampled_density,
    target_density,
)

SHORTEST = 0.4
SWELL = WaveSystem(
    "Swell", spectrum="jonswap", sized_by="height", period=12.0, spreading="cos2s", direction=2.0, wave_share=0.5
)
SEAS = {
    "wind sea": Sea(wave_count=64),
    "crossing seas": Sea((WaveSystem(spreading="mitsuyasu"), SWELL), wave_count=64),
    "narrow": Sea((WaveSystem(directional_cutoff=math.radians(20.0)),), wave_count=64),
    "shallow": Sea((WaveSystem(spectrum="tma"),), finite_depth=True, depth=4.0, wave_count=64),
    "loop": Sea(wave_count=64, loop_period=20.0),
}
OMEGA = np.linspace(0.02, 13.0, 200_001)
"""rad/s; beyond are waves shorter than 0.36 m, with 4e-4 of a fully developed sea's energy at most."""


def variance(sea):
    return theoretical_statistics(sea, 0.0).significant_wave_height ** 2 / 16.0


@pytest.mark.parametrize("name", SEAS)
def test_both_curves_enclose_the_variance(name):
    """Truth: the area below each curve is m0. 2e-3: energy beyond the cut-off, and steps summed on a grid."""
    sea = SEAS[name]
    step = OMEGA[1] - OMEGA[0]
    sampled = sampled_density(sea, discretise(sea, SHORTEST), SHORTEST, OMEGA)
    assert target_density(sea, OMEGA).sum() * step == pytest.approx(variance(sea), rel=2e-3)
    assert sampled.sum() * step == pytest.approx(variance(sea), rel=2e-3)


def test_the_sampled_curve_follows_the_target():
    """Truth: bins hold the spectrum's own energy, so the curves differ by how far S bends within a bin."""
    sea = Sea(wave_count=256)
    omega = np.linspace(0.6, 4.0, 500)
    target = target_density(sea, omega)
    sampled = sampled_density(sea, discretise(sea, SHORTEST), SHORTEST, omega)
    assert np.abs(sampled - target).max() < 0.05 * target.max()


@pytest.mark.parametrize("name", SEAS)
def test_directions_enclose_the_variance(name):
    """Truth: the integral over all directions is m0. 1e-3: 720 steps of a fan with a sharp edge."""
    sea = SEAS[name]
    direction = (np.arange(720) + 0.5) * 2.0 * np.pi / 720
    area = energy_by_direction(sea, direction).sum() * 2.0 * np.pi / 720
    assert area == pytest.approx(variance(sea), rel=1e-3)


def test_the_directional_spectrum_agrees_with_the_one_over_wavenumbers():
    """Truth: Psi(k) k dk dtheta = S D domega dtheta, with c_g = domega / dk."""
    sea = SEAS["crossing seas"]
    k, angle = np.array([0.05, 0.3, 2.0]), 0.7
    expected = elevation_spectrum(sea, k * np.cos(angle), k * np.sin(angle)) * k / group_speed(k, sea.water)
    found = directional_density(sea, angular_frequency(k, sea.water), angle)
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_a_flat_sea_has_flat_curves():
    sea = Sea((WaveSystem(wind_speed=0.0),))
    assert not target_density(sea, OMEGA).any()
    assert not sampled_density(sea, discretise(sea, SHORTEST), SHORTEST, OMEGA).any()
    assert not energy_by_direction(sea, np.linspace(0.0, 6.0, 7)).any()
