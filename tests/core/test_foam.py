# SPDX-License-Identifier: GPL-3.0-or-later
"""Whitecaps: as many as the wind makes, at any distance, and a function of the instant alone."""

import dataclasses
import itertools

import numpy as np
import pytest
from scipy.integrate import trapezoid

from ocean_lod_addon.core.column_blocks import TANGENTS
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.errors import OutOfRangeError
from ocean_lod_addon.core.foam import shading
from ocean_lod_addon.core.foam.calibration import breaking_weights
from ocean_lod_addon.core.foam.exceedance import below, both_below, some_above
from ocean_lod_addon.core.foam.whitecap_law import whitecap_coverage
from ocean_lod_addon.core.foam.whitecaps import Whitecaps, sea_breaker_wavenumber, sea_breaking_variance
from ocean_lod_addon.core.foam_settings import Foam
from ocean_lod_addon.core.lod import Grid, level_anchors, undisturbed_positions
from ocean_lod_addon.core.ocean import Ocean, Surface
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.placement import Placement
from ocean_lod_addon.core.sea import Sea, WaveSystem

GRID = Grid(cell_size=1.0, cells=64, levels=6)


def sea_of(wind, **settings):
    return Sea(systems=(WaveSystem(wind_speed=wind),), **settings)


def surface_of(wind, grid=GRID, foam=None, **settings):
    return Surface(Ocean(sea_of(wind, **settings), grid, foam=foam or Foam()))


def foam_at(surface, time, centre=(0.0, 0.0)):
    """Foam and Jacobian of every vertex."""
    anchors = level_anchors(surface.ocean.grid, centre)
    block = surface.whitecaps.block
    columns = np.empty((surface.vertex_count, block.columns), np.float32)
    tangents = np.empty((surface.vertex_count, 5), np.float32)
    positions = np.empty((surface.vertex_count, 3), np.float32)
    surface.positions(time, Placement(anchors), positions, {block: columns, TANGENTS: tangents})
    foam = np.empty(surface.vertex_count, np.float32)
    surface.whitecaps.foam(columns, foam)
    return foam, tangents[:, 0] * tangents[:, 2] - tangents[:, 1] ** 2


def test_the_law_is_that_of_monahan_and_o_muircheartaigh():
    """1 % of the sea at 10 m/s; nothing below 4 m/s; never more than all of it."""
    assert whitecap_coverage(10.0) == pytest.approx(3.84e-6 * 10.0**3.41)
    assert whitecap_coverage(3.99) == 0.0
    winds = np.linspace(0.0, 80.0, 1601)
    covered = np.array([whitecap_coverage(wind) for wind in winds])
    assert (np.diff(covered) >= 0.0).all()
    assert covered[-1] < 1.0
    assert np.diff(covered[winds < 6.0]).max() < 2e-4, "a rising wind does not pop"


@pytest.mark.parametrize(("h", "k", "rho"), [(0.3, -0.5, 0.6), (2.5, 2.0, -0.4), (1.0, 1.0, 0.999)])
def test_two_values_below_their_thresholds(h, k, rho):
    """int_-inf^h phi(x) Phi((k - rho x) / sqrt(1 - rho^2)) dx by a fine sum."""
    x = np.linspace(-9.0, h, 200_001)
    density = np.exp(-0.5 * x * x) / np.sqrt(2.0 * np.pi) * below((k - rho * x) / np.sqrt(1.0 - rho * rho))
    expected = trapezoid(density, x)
    assert both_below(np.array([h]), np.array([k]), rho)[0] == pytest.approx(expected, abs=1e-6)


def test_instants_that_know_nothing_of_each_other():
    """1 - (1 - p)^3 with p = 0.0228 for two deviations."""
    chance = some_above(np.full((1, 3), 2.0), np.zeros(2))[0]
    assert chance == pytest.approx(1.0 - (1.0 - 0.022750131948) ** 3, rel=1e-9)


