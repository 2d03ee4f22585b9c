# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame kernel equals the float64 direct sum of the corrected Eq. 2, everywhere and at any time."""

import numpy as np
import pytest

from ocean_lod_addon.core.contraction import CONTRACTIONS, fastest_contraction
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.lod import Grid, tiles
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.windows import window, window_reach

GRID = Grid(cell_size=0.25, cells=64, levels=6)
SEA = Sea(systems=(WaveSystem(wind_speed=10.0),), wave_count=96)
SIGNIFICANT_HEIGHT = 2.4  # m, of a fully grown sea at 10 m/s, for the tolerances
TIMES = [0.0, 1.25, -20.0, 1e6 / 24.0, 1e6]

FLOAT32_ERROR = 2e-6 * SIGNIFICANT_HEIGHT
"""Float32 sums of 96 waves: each term's rounding is 6e-8 of its amplitude, and they add like sqrt(96)."""

COORDINATE_ROUNDINGS = 5
"""Far out a coordinate is large against the waves, and each addition to it rounds by half its own float32 ulp.

The undisturbed coordinate is the last term of the sum. A BLAS may sum in up to 16 lanes: one addition in its lane
and four to merge the lanes."""


def windowed_direct_sum(grid, waves, time, x, y):
    """Corrected Eq. 2 at undisturbed points, each wave times its window, straightforwardly, in float64."""
    reach = window_reach(grid, waves.wavelength)
    amplitude = (
        waves.amplitude * window(np.abs(x)[:, None], reach) * window(np.abs(y)[:, None], reach)
    )  # (points, waves)
    cos, sin = np.cos(waves.direction), np.sin(waves.direction)
    psi = waves.wavenumber * (np.outer(x, cos) + np.outer(y, sin)) + waves.phase_at(time)
    horizontal = -waves.orbit_ratio * amplitude * np.sin(psi)
    return np.stack(
        [x + (horizontal * cos).sum(-1), y + (horizontal * sin).sum(-1), (amplitude * np.cos(psi)).sum(-1)],
        axis=-1,
    )


def undisturbed(grid):
    """Undisturbed coordinates of all vertices."""
    x, y = np.empty(grid.vertex_count), np.empty(grid.vertex_count)
    for tile in tiles(grid.cells, grid.levels):
        lines = grid.lines(tile.level)
        block = np.meshgrid(
            lines[tile.row_start : tile.row_stop], lines[tile.column_start : tile.column_stop], indexing="ij"
        )
        x[tile.vertices], y[tile.vertices] = (part.ravel() for part in block)
    return x, y


def assert_equal_to_direct_sum(positions, grid, waves, time):
    x, y = undisturbed(grid)
    sample = np.arange(0, len(x), 7)  # all levels and tiles, in bearable time
    expected = windowed_direct_sum(grid, waves, time, x[sample], y[sample])
    rounding = COORDINATE_ROUNDINGS * 0.5 * np.spacing(np.abs(expected).astype(np.float32))
    assert (np.abs(positions[sample] - expected) <= FLOAT32_ERROR + rounding).all()


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("contraction", CONTRACTIONS)
def test_positions_equal_the_direct_sum(contraction, time):
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves, contraction)
    positions = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(time, positions)
    assert_equal_to_direct_sum(positions, GRID, waves, time)


def test_the_surface_has_the_significant_height_it_claims():
    """Guards the tolerance above: 4 times the standard deviation near the centre is about SIGNIFICANT_HEIGHT."""
    waves = discretise(SEA, GRID.shortest_wavelength)
    assert 4 * np.sqrt(0.5 * np.sum(waves.amplitude**2)) == pytest.approx(SIGNIFICANT_HEIGHT, rel=0.02)


def test_evaluation_does_not_depend_on_the_frames_before():
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves)
    first, again, other = (np.empty((kernel.vertex_count, 3), np.float32) for _ in range(3))
    kernel.evaluate(12.5, first)
    kernel.evaluate(99.0, other)
    kernel.evaluate(12.5, again)
    assert (first == again).all()
    assert not (first == other).all()


def test_calm_sea_is_the_flat_plane():
    waves = discretise(Sea(systems=(WaveSystem(wind_speed=0.0),)), GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves)
    positions = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(3.0, positions)
    x, y = undisturbed(GRID)
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
