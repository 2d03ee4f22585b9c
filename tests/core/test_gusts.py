# SPDX-License-Identifier: GPL-3.0-or-later
"""Gusts move slope variance from place to place, and neither add any nor take any away."""

import dataclasses

import numpy as np
import pytest

from ocean_lod_addon.core.gusts import gust_factor, gust_waves
from ocean_lod_addon.core.lod import Grid, undisturbed_positions
from ocean_lod_addon.core.ocean import Ocean, Surface
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem

RIPPLES = Ripples(gusts=True, gust_strength=0.6, gust_size=100.0)
SEA = Sea(systems=(WaveSystem(wind_speed=8.0, direction=0.6),), seed=4)
GRID = Grid(cell_size=40.0, cells=256, levels=1)
STILL = np.zeros((1, 2))


def factor(time=0.0, sea=SEA, grid=GRID, anchors=STILL, ripples=RIPPLES):
    return gust_factor(grid, gust_waves(sea, ripples.gust_size), ripples, anchors, time)


def test_mean_is_one_and_strength_is_the_deviation_of_the_logarithm():
    """10 km across hold some 100 x 200 patches: m, of deviation 0.66, has its mean to 0.66 / sqrt(20 000) = 0.5 %,
    and the logarithm its deviation to as much, but for waves of few cycles: 2 %."""
    m = factor().astype(np.float64)
    assert m.mean() == pytest.approx(1.0, abs=0.02)
    assert np.log(m).std() == pytest.approx(0.6, rel=0.02)


def test_tiles_show_one_field():
    """The separated sum is the direct one: single precision of a sum of 32 waves."""
    waves = gust_waves(SEA, RIPPLES.gust_size)
    grid, anchors = Grid(cell_size=2.0, cells=64, levels=3), np.array([[4.0, -8.0], [4.0, -8.0], [8.0, -8.0]])
    x, y = undisturbed_positions(grid, anchors).T
    phase = np.multiply.outer(x, waves.kx) + np.multiply.outer(y, waves.ky) - waves.omega * 7.0 + waves.phase
    n = np.sqrt(2.0 / len(waves.kx)) * np.cos(phase).sum(axis=1)
    m = factor(7.0, grid=grid, anchors=anchors)
    assert np.log(m) - np.log(m[0]) == pytest.approx(0.6 * (n - n[0]), abs=1e-5)


def test_patches_drift_with_the_wind():
    """After 10 s the pattern stands 0.8 * 8 m/s * 10 s further along the wind."""
    grid = Grid(cell_size=3.0, cells=64, levels=1)
    shift = 64.0 * np.array([[np.cos(0.6), np.sin(0.6)]])
    assert factor(10.0, grid=grid, anchors=shift) == pytest.approx(factor(0.0, grid=grid), rel=1e-4)


def test_gusts_loop_with_the_sea():
    looping = dataclasses.replace(SEA, loop_period=5.0)
    assert factor(1.25 + 5.0, looping) == pytest.approx(factor(1.25, looping), rel=1e-5)


def test_calm_has_no_gusts():
    assert gust_waves(Sea(systems=(WaveSystem(wind_speed=0.0),)), 100.0) is None


def test_the_sea_keeps_its_slope_variance():
    """The mean over the plane is that of the sea without gusts; nothing gets a negative variance."""
    grid = Grid(cell_size=20.0, cells=256, levels=1)
    surface = Surface(Ocean(SEA, grid, ripples=RIPPLES))
    variance, amplitude = surface.gusty(STILL, 2.0)
    steady = surface.slope_variance()
    assert variance.mean(axis=0)[:2] == pytest.approx(steady.mean(axis=0)[:2], rel=0.03)
    assert variance[:, :2].min() > 0.0
    assert variance[:, 0].std() > 0.3 * steady[:, 0].mean()
    assert np.mean(amplitude.astype(np.float64) ** 2) == pytest.approx(1.0, abs=0.03)
