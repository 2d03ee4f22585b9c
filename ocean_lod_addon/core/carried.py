# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the long waves have carried the water of each tile at one moment, and how far short ones may beyond that.

All waves together can lift water anywhere by some times their rms height. But at a known time a wave that is long
beside a tile moves all of it alike: over a distance r from the tile's centre its phase changes by k r at most, and
its displacement by less than the k r-th part of its amplitude. So the sum of such waves at the centre says where
the tile is, and only the rest is left to chance.
"""

import functools
import itertools
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
    """Of each tile: `shift` (tiles, 3) m by waves that carry the whole of it, and a bound on what all others add
    to that: `highest` (tiles,) m up and down, and `orbit_ratio` times as far sideways."""

    shift: np.ndarray
    highest: np.ndarray
    orbit_ratio: float


@dataclass(frozen=True, eq=False)
class _LevelTiles:
    """Where the tiles of a level are, in cells from its anchor: they stand in rows and columns.

    here     which tiles these are
    radius   from the centre of the largest to the corner of what belongs to it
    centres  of the rows, and of the columns
    places   of each tile: its row, and its column
    """

    here: slice
    radius: float
    centres: tuple[np.ndarray, np.ndarray]
    places: tuple[np.ndarray, np.ndarray]


def highest_wave(waves: WaveSet) -> float:
    """Bound on the heights of crests and depths of troughs, m."""
    return float(_bound(0.5 * np.sum(waves.amplitude**2)))


def carried_at_any_time(grid: Grid, waves: WaveSet) -> Carried:
    """What may be said without a time: every wave anywhere."""
    tiles = len(tile_table(grid.cells, grid.levels).level)
    orbit_ratio = float(waves.orbit_ratio.max(initial=0.0))
    return Carried(np.zeros((tiles, 3)), np.full(tiles, highest_wave(waves)), orbit_ratio)


def carried(grid: Grid, anchors: np.ndarray, waves: WaveSet, time: float) -> Carried:
    """Where the tiles of a plane at level anchors (levels, 2) m are at a `time` in s."""
    result = carried_at_any_time(grid, waves)
    anywhere = result.highest.max()
    phases, k = waves.phase_at(time), waves.wavenumber
    heading = np.stack([np.cos(waves.direction), np.sin(waves.direction)])
    reach = window_reach(grid, waves.wavelength) * FADE_START
    for level, tiles in enumerate(_levels(grid.cells, grid.levels)):
        radius = tiles.radius * grid.spacing(level)
        carries = (k * radius < _MOST_TURN) & (reach >= _furthest(grid, anchors, level))
        if radius > anywhere or not carries.any():
            break  # tiles of coarser levels are larger yet: waves hardly change which of them are seen
        at_anchor = np.mod(phases + anchors[level] @ (k * heading), 2.0 * np.pi)
        result.shift[tiles.here] = _displacement(tiles, grid.spacing(level), waves, heading, at_anchor, carries)
        unknown = np.where(carries, 1.0 - np.cos(k * radius), 0.5)
        result.highest[tiles.here] = _bound(np.sum(unknown * waves.amplitude**2))
    return result


def _bound(variance):
    """The largest height above or below 0 of a sum of waves of this variance in m^2."""
    return _HIGHEST_WAVE * 4.0 * np.sqrt(variance)


@functools.lru_cache(maxsize=32)
def _levels(cells, levels):
    table, result = tile_table(cells, levels), []
    ends = np.searchsorted(table.level, np.arange(levels + 1)).tolist()
    for here in itertools.starmap(slice, itertools.pairwise(ends)):
        halves, centres, places = [], [], []
        for first, past in ((table.row_start, table.row_stop), (table.column_start, table.column_stop)):
            halves.append(0.5 * (past - first - 1)[here].max() + RIM)
            twice, place = np.unique((first + past - 1)[here], return_inverse=True)
            centres.append(0.5 * twice - cells // 2)
            places.append(place)
        result.append(_LevelTiles(here, float(np.hypot(*halves)), tuple(centres), tuple(places)))
    return tuple(result)


def _furthest(grid, anchors, level):
    """The furthest that a line of a level is from the centre of any wave's window, m."""
    return grid.spacing(level) * (0.5 * grid.cells + RIM) + np.abs(anchors - anchors[level]).max()


def _displacement(tiles, spacing, waves, heading, phases, chosen):
    """The chosen waves' sum (corrected Eq. 2) at the centres of a level's tiles, (tiles here, 3) m.

    `phases` are those at the level's anchor. Along rows and columns the phase separates as it does in core.kernel.
    """
    heading, C = heading[:, chosen], waves.orbit_ratio[chosen]
    along = waves.wavenumber[chosen] * heading * spacing
    P, Q = (_phasors(np.outer(centres, turn)) for centres, turn in zip(tiles.centres, along, strict=True))
    P *= waves.amplitude[chosen].astype(np.float32) * _phasors(phases[chosen])
    weights = (1j * C * heading[0], 1j * C * heading[1], np.ones_like(C))
    sums = [(P * weight.astype(np.complex64)) @ Q.T for weight in weights]
    return np.stack([each.real[tiles.places] for each in sums], axis=-1)


def _phasors(phases):
    """exp(i phase); in float32, whose sines are many times as fast and good to a millionth of the amplitude."""
    phases = phases.astype(np.float32)
    return np.cos(phases) + np.complex64(1j) * np.sin(phases)