@pytest.mark.parametrize("wind", [8.0, 10.0, 14.0, 20.0])
def test_coverage_is_that_of_the_law(wind):
    """Mean foam over horizontal area, in places and at times far apart, within the 25 % that the law is good to.

    A hundred thousand places and more; near the middle, where foam is whitecaps, and on the whole plane. Cells are
    as large beside the waves at any wind.
    """
    surface = surface_of(wind, grid=dataclasses.replace(GRID, cell_size=0.005 * wind**2))
    near = surface.whitecaps.shown > 0.99
    foam, near_foam = np.zeros(2), np.zeros(2)
    for number in range(40):
        f, J = foam_at(surface, 97.0 * number, (5e3 * number, -3e3 * number))
        foam += (f * J).sum(), J.sum()
        near_foam += (f * J)[near].sum(), J[near].sum()
    assert near.sum() > 3000
    assert foam[0] / foam[1] == pytest.approx(whitecap_coverage(wind), rel=0.25)
    assert near_foam[0] / near_foam[1] == pytest.approx(whitecap_coverage(wind), rel=0.25)


@pytest.mark.parametrize("wind", [0.0, 3.9])
def test_no_foam_in_a_light_wind(wind):
    foam, _ = foam_at(surface_of(wind), 10.0)
    assert not foam.any()


def test_coverage_stays_as_the_mesh_leaves_waves_out():
    """Rings of the plane, each with other waves left: W in all of them, the law's 25 % allowed."""
    surface = surface_of(14.0)
    rest = np.abs(undisturbed_positions(GRID, level_anchors(GRID, (0.0, 0.0)))).max(axis=1)
    edges = np.append(GRID.half_extent / 2.0 ** np.arange(4, 0, -1), GRID.half_extent)
    sums = np.zeros((len(edges) - 1, 2))
    for number in range(30):
        f, J = foam_at(surface, 61.0 * number, (7e3 * number, 2e3 * number))
        for ring, (low, high) in enumerate(itertools.pairwise(edges)):
            inside = (rest >= low) & (rest < high)
            sums[ring] += (f * J)[inside].sum(), J[inside].sum()
    assert sums[:, 0] / sums[:, 1] == pytest.approx(whitecap_coverage(14.0), rel=0.25)


def test_the_past_is_the_past():
    """The column of an age holds what the present one held then: the compression sum b A cos(psi) of that time."""
    surface = surface_of(12.0)
    block, waves = surface.whitecaps.block, surface.waves
    anchors = level_anchors(GRID, (0.0, 0.0))
    positions = np.empty((surface.vertex_count, 3), np.float32)
    now = np.empty((surface.vertex_count, block.columns), np.float32)
    then = np.empty_like(now)
    memory = surface.whitecaps.memory
    surface.positions(30.0, Placement(anchors), positions, {block: now})
    surface.positions(30.0 - memory.ages[5], Placement(anchors), positions, {block: then})
    assert now[:, 5] == pytest.approx(memory.decay[5] * then[:, 0], abs=1e-5)
    middle = int(np.argmin(np.abs(undisturbed_positions(GRID, anchors)).sum(axis=1)))
    psi = waves.phase_at(30.0)
    assert now[middle, 0] == pytest.approx(
        float(np.sum(surface.whitecaps.breaking * waves.amplitude * np.cos(psi))), abs=1e-5
    )


def test_foam_is_where_the_water_is_compressed():
    """With one instant, every white place has a smaller Jacobian than the mean of the bare ones."""
    surface = surface_of(15.0, foam=Foam(memory_steps=1))
    foam, J = foam_at(surface, 5.0)
    white = (foam > 0.5) & (surface.whitecaps.shown > 0.99)
    bare = (foam == 0.0) & (surface.whitecaps.shown > 0.99)
    assert white.any()
    assert J[white].max() < J[bare].mean()


