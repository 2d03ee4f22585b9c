# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame kernel equals the float64 direct sum of the corrected Eq. 2, everywhere and at any time."""

import dataclasses

import numpy as np
import pytest

from ocean_lod_addon.core.constants import EARTH_RADIUS
from ocean_lod_addon.core.contraction import CONTRACTIONS, fastest_contraction
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.kernel import FrameKernel, ReusedArray
from ocean_lod_addon.core.lod import Grid, level_anchors, tile_sizes, undisturbed_positions
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.waves import WaveSet
from ocean_lod_addon.core.windows import window, window_levels, window_reach

from .plane_tiles import tiles

GRID = Grid(cell_size=0.25, cells=64, levels=6)
SEA = Sea(systems=(WaveSystem(wind_speed=10.0),), wave_count=96)
SIZES = tile_sizes(GRID.cells, GRID.levels)
SIGNIFICANT_HEIGHT = 2.4  # m, of a fully grown sea at 10 m/s, for the tolerances
TIMES = [0.0, 1.25, -20.0, 1e6 / 24.0, 1e6]

FLOAT32_ERROR = 2e-6 * SIGNIFICANT_HEIGHT
"""Float32 sums of 96 waves: each term's rounding is 6e-8 of its amplitude, and they add like sqrt(96)."""

COORDINATE_ROUNDINGS = 5
"""Far out a coordinate is large against the waves, and each addition to it rounds by half its own float32 ulp.

The undisturbed coordinate is the last term of the sum. A BLAS may sum in up to 16 lanes: one addition in its lane
and four to merge the lanes."""


ORIGIN = (0.0, 0.0)
CENTRES = [ORIGIN, (3.3, -7.77), (1e5, -1e5)]


def windowed_direct_sum(grid, waves, anchors, time, x, y):
    """Corrected Eq. 2 at undisturbed points, each wave times its window, straightforwardly, in float64."""
    reach = window_reach(grid, waves.wavelength)
    centre_x, centre_y = anchors[window_levels(grid, waves.wavelength)].T
    window_x = window(np.abs(x[:, None] - centre_x), reach)
    window_y = window(np.abs(y[:, None] - centre_y), reach)
    amplitude = waves.amplitude * window_x * window_y  # (points, waves)
    cos, sin = np.cos(waves.direction), np.sin(waves.direction)
    psi = waves.wavenumber * (np.outer(x, cos) + np.outer(y, sin)) + waves.phase_at(time)
    horizontal = -waves.orbit_ratio * amplitude * np.sin(psi)
    return np.stack(
        [x + (horizontal * cos).sum(-1), y + (horizontal * sin).sum(-1), (amplitude * np.cos(psi)).sum(-1)],
        axis=-1,
    )


def evaluated(kernel, time, anchors, visible=None):
    positions = np.full((kernel.vertex_count, 3), np.nan, np.float32)
    kernel.evaluate(time, anchors, positions, visible)
    return positions


def assert_equal_to_direct_sum(positions, grid, waves, anchors, time):
    x, y = undisturbed_positions(grid, anchors).T
    sample = np.arange(0, len(x), 7)  # all levels and parts, in bearable time
    expected = windowed_direct_sum(grid, waves, anchors, time, x[sample], y[sample])
    rounding = COORDINATE_ROUNDINGS * 0.5 * np.spacing(np.abs(expected).astype(np.float32))
    assert (np.abs(positions[sample] - expected) <= FLOAT32_ERROR + rounding).all()


@pytest.mark.parametrize("centre", CENTRES)
@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("contraction", CONTRACTIONS)
def test_positions_equal_the_direct_sum(contraction, time, centre):
    """At the origin and 100 km out, at time 0 and after eleven days: heights are equally exact everywhere."""
    waves = discretise(SEA, GRID.shortest_wavelength)
    anchors = level_anchors(GRID, centre)
    positions = evaluated(FrameKernel(GRID, waves, contraction), time, anchors)
    assert_equal_to_direct_sum(positions, GRID, waves, anchors, time)


def test_moving_the_plane_leaves_no_trace():
    """A kernel that has been elsewhere gives the same bits as a new one: frames can come in any order."""
    waves = discretise(SEA, GRID.shortest_wavelength)
    travelled = FrameKernel(GRID, waves)
    for centre in ((0.0, 0.0), (0.3, 0.1), (5.0, 900.0), (0.55, 0.1), (-44.0, 3.0)):
        evaluated(travelled, 1.0, level_anchors(GRID, centre))
    anchors = level_anchors(GRID, (17.7, -3.3))
    assert (evaluated(travelled, 2.0, anchors) == evaluated(FrameKernel(GRID, waves), 2.0, anchors)).all()


