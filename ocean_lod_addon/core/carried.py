# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the long waves have carried the water of each tile at one moment, and how far short ones may beyond that.

All waves together can lift water anywhere by some times their rms height. But at a known time a wave that is long
beside a tile moves all of it alike: over a distance r from the tile's centre its phase changes by k r at most, and
its displacement by less than the k r-th part of its amplitude. So the sum of such waves at the centre says where
the tile is, and only the rest is left to chance.
"""

import functools
import itertools
from dataclasses import dataclass, replace

import numpy as np

from .lod import Grid, tile_table
from .waves import WaveSet
from .windows import FADE_START, furthest_shift, window_levels, window_reach

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
class _Carriers:
    """What does not change with time: the waves that carry the tiles of each level where there are such waves.

    wave_vectors  (2, waves) rad/m, of all waves
    levels        from the innermost on
    unmoved       all that is known of the tiles, but for the shift
    """

    wave_vectors: np.ndarray
    levels: tuple["_LevelCarriers", ...]
    unmoved: Carried


@dataclass(frozen=True, eq=False)
class _LevelCarriers:
    """Tiles stand in rows and columns, along which phases separate as in core.kernel: the factors of a product.

    here    which tiles these are
    waves   those that carry all of them, by number
    along   (rows, waves) complex64, from the level's anchor to the centres of rows
    across  (2 waves, 3 columns) float32, on to those of columns, for x, y and z
    places  of each tile, the row times the number of columns plus the column
    """

    here: slice
    waves: np.ndarray
    along: np.ndarray
    across: np.ndarray
    places: np.ndarray


def highest_wave(waves: WaveSet) -> float:
    """Bound on the heights of crests and depths of troughs, m."""
    return float(_bound(0.5 * np.sum(waves.amplitude**2)))


def carried_at_any_time(grid: Grid, waves: WaveSet) -> Carried:
    """What may be said without a time: every wave anywhere."""
    tiles = len(tile_table(grid.cells, grid.levels).level)
    orbit_ratio = float(waves.orbit_ratio.max(initial=0.0))
    return Carried(np.zeros((tiles, 3)), np.full(tiles, highest_wave(waves)), orbit_ratio)


def carried(grid: Grid, anchors: np.ndarray, waves: WaveSet, time: float) -> Carried:
    """Where the tiles of a plane at level anchors (levels, 2) m, of lod.level_anchors, are at a `time` in s."""
    carriers = _carriers(grid, waves)
    shift = np.zeros_like(carriers.unmoved.shift)
    if carriers.levels:
        at_anchors = waves.phase_at(time) + anchors[: len(carriers.levels)] @ carriers.wave_vectors
        phasors = waves.amplitude.astype(np.float32) * _phasors(np.mod(at_anchors, 2.0 * np.pi))
        for level, phasor in zip(carriers.levels, phasors, strict=True):
            centres = (level.along * phasor[level.waves]).view(np.float32) @ level.across
            shift[level.here] = centres.reshape(-1, 3)[level.places]
    return replace(carriers.unmoved, shift=shift)


def _bound(variance):
    """The largest height above or below 0 of a sum of waves of this variance in m^2."""
    return _HIGHEST_WAVE * 4.0 * np.sqrt(variance)


@functools.lru_cache(maxsize=8)
def _carriers(grid, waves):
    heading = np.stack([np.cos(waves.direction), np.sin(waves.direction)])
    unmoved, levels = carried_at_any_time(grid, waves), []
    anywhere, wave_levels = unmoved.highest.max(), window_levels(grid, waves.wavelength)
    table = tile_table(grid.cells, grid.levels)
    ends = np.searchsorted(table.level, np.arange(grid.levels + 1)).tolist()
    for number, here in enumerate(itertools.starmap(slice, itertools.pairwise(ends))):
        halves, centres, places = zip(*_rows_and_columns(table, here, grid, number), strict=True)
        radius = np.hypot(*halves)
        turn = waves.wavenumber * radius
        furthest = grid.spacing(number) * (0.5 * grid.cells + RIM) + furthest_shift(grid, number, wave_levels)
        whole = window_reach(grid, waves.wavelength) * FADE_START >= furthest
        carry = whole & (turn < _MOST_TURN)
        if radius > anywhere or not carry.any():
            break  # tiles of coarser levels are larger yet: waves hardly change which of them are seen
        unknown = np.where(carry, 1.0 - np.cos(turn), 0.5)
        unmoved.highest[here] = _bound(np.sum(unknown * waves.amplitude**2))
        place = places[0] * len(centres[1]) + places[1]
        factors = _factors(waves, heading, carry, *centres)
        levels.append(_LevelCarriers(here, np.flatnonzero(carry), *factors, place))
    return _Carriers(waves.wavenumber * heading, tuple(levels), unmoved)


def _rows_and_columns(table, here, grid, level):
    """Of a level's tiles, along either axis: half the length of the longest with its rim, the centres that there
    are, from the level's anchor, both in m, and the number of that of each tile."""
    spacing = grid.spacing(level)
    for first, past in ((table.row_start, table.row_stop), (table.column_start, table.column_stop)):
        half = 0.5 * (past - first - 1)[here].max() + RIM
        twice, place = np.unique((first + past - 1)[here], return_inverse=True)
        yield half * spacing, (0.5 * twice - grid.cells // 2) * spacing, place


def _factors(waves, heading, carry, rows, columns):
    """`along` and `across` of `_LevelCarriers`, by corrected Eq. 2."""
    C, (x, y) = waves.orbit_ratio[carry], heading[:, carry]
    k = waves.wavenumber[carry]
    along, across = _phasors(np.outer(rows, k * x)), _phasors(np.outer(k * y, columns))
    weights = np.stack([1j * C * x, 1j * C * y, np.ones_like(C)], axis=-1)
    weighted = (across[:, :, None] * weights[:, None, :]).astype(np.complex64)  # (waves, columns, 3)
    return along, np.stack([weighted.real, -weighted.imag], axis=1).reshape(2 * len(k), -1)


def _phasors(phases):
    """exp(i phase); in float32, whose sines are many times as fast and good to a millionth of the amplitude."""
    phases = phases.astype(np.float32)
    return np.cos(phases) + np.complex64(1j) * np.sin(phases)