def test_a_frame_needs_no_history():
    """Bit for bit, whatever was evaluated before."""
    alone, _ = foam_at(surface_of(15.0), 100 / 24)
    surface = surface_of(15.0)
    for frame in range(1, 100, 7):
        foam_at(surface, frame / 24, (frame, 0.0))
    after, _ = foam_at(surface, 100 / 24)
    assert np.array_equal(alone, after)


def test_a_loop_closes_with_foam():
    surface = surface_of(15.0, loop_period=10.0)
    assert np.array_equal(foam_at(surface, 3.0)[0], foam_at(surface, 13.0)[0])


def test_a_sea_without_breakers_is_uniformly_foamy():
    """Cells too coarse for any wave: what the mesh can not show is left to the mean."""
    surface = surface_of(15.0, grid=Grid(cell_size=500.0, cells=16, levels=2))
    foam, _ = foam_at(surface, 5.0)
    assert foam == pytest.approx(whitecap_coverage(15.0), rel=1e-6)


def crest_size(waves, breaking):
    """sqrt(m_0 / m_2) of the compression's spectrum over wavenumbers, m: crests of a Gaussian sum are as large."""
    energy = (breaking * waves.amplitude) ** 2
    return np.sqrt(energy.sum() / (energy * waves.wavenumber**2).sum())


@pytest.mark.parametrize(
    ("wind", "spectrum"), [(8.0, "pierson_moskowitz"), (19.0, "pierson_moskowitz"), (12.0, "jonswap")]
)
def test_whitecaps_are_not_shown_much_larger_than_they_are(wind, spectrum):
    """Truth: the crests of all waves of the sea. Meshes of which each leaves out longer waves, as from higher and
    higher above: whitecaps are whole up to 1.6 times that size, and from 2.5 times on there are none; JONSWAP's
    sharper peak and the waves that stand for a spectrum change that by a tenth."""
    sea = Sea(systems=(WaveSystem(wind_speed=wind, spectrum=spectrum),), wave_count=512)
    shortest = 2.0 * np.pi / sea_breaker_wavenumber(sea) / 4.0
    natural, seen = None, []
    for factor in 2.0 ** np.arange(0.0, 6.0, 0.5):
        grid = Grid(cell_size=factor * shortest / Grid().samples_per_wavelength, cells=64, levels=1)
        waves = discretise(sea, grid.shortest_wavelength)
        whitecaps = Whitecaps(Foam(), sea, grid, waves)
        size = crest_size(waves, whitecaps.breaking)
        natural = natural or size
        middle = whitecaps.shown.max()
        seen.append(middle)
        assert size < 1.76 * natural or middle < 1.0
        assert size < 2.75 * natural or middle == 0.0
    assert seen[0] == 1.0
    assert seen[-1] == 0.0


@pytest.mark.parametrize("wind", [8.0, 19.0])
def test_all_waves_have_the_variance_of_the_spectrum(wind):
    """Truth: a discretisation keeps the energy of every bin; within a bin the weight changes a little."""
    sea = sea_of(wind, wave_count=512)
    largest = sea_breaker_wavenumber(sea)
    waves = discretise(sea, 2.0 * np.pi / (3.0 * largest))
    variance = 0.5 * np.sum((breaking_weights(waves.wavenumber, largest) * waves.amplitude) ** 2)
    assert sea_breaking_variance(sea, largest) == pytest.approx(variance, rel=0.01)


def test_from_high_above_foam_is_uniform():
    """Cells of 14 m show waves of 56 m and more, but whitecaps in a wind of 14 m/s are a few metres large."""
    foam, _ = foam_at(surface_of(14.0, grid=Grid(cell_size=14.0, cells=64, levels=3)), 5.0)
    assert foam == pytest.approx(whitecap_coverage(14.0), rel=1e-6)


