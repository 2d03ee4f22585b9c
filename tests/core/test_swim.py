# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface does not swim: under a moving camera, points of a stopped sea keep their height."""

import numpy as np
import pytest

from ocean_lod_addon.core.lod import Grid, level_anchors, undisturbed_positions
from ocean_lod_addon.core.ocean import Ocean, Surface
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.swim import dolly_and_pan, heights_of_mesh, measure, windowed_heights

SURFACE = Surface(
    Ocean(Sea(systems=(WaveSystem(wind_speed=10.0),)), Grid(cell_size=0.06, cells=256, levels=8))
)


def points(count):
    random = np.random.default_rng(3)
    distance = np.exp(random.uniform(np.log(2.0), np.log(500.0), count))
    bearing = random.uniform(-np.pi, np.pi, count)
    return distance * np.cos(bearing), distance * np.sin(bearing)


def test_swim_is_below_one_percent_of_the_significant_height():
    """The bound of the project's goal. 20 of the command's 200 frames, to be quick."""
    report = measure(SURFACE, dolly_and_pan(20, speed=0.5), *points(300), time=7.0)
    assert report.swim_max < 0.01
    assert report.interpolation_rms < 0.01


def test_the_measure_sees_a_sliding_lattice():
    """If the lattice slid with the camera instead, the same measure would find several times the swim."""
    x, y = points(300)
    grid = SURFACE.ocean.grid
    z = np.empty((SURFACE.vertex_count, 3), np.float32)
    errors = []
    for shift in np.linspace(0.0, 4.0, 8):
        anchors = level_anchors(grid, (0.0, 0.0)) + shift
        SURFACE._kernel.evaluate(7.0, anchors, z)
        drawn = heights_of_mesh(grid, anchors, z[:, 2], x, y)
        errors.append(drawn - windowed_heights(SURFACE, anchors, 7.0, x, y))
    sliding = np.ma.masked_invalid(errors)
    slide = float(np.sqrt(((sliding - sliding.mean(axis=0)) ** 2).mean()))
    anchored = measure(SURFACE, dolly_and_pan(8, speed=0.5, pan=0.0), x, y, time=7.0)
    assert slide > 3 * anchored.swim_rms * anchored.significant_wave_height


@pytest.mark.parametrize("centre", [(0.0, 0.0), (13.37, -4.2)])
def test_heights_at_vertices_are_the_vertices_own(centre):
    anchors = level_anchors(SURFACE.ocean.grid, centre)
    z = np.random.default_rng(1).normal(size=SURFACE.vertex_count)
    rest = undisturbed_positions(SURFACE.ocean.grid, anchors)
    inner = slice(0, 5000)
    heights = heights_of_mesh(SURFACE.ocean.grid, anchors, z, rest[inner, 0], rest[inner, 1])
    known = np.isfinite(heights)
    assert known.mean() > 0.9
    # Dividing a coordinate by the spacing rounds: the neighbour gets a share of 1e-12.
    assert heights[known] == pytest.approx(z[inner][known], abs=1e-9)
