# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the long waves have carried the water of each tile at one moment, and how far short ones may beyond that.

All waves together can lift water anywhere by some times their rms height. But at a known time a wave that is long
beside a tile moves all of it alike: over a distance r from the tile's centre its phase changes by k r at most, and
its displacement by less than the k r-th part of its amplitude. So the sum of such waves at the centre says where
the tile is, and only the rest is left to chance.
"""

from dataclasses import dataclass

import numpy as np

from .lod import Grid, tile_table
from .waves import WaveSet
from .windows import FADE_START, window_reach

_HIGHEST_WAVE = 1.25
"""Bound on a crest over the significant height. In a Gaussian sea exp(-8 r^2), four in a million, exceed it."""

_MOST_TURN = np.pi / 3.0
"""rad from a tile's centre to its rim: beyond this 1 - cos exceeds the 1/2 of a wave of which nothing is known."""

RIM = 1.5
"""Cells around a tile that belong to it, as far as they are seen: those that join it to other levels."""


@dataclass(frozen=True, eq=False)
class Carried:
    """Of each tile: `shift` (tiles, 3) m by waves that carry the whole of it, and bounds on what all others add to
    that: `highest` up and down and `reach` sideways, (tiles,) m."""

    shift: np.ndarray
    highest: np.ndarray
    reach: np.ndarray


def highest_wave(waves: WaveSet) -> float:
    """Bound on the heights of crests and depths of troughs, m."""
    return float(_bound(0.5 * np.sum(waves.amplitude**2)))


def carried_at_any_time(grid: Grid, waves: WaveSet) -> Carried:
    """What may be said without a time: every wave anywhere."""
    tiles = len(tile_table(grid.cells, grid.levels).level)
    highest = np.full(tiles, highest_wave(waves))
    return Carried(np.zeros((tiles, 3)), highest, highest * waves.orbit_ratio.max(initial=0.0))


def carried(grid: Grid, anchors: np.ndarray, waves: WaveSet, time: float) -> Carried:
    """Where the tiles of a plane at level anchors (levels, 2) m are at a `time` in s."""
    anywhere = carried_at_any_time(grid, waves)
    shift, highest = anywhere.shift, anywhere.highest
    table = tile_table(grid.cells, grid.levels)
    phases, k = waves.phase_at(time), waves.wavenumber
    reach = window_reach(grid, waves.wavelength) * FADE_START
    for level in range(grid.levels):
        here = table.level == level
        radius = _radius(grid, table, here, level)
        carries = (k * radius < _MOST_TURN) & (reach >= _furthest(grid, anchors, level))
        if radius > anywhere.highest[0] or not carries.any():
            break  # tiles of coarser levels are larger yet: waves hardly change which of them are seen
        at_anchor = np.mod(phases + anchors[level] @ (k * _heading(waves)), 2.0 * np.pi)
        shift[here] = _displacement(grid, waves, at_anchor, carries, table, here, level)
        unknown = np.where(carries, 1.0 - np.cos(k * radius), 0.5)
        highest[here] = _bound(np.sum(unknown * waves.amplitude**2))
    return Carried(shift, highest, highest * waves.orbit_ratio.max(initial=0.0))


def _bound(variance):
    """The largest height above or below 0 of a sum of waves of this variance in m^2."""
    return _HIGHEST_WAVE * 4.0 * np.sqrt(variance)


def _heading(waves):
    return np.stack([np.cos(waves.direction), np.sin(waves.direction)])


def _radius(grid, table, here, level):
    """From the centre of a level's largest tile to the corner of what belongs to it, m."""
    rows = (table.row_stop - table.row_start)[here].max() - 1
    columns = (table.column_stop - table.column_start)[here].max() - 1
    return grid.spacing(level) * np.hypot(0.5 * rows + RIM, 0.5 * columns + RIM)


def _furthest(grid, anchors, level):
    """The furthest that a line of a level is from the centre of any wave's window, m."""
    return grid.spacing(level) * (0.5 * grid.cells + RIM) + np.abs(anchors - anchors[level]).max()


def _displacement(grid, waves, phases, chosen, table, here, level):
    """The chosen waves' sum (corrected Eq. 2) at the centres of a level's tiles, (tiles here, 3) m.

    `phases` are those at the level's anchor. Centres stand in rows and columns, along which the phase separates as
    it does in core.kernel.
    """
    heading, C = _heading(waves)[:, chosen], waves.orbit_ratio[chosen]
    factors, places = [], []
    for first, past, along in zip(
        (table.row_start, table.column_start),
        (table.row_stop, table.column_stop),
        waves.wavenumber[chosen] * heading,
        strict=True,
    ):
        twice, place = np.unique((first + past)[here] - 1, return_inverse=True)
        factors.append(_phasors(np.outer((0.5 * twice - grid.cells // 2) * grid.spacing(level), along)))
        places.append(place)
    P, Q = factors[0] * (waves.amplitude[chosen] * _phasors(phases[chosen])), factors[1].T
    weights = (1j * C * heading[0], 1j * C * heading[1], 1.0)
    return np.stack([((P * weight) @ Q).real[places[0], places[1]] for weight in weights], axis=-1)


def _phasors(phases):
    """exp(i phase); in float32, whose sines are many times as fast and good to a millionth of the amplitude."""
    phases = phases.astype(np.float32)
    return np.cos(phases) + np.complex64(1j) * np.sin(phases)