def test_twice_the_coverage_is_twice_the_foam():
    once, twice = (surface_of(12.0, foam=Foam(coverage=factor)) for factor in (1.0, 2.0))
    means = [np.mean([foam_at(s, 50.0 * n, (1e3 * n, 0.0))[0].mean() for n in range(30)]) for s in (once, twice)]
    assert means[1] / means[0] == pytest.approx(2.0, rel=0.15)


def test_settings_out_of_range_are_refused():
    with pytest.raises(OutOfRangeError, match="decay_time is -1"):
        Foam(decay_time=-1.0)


def test_foam_hides_what_its_share_says():
    """Over all values of the texture: foam F is white on 0.9 F of the area and hides it to F, melted or not.

    Far away all of it hides Koepke's 0.4.
    """
    ops, q = NumpyOps(), np.linspace(0.0, 1.0, 20001)
    for F in (0.01, 0.3, 0.6, 1.0):
        for pixel_over_grain in (0.0, 0.1, 10.0):
            near = shading.hidden_share(ops, F, 1.0, 0.01, q, pixel_over_grain).mean()
            assert near == pytest.approx(0.9 * F * F, rel=0.01)
    assert shading.hidden_share(ops, 0.01, 0.0, 0.01, q, 1.0) == pytest.approx(0.004 * np.ones_like(q))
    assert not shading.hidden_share(ops, 0.0, 1.0, 0.01, q[1:], 0.0).any()


def test_filaments_of_a_gaussian_noise_are_spread_evenly():
    """erf by tanh(0.85 z): the share of noise below q is q within 0.02."""
    quantiles = (np.arange(4000) + 0.5) / 4000.0
    grid = np.linspace(-5.0, 5.0, 20001)
    z = np.interp(quantiles, below(grid), grid)
    q = np.sort(shading.filaments(NumpyOps(), shading.NOISE_MEAN + shading.NOISE_DEVIATION * z))
    assert np.abs(q - quantiles).max() < 0.02


def test_whitecaps_reflect_what_koepke_found():
    """Fresh foam of 0.55, thinner with age: 0.22 on average over what is white, within his 0.11."""
    surface = surface_of(12.0)
    near = surface.whitecaps.shown > 0.99
    foam = np.concatenate([foam_at(surface, 50.0 * n, (1e3 * n, 0.0))[0][near] for n in range(30)])
    hidden = 0.9 * (foam.astype(np.float64) ** 2).sum() / foam.sum()
    assert 0.55 * hidden == pytest.approx(0.22, abs=0.11)


def test_foam_is_part_of_an_ocean():
    """Equal settings make equal whitecaps; foam is part of an ocean's fingerprint."""
    ocean = Ocean(sea_of(10.0), GRID, foam=Foam())
    assert ocean.fingerprint != dataclasses.replace(ocean, foam=None).fingerprint
    waves = discretise(ocean.sea, GRID.shortest_wavelength)
    first, second = (Whitecaps(Foam(), ocean.sea, GRID, waves) for _ in range(2))
    assert np.array_equal(first.shown, second.shown)


def test_foam_is_the_same_without_blas():
    """Truth: how products are made does not matter. Instants of the past have complex weights, which the mirrored
    products of a NumPy without BLAS do not take; columns below 1 differ by float32 rounding of their sums."""
    columns, positions = [], []
    for contraction in ("matmul", "einsum"):
        surface = Surface(Ocean(foam=Foam(), sea=Sea(), grid=Grid(cells=64, levels=4)), contraction)
        block = surface.whitecaps.block
        columns.append(np.empty((surface.vertex_count, block.columns), np.float32))
        positions.append(np.empty((surface.vertex_count, 3), np.float32))
        surface.positions(3.7, surface.placement(), positions[-1], {block: columns[-1]})
    assert np.abs(columns[0]).max() > 0.05
    np.testing.assert_allclose(columns[1], columns[0], rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(positions[1], positions[0], rtol=0.0, atol=1e-5)
