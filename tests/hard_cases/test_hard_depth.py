# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of depth: water much shallower and much deeper than waves are long, and lower than waves are high."""

import dataclasses

import numpy as np
import pytest

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.dispersion import Water, angular_frequency, coth_kh, group_speed, wavenumber
from ocean_lod_addon.core.errors import OceanError
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.ocean import Ocean, Surface
from ocean_lod_addon.core.sea import Sea, WaveSystem
from tests.hard_cases.catalogue import FLOAT64_ROUNDING, hard_case

KH = np.geomspace(1e-8, 1e8, 2001)
DEPTH = 20.0
WATER = Water(depth=DEPTH)


@hard_case(
    title="kh from 1e-8 to 1e8: the dispersion relation",
    truth="k(omega(k)) = k",
    naive="k = omega^2 / (g tanh kh), iterated 50 times",
    error="k, relative",
    bound=16 * FLOAT64_ROUNDING,
    because="omega rounds by 4 u, doubled by d ln k/d ln omega <= 2, and as much again for the inverse",
)
def test_dispersion_at_all_depths():
    k = KH / DEPTH
    omega = angular_frequency(k, WATER)
    naive = omega**2 / GRAVITY
    with np.errstate(all="ignore"):
        for _ in range(50):
            naive = omega**2 / (GRAVITY * np.tanh(naive * DEPTH))
    ours = np.abs(wavenumber(omega, WATER) / k - 1.0).max()
    return float(np.abs(naive / k - 1.0).max()), float(ours)


@hard_case(
    title="kh from 1e-8 to 1e8: the speed of energy",
    truth="c_g = c (1 + 2kh / sinh 2kh) / 2, between c / 2 and c",
    naive="2kh / sinh 2kh",
    error="c_g / c outside [1/2, 1]",
    bound=4 * FLOAT64_ROUNDING,
    because="three operations",
)
def test_group_speed_at_all_depths():
    k = KH / DEPTH
    with np.errstate(over="ignore"):
        x = 2.0 * KH
        naive = 0.5 * (1.0 + x * 2.0 / (np.exp(x) - np.exp(-x)))
    ratio = group_speed(k, WATER) / (angular_frequency(k, WATER) / k)

    def outside(values):
        return float(np.maximum(values - 1.0, 0.5 - values).max())

    return outside(naive), outside(ratio)


@hard_case(
    title="kh from 1e-8 to 1e8: the orbits",
    truth="coth x = 1/x + x/3 below x = 1e-4, 1 above 20",
    naive="(e^x + e^-x) / (e^x - e^-x)",
    error="coth, relative",
    bound=8 * FLOAT64_ROUNDING,
    because="product, tanh and quotient, each within 2 u",
)
def test_the_orbits_at_all_depths():
    small, large = KH[KH < 1e-4], KH[KH > 20.0]
    x = np.concatenate([small, large])
    truth = np.concatenate([1.0 / small + small / 3.0, np.ones_like(large)])
    with np.errstate(all="ignore"):
        naive = (np.exp(x) + np.exp(-x)) / (np.exp(x) - np.exp(-x))
    ours = coth_kh(x / DEPTH, DEPTH)
    return float(np.abs(naive / truth - 1.0).max()), float(np.abs(ours / truth - 1.0).max())


@hard_case(
    title="omega = 0",
    truth="k = 0",
    naive="Newton's rule from omega^2 / g",
    error="k, rad/m",
    bound=0.0,
    because="a series below omega^2 h / g = 1e-8, exact there",
)
def test_no_frequency():
    k = np.float64(0.0)
    with np.errstate(invalid="ignore"):
        for _ in range(3):
            t = np.tanh(k * DEPTH)
            k = k - (GRAVITY * k * t) / (GRAVITY * (t + k * DEPTH * (1.0 - t * t)))
    return float(k), float(wavenumber(0.0, WATER))


SWELL = WaveSystem(spectrum="jonswap", sized_by="height", significant_wave_height=3.0, period=9.0)
SHALLOW = Sea(systems=(SWELL,), finite_depth=True, depth=1.5)
SMALL_GRID = Grid(cell_size=0.25, cells=8, levels=2)


@hard_case(
    title="waves of 3 m in water 1.5 m deep",
    truth="no sea: one clear line says so, with the depth that the waves need",
    naive="the sum of the waves, whatever the depth",
    error="lowest trough below the bottom, m (0 where the sea is refused)",
    bound=0.0,
    because="refused by name",
)
def test_waves_higher_than_the_water_is_deep():
    x, y = np.random.default_rng(5).uniform(-500.0, 500.0, (2, 2000))
    naive = -SHALLOW.depth - surface_points(discretise(SHALLOW, 1.0), x, y, 0.0).position[:, 2].min()
    try:
        Surface(Ocean(SHALLOW, SMALL_GRID))
    except OceanError as error:
        named = "significant wave height is 3 m in water 1.5 m deep, allowed is up to the depth" in str(error)
        return float(naive), float("inf") if not named else 0.0
    return float(naive), float(naive)


@pytest.mark.parametrize(("share", "allowed"), [(0.999, True), (1.001, False)])
def test_waves_as_high_as_the_water_is_deep_are_the_limit(share, allowed):
    height = 4.0 * np.sqrt(0.5 * np.sum(discretise(SHALLOW, SMALL_GRID.shortest_wavelength).amplitude ** 2))
    ocean = Ocean(dataclasses.replace(SHALLOW, depth=float(height / share)), SMALL_GRID)
    if allowed:
        assert len(Surface(ocean).waves)
    else:
        with pytest.raises(OceanError, match="allowed is up to the depth"):
            Surface(ocean)
