# SPDX-License-Identifier: GPL-3.0-or-later
"""The kernel's further columns: velocities and derivatives are those of the float64 direct sum (core.gerstner)."""

import dataclasses

import numpy as np
import pytest

from ocean_lod_addon.core.column_blocks import POSITION, TANGENTS, VELOCITY
from ocean_lod_addon.core.constants import EARTH_RADIUS
from ocean_lod_addon.core.contraction import CONTRACTIONS
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.lod import Grid, level_anchors, undisturbed_positions
from ocean_lod_addon.core.normals import surface_normals
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.waves import WaveSet
from ocean_lod_addon.core.windows import window, window_levels, window_reach

from .plane_tiles import no_tile

GRID = Grid(cell_size=0.25, cells=64, levels=6)
SEA = Sea(systems=(WaveSystem(wind_speed=10.0),), wave_count=96)
CENTRES = [(0.0, 0.0), (1e5, -1e5)]
SMALL_ROUNDING = 4e-6
"""Float32 sums of 96 waves: each term's rounding is 6e-8 of it, they add like sqrt(96), and their sum is of order
1 for the derivatives (its largest term is the 1 of still water) and of a few m/s for the velocity."""


def windowed(grid, waves, anchors, x, y):
    """The waves with the amplitudes that the windows leave them at the point (x, y)."""
    reach = window_reach(grid, waves.wavelength)
    centre = anchors[window_levels(grid, waves.wavelength)]
    faded = waves.amplitude * window(np.abs(x - centre[:, 0]), reach) * window(np.abs(y - centre[:, 1]), reach)
    return dataclasses.replace(waves, amplitude=faded)


def evaluated(kernel, time, anchors, block, visible=None):
    out = np.full((kernel.vertex_count, block.columns), np.nan, np.float32)
    positions = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(time, anchors, positions, visible, more={block: out})
    return out


def direct(waves, anchors, time, sample):
    """surface_points at some vertices, windows taken as constant around each."""
    where = undisturbed_positions(GRID, anchors)[sample]
    return [surface_points(windowed(GRID, waves, anchors, x, y), x, y, time) for x, y in where]


def five(points):
    return np.array([[*p.tangent_x[:2], p.tangent_y[1], p.tangent_x[2], p.tangent_y[2]] for p in points])


@pytest.mark.parametrize("centre", CENTRES)
@pytest.mark.parametrize("contraction", CONTRACTIONS)
def test_velocities_and_derivatives_equal_the_direct_sum(contraction, centre):
    waves = discretise(SEA, GRID.shortest_wavelength)
    anchors = level_anchors(GRID, centre)
    kernel = FrameKernel(GRID, waves, contraction)
    sample = np.arange(0, GRID.vertex_count, 97)
    points = direct(waves, anchors, 1e5, sample)
    velocity = np.array([p.velocity for p in points])
    assert np.abs(velocity).max() > 1.0
    difference = evaluated(kernel, 1e5, anchors, VELOCITY)[sample] - velocity
    assert np.abs(difference).max() < SMALL_ROUNDING * np.abs(velocity).max()
    difference = evaluated(kernel, 1e5, anchors, TANGENTS)[sample] - five(points)
    assert np.abs(difference).max() < SMALL_ROUNDING


def test_normals_equal_the_direct_sum():
    waves = discretise(SEA, GRID.shortest_wavelength)
    anchors = level_anchors(GRID, (0.0, 0.0))
    sample = np.arange(0, GRID.vertex_count, 97)
    points = direct(waves, anchors, 3.0, sample)
    assert min(p.jacobian for p in points) > 0.0
    normals = np.empty((GRID.vertex_count, 3), np.float32)
    surface_normals(evaluated(FrameKernel(GRID, waves), 3.0, anchors, TANGENTS), normals)
    assert np.abs(normals[sample] - [p.normal for p in points]).max() < SMALL_ROUNDING