def looks_along_x():
    """What is ahead of the middle of the plane."""
    return np.arange(SIZES.shape[1])[None, :, None] >= SIZES.shape[1] // 2 + 0 * SIZES


def only_one_tile():
    return np.arange(SIZES.size).reshape(SIZES.shape) == SIZES.size - 1


def every_third():
    return np.arange(SIZES.size).reshape(SIZES.shape) % 3 == 0


@pytest.mark.parametrize("view", [looks_along_x, only_one_tile, every_third])
@pytest.mark.parametrize("contraction", CONTRACTIONS)
def test_unseen_tiles_lie_flat_and_seen_ones_are_unchanged(contraction, view):
    """To the rounding of a sum: a BLAS may add up a small product in another order than a large one.

    An unseen tile that shares a product with seen ones moves with them.
    """
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves, contraction)
    anchors = level_anchors(GRID, (12.0, 8.0))
    visible = view() & (SIZES > 0)
    whole, part = evaluated(kernel, 5.0, anchors), evaluated(kernel, 5.0, anchors, visible)
    still = np.column_stack([undisturbed_positions(GRID, anchors), np.zeros(len(whole))])
    moving = 0
    for number, tile in tiles(GRID):
        moved, there = tile.of(whole), tile.of(part)
        rounding = COORDINATE_ROUNDINGS * np.spacing(np.abs(moved)) + FLOAT32_ERROR
        moves = (np.abs(there - moved) <= (rounding if contraction == "matmul" else 0.0)).all()
        flat = (there == tile.of(still)).all()
        assert moves if visible[number] else moves or flat
        moving += moves
    assert visible.sum() <= moving
    if view is not every_third:
        assert moving <= 1.3 * visible.sum(), "the views that cameras have are left at their edges only"


@pytest.mark.parametrize("curved", [False, True])
@pytest.mark.parametrize("contraction", CONTRACTIONS)
def test_a_reused_array_holds_what_a_new_one_would(contraction, curved):
    """Still water stays where it is until it moves or is seen, and another kernel's is none of ours."""
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel, other = (FrameKernel(GRID, waves, contraction, curved) for _ in range(2))
    reused = ReusedArray(np.full((kernel.vertex_count, 3), np.nan, np.float32))
    numbers = np.arange(SIZES.size).reshape(SIZES.shape)
    everywhere = SIZES > 0
    steps = [
        (kernel, (12.0, 8.0), (numbers % 3 == 0) & everywhere),
        (kernel, (12.0, 8.0), (numbers % 3 == 0) & everywhere),
        (kernel, (12.0, 8.0), (numbers % 3 == 1) & everywhere),
        (kernel, (12.3, 8.0), (numbers % 3 == 1) & everywhere),  # the finest level steps, the coarse ones stay
        (kernel, (90.0, -7.0), (numbers % 2 == 0) & everywhere),
        (kernel, (90.0, -7.0), None),
        (kernel, (90.0, -7.0), (numbers % 2 == 1) & everywhere),
        (other, (3.0, 3.0), (numbers % 5 == 0) & everywhere),
        (kernel, (90.0, -7.0), (numbers % 2 == 1) & everywhere),
        (kernel, (90.0, -7.0), everywhere),
    ]
    for number, (who, centre, visible) in enumerate(steps):
        anchors = level_anchors(GRID, centre)
        who.evaluate(float(number), anchors, reused, visible)
        fresh = evaluated(FrameKernel(GRID, waves, contraction, curved), float(number), anchors, visible)
        assert (reused.array == fresh).all(), f"step {number}"


def test_still_water_is_not_written_again():
    """What nobody but the kernel may do shows that it does not: a mark in a flat tile stays."""
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves)
    reused = ReusedArray(np.empty((kernel.vertex_count, 3), np.float32))
    visible = looks_along_x() & (SIZES > 0)
    anchors = level_anchors(GRID, ORIGIN)
    kernel.evaluate(0.0, anchors, reused, visible)
    reused.array[0] = 99.0
    kernel.evaluate(1.0, anchors, reused, visible)
    assert (reused.array[0] == 99.0).all()
    kernel.evaluate(1.0, level_anchors(GRID, (1.0, 0.0)), reused, visible)
    assert not (reused.array[0] == 99.0).any()


