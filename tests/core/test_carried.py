# SPDX-License-Identifier: GPL-3.0-or-later
"""Where waves have carried the tiles at a known time, against the surface that the frame kernel makes."""

import dataclasses

import numpy as np
import pytest

from ocean_lod_addon.core.camera_view import visible_tiles
from ocean_lod_addon.core.carried import carried, carried_at_any_time
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.framing import Framing
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.lod import Grid, level_anchors, undisturbed_positions
from ocean_lod_addon.core.placement import place
from ocean_lod_addon.core.sea import Sea, WaveSystem

from .cameras import camera, projected_inside
from .plane_tiles import tiles

GRID = Grid(cell_size=0.03, cells=128, levels=9)
WAVES = discretise(Sea(systems=(WaveSystem(wind_speed=12.0),), wave_count=64), GRID.shortest_wavelength)
MOMENTS = (0.0, 12.3, -1e5)
CENTRE = (-40.0, 1e4)


def displaced(waves, anchors, time):
    """Displacements (vertices, 3) m, and positions (vertices, 3) m."""
    kernel = FrameKernel(GRID, waves)
    positions = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(time, anchors, positions)
    still = np.column_stack([undisturbed_positions(GRID, anchors), np.zeros(kernel.vertex_count)])
    return positions - still, positions


@pytest.mark.parametrize("moment", MOMENTS)
def test_every_vertex_is_where_its_tile_was_carried(moment):
    """Bounds are five standard deviations: none of these some 10^5 vertices may be further off."""
    anchors = level_anchors(GRID, CENTRE)
    there = carried(GRID, anchors, WAVES, moment)
    displacement, _ = displaced(WAVES, anchors, moment)
    for number, tile in tiles(GRID):
        off = tile.of(displacement).copy()
        if tile.level < len(there.shift):
            off -= there.shift[number]
        sideways = np.hypot(off[..., 0], off[..., 1]) / there.orbit_ratio
        assert np.hypot(sideways, off[..., 2]).max() <= there.highest[tile.level]


def test_one_long_wave_is_known_exactly_at_the_middle_of_a_tile():
    """The longest wave, 2 m high, and tiles of 1 m that ride it: the middle vertex of a tile with an odd number of
    lines has just the shift, to the millionth of the amplitude that float32 gives."""
    longest = int(np.argmax(WAVES.wavelength))
    one = {
        field.name: np.atleast_1d(getattr(WAVES, field.name)[longest])
        for field in dataclasses.fields(WAVES)
        if field.name != "loop_period"
    }
    wave = dataclasses.replace(WAVES, **one | {"amplitude": 2.0})
    anchors = level_anchors(GRID, (0.0, 0.0))
    there = carried(GRID, anchors, wave, 7.0)
    displacement, _ = displaced(wave, anchors, 7.0)
    odd = [
        (number, tile) for number, tile in tiles(GRID) if tile.level == 0 and all(side % 2 for side in tile.shape)
    ]
    assert odd
    for number, tile in odd:
        rows, columns = tile.shape
        middle = tile.of(displacement)[rows // 2, columns // 2]
        assert middle == pytest.approx(there.shift[number], abs=4e-6 * wave.amplitude[0])


def test_nothing_that_is_in_frame_at_a_moment_is_left_out_and_less_is_seen_than_at_any():
    """Vertices at the moment, projected; a low camera in a sea whose crests are above it."""
    view = camera(height=1.7, heading=0.4)
    always = place(GRID, Framing(), WAVES, view, final=True)
    fewer = 0
    for moment in MOMENTS:
        now = place(GRID, Framing(), WAVES, view, True, moment)
        _, positions = displaced(WAVES, now.anchors, moment)
        inside = projected_inside(view, positions.astype(np.float64))
        for number, tile in tiles(GRID):
            assert now.visible[number] or not tile.of(inside).any()
        assert not (now.visible & ~always.visible).any()
        fewer += (always.visible & ~now.visible).sum()
    assert fewer > 0


def test_waves_that_are_lower_than_tiles_are_long_need_not_be_followed():
    """What is known of the tiles then is what is known at any time, and costs nothing."""
    ripples = dataclasses.replace(WAVES, amplitude=1e-3 * WAVES.amplitude)
    anchors = level_anchors(GRID, (0.0, 0.0))
    planes = np.array([[1.0, 0.0, 0.0, 0.0]])
    now, always = carried(GRID, anchors, ripples, 3.0), carried_at_any_time(GRID, ripples)
    assert (now.highest == always.highest).all()
    assert not now.shift.size
    assert (visible_tiles(GRID, anchors, planes, now) == visible_tiles(GRID, anchors, planes, always)).all()