def test_normals_point_out_of_the_water_where_it_folds_over_and_up_at_a_cusp():
    """One trochoid of k A = 1.5 at its crest: J = 1 - 1.5 < 0, flat, the loop's top. At k A = 1 it is a cusp."""
    crests = []
    for steepness in (0.5, 1.0, 1.5):
        wave = WaveSet([steepness], [1.0], [3.0], [0.0], [0.0], [1.0], [0])
        point = surface_points(wave, 0.0, 0.0, 0.0)
        assert point.jacobian == pytest.approx(1.0 - steepness)
        crests.append(five([point])[0])
    normals = np.empty((3, 3), np.float32)
    surface_normals(np.float32(crests), normals)
    assert (normals == [0.0, 0.0, 1.0]).all()


def test_columns_that_are_not_asked_for_change_nothing_and_are_not_kept():
    waves = discretise(SEA, GRID.shortest_wavelength)
    anchors = level_anchors(GRID, (3.0, 4.0))
    alone, with_more = np.empty((2, GRID.vertex_count, 3), np.float32)
    kernel = FrameKernel(GRID, waves)
    kernel.evaluate(2.0, anchors, alone)
    assert kernel.blocks == {POSITION}
    velocity = np.empty((GRID.vertex_count, 3), np.float32)
    kernel.evaluate(2.0, anchors, with_more, more={VELOCITY: velocity})
    assert kernel.blocks == {POSITION, VELOCITY}
    assert (alone == with_more).all()


def test_columns_leave_no_trace_of_earlier_places():
    waves = discretise(SEA, GRID.shortest_wavelength)
    travelled = FrameKernel(GRID, waves)
    evaluated(travelled, 1.0, level_anchors(GRID, (900.0, 5.0)), TANGENTS)
    evaluated(travelled, 1.0, level_anchors(GRID, (0.3, 0.1)), VELOCITY)
    anchors = level_anchors(GRID, (17.7, -3.3))
    for block in (TANGENTS, VELOCITY):
        new = evaluated(FrameKernel(GRID, waves), 2.0, anchors, block)
        assert (evaluated(travelled, 2.0, anchors, block) == new).all()


def test_unseen_tiles_are_still_water():
    waves = discretise(SEA, GRID.shortest_wavelength)
    kernel = FrameKernel(GRID, waves)
    anchors = level_anchors(GRID, (0.0, 0.0))
    nothing = no_tile(GRID)
    assert not evaluated(kernel, 2.0, anchors, VELOCITY, nothing).any()
    assert (evaluated(kernel, 2.0, anchors, TANGENTS, nothing) == [1.0, 0.0, 1.0, 0.0, 0.0]).all()


@pytest.mark.parametrize("centre", CENTRES)
def test_a_curved_earth_slopes_away_from_below_the_camera(centre):
    """z = -d^2 / (2 R) has the slope -d / R."""
    calm = discretise(Sea(systems=(WaveSystem(wind_speed=0.0),)), GRID.shortest_wavelength)
    anchors = level_anchors(GRID, centre)
    tangents = evaluated(FrameKernel(GRID, calm, curved_earth=True), 0.0, anchors, TANGENTS)
    expected = -(undisturbed_positions(GRID, anchors) - anchors[0]) / EARTH_RADIUS
    rounding = 2.0 * np.spacing(np.float32(np.abs(expected).max()))
    assert np.abs(tangents[:, 3:] - expected).max() <= rounding


def test_what_the_windows_own_slope_leaves_out_is_within_its_bound():
    """Derivatives of the windowed surface by central differences in float64, against windows held constant.

    The bound of column_blocks for the part that is left out of a fading wave's slope, by default
    15 samples_per_wavelength / (2 pi cells), is its own slope's peak over peak, here of one wave along x.
    """
    wavelength, amplitude = 4.0, 0.05
    k = 2.0 * np.pi / wavelength
    reach = window_reach(GRID, wavelength)
    x = np.linspace(0.5 * reach, reach, 4001)
    step = 1e-4

    def height(at):
        return amplitude * window(np.abs(at), reach) * np.cos(k * at)

    whole = (height(x + step) - height(x - step)) / (2.0 * step)
    held = -k * amplitude * window(x, reach) * np.sin(k * x)
    bound = 15.0 * GRID.samples_per_wavelength / (2.0 * np.pi * GRID.cells) * k * amplitude
    worst = np.abs(whole - held).max()
    assert 0.5 * bound < worst < 1.001 * bound