def test_a_wave_limit_keeps_the_longest_waves():
    waves = discretise(SEA, GRID.shortest_wavelength)
    longest = np.argsort(waves.wavelength)[-20:]
    fewer = WaveSet(*(getattr(waves, field.name)[longest] for field in dataclasses.fields(WaveSet)[:7]))
    anchors = level_anchors(GRID, (1.0, 2.0))
    limited = np.empty((GRID.vertex_count, 3), np.float32)
    FrameKernel(GRID, waves).evaluate(4.0, anchors, limited, wave_limit=20)
    assert_equal_to_direct_sum(limited, GRID, fewer, anchors, 4.0)


@pytest.mark.parametrize("centre", CENTRES)
def test_curved_earth_drops_with_the_square_of_distance(centre):
    """Without waves z = -d^2 / (2 R); float32 rounds each of its two terms."""
    anchors = level_anchors(GRID, centre)
    calm = discretise(Sea(systems=(WaveSystem(wind_speed=0.0),)), GRID.shortest_wavelength)
    positions = evaluated(FrameKernel(GRID, calm, curved_earth=True), 0.0, anchors)
    x, y = undisturbed_positions(GRID, anchors).T
    drop = -((x - anchors[0, 0]) ** 2 + (y - anchors[0, 1]) ** 2) / (2 * EARTH_RADIUS)
    assert np.abs(positions[:, 2] - drop).max() <= 2 * np.spacing(np.float32(np.abs(drop).max()))
    waves = discretise(SEA, GRID.shortest_wavelength)
    curved = evaluated(FrameKernel(GRID, waves, curved_earth=True), 3.0, anchors)
    flat = evaluated(FrameKernel(GRID, waves), 3.0, anchors)
    assert np.abs(curved[:, 2] - flat[:, 2] - drop).max() <= FLOAT32_ERROR


def test_anchors_stay_on_their_lattice_and_close_to_their_neighbours():
    random = np.random.default_rng(5)
    spacing = np.array([GRID.spacing(level) for level in range(GRID.levels)])[:, None]
    for centre in random.uniform(-1e5, 1e5, (500, 2)):
        anchors = level_anchors(GRID, centre)
        assert (anchors / spacing == np.round(anchors / spacing)).all()
        assert (np.abs(anchors - centre) <= 0.5 * spacing).all()
        assert (np.abs(np.diff(anchors, axis=0)) <= 0.5 * spacing[1:]).all()


def test_the_surface_has_the_significant_height_it_claims():
    """Guards the tolerance above: 4 times the standard deviation near the centre is about SIGNIFICANT_HEIGHT."""
    waves = discretise(SEA, GRID.shortest_wavelength)
    assert 4 * np.sqrt(0.5 * np.sum(waves.amplitude**2)) == pytest.approx(SIGNIFICANT_HEIGHT, rel=0.02)


def test_evaluation_does_not_depend_on_the_frames_before():
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves)
    anchors = level_anchors(GRID, ORIGIN)
    first, other, again = (evaluated(kernel, time, anchors) for time in (12.5, 99.0, 12.5))
    assert (first == again).all()
    assert not (first == other).all()


def test_calm_sea_is_the_flat_plane():
    waves = discretise(Sea(systems=(WaveSystem(wind_speed=0.0),)), GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves)
    anchors = level_anchors(GRID, ORIGIN)
    positions = evaluated(kernel, 3.0, anchors)
    x, y = undisturbed_positions(GRID, anchors).T
    assert (positions == np.stack([x, y, np.zeros_like(x)], axis=-1)).all()


def test_windows_are_one_inside_and_zero_outside_their_reach():
    distance = np.linspace(0.0, 200.0, 2001)
    values = window(distance, 100.0)
    assert (values[distance <= 50.0] == 1.0).all()
    assert (values[distance >= 100.0] == 0.0).all()
    assert (np.diff(values) <= 0.0).all()


def test_a_wave_has_left_the_geometry_before_the_mesh_is_too_coarse_for_it():
    waves = discretise(SEA, GRID.shortest_wavelength)
    reach = window_reach(GRID, waves.wavelength)
    for level in range(1, GRID.levels):
        nearest = GRID.lines(level)[3 * GRID.cells // 4]
        present = waves.wavelength[reach > nearest]
        assert (present >= GRID.samples_per_wavelength * GRID.spacing(level) * (1 - 1e-12)).all()


def test_the_chosen_contraction_is_one_of_those_tested():
    assert fastest_contraction() in CONTRACTIONS
