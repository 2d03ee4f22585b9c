# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the long waves have carried the water of each tile at one moment, and how far short ones may beyond that.

All waves together can lift water anywhere by some times their rms height. But at a known time a wave that is long
beside a tile moves all of it alike: over a distance r from the tile's centre its phase changes by k r at most, and
its displacement by less than the k r-th part of its amplitude. So the sum of such waves at the centre says where
the tile is, and only the rest is left to chance.
"""

import functools
from dataclasses import dataclass, replace

import numpy as np

from .lod import Grid, tile_sides
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
    """Of the tiles: `shift` (levels, tiles in a column, tiles in a row, 3) m by waves that carry the whole of
    each, for as many of the innermost levels as have such waves, and a bound on what all others add to that:
    `highest` (levels,) m up and down, and `orbit_ratio` times as far sideways."""

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

    waves   those that carry all of the tiles, by number
    along   (rows, waves) complex64, from the level's anchor to the middles of rows
    across  (2 waves, 3 columns) float32, on to those of columns, for x, y and z
    """

    waves: np.ndarray
    along: np.ndarray
    across: np.ndarray


def highest_wave(waves: WaveSet) -> float:
    """Bound on the heights of crests and depths of troughs, m."""
    return float(_bound(0.5 * np.sum(waves.amplitude**2)))


def carried_at_any_time(grid: Grid, waves: WaveSet) -> Carried:
    """What may be said without a time: every wave anywhere."""
    tiles = len(tile_sides(grid.cells)[0])
    shift = np.zeros((0, tiles, tiles, 3), np.float32)
    return Carried(shift, np.full(grid.levels, highest_wave(waves)), float(waves.orbit_ratio.max(initial=0.0)))


def carried(grid: Grid, anchors: np.ndarray, waves: WaveSet, time: float) -> Carried:
    """Where the tiles of a plane at level anchors (levels, 2) m, of lod.level_anchors, are at a `time` in s."""
    carriers = _carriers(grid, waves)
    shift = np.empty((len(carriers.levels), *carriers.unmoved.shift.shape[1:]), np.float32)
    if carriers.levels:
        at_anchors = waves.phase_at(time) + anchors[: len(carriers.levels)] @ carriers.wave_vectors
        phasors = waves.amplitude.astype(np.float32) * _phasors(np.mod(at_anchors, 2.0 * np.pi))
        for level, phasor, shifts in zip(carriers.levels, phasors, shift, strict=True):
            shifts[:] = ((level.along * phasor[level.waves]).view(np.float32) @ level.across).reshape(shifts.shape)
    return replace(carriers.unmoved, shift=shift)


def _bound(variance):
    """The largest height above or below 0 of a sum of waves of this variance in m^2."""
    return _HIGHEST_WAVE * 4.0 * np.sqrt(variance)


@functools.lru_cache(maxsize=8)
def _carriers(grid, waves):
    heading = np.stack([np.cos(waves.direction), np.sin(waves.direction)])
    unmoved, levels = carried_at_any_time(grid, waves), []
    anywhere, wave_levels = unmoved.highest.max(), window_levels(grid, waves.wavelength)
    middles, halves = tile_sides(grid.cells)
    half_side = halves.max() + RIM
    for number in range(grid.levels):
        spacing = grid.spacing(number)
        radius = np.sqrt(2.0) * half_side * spacing
        turn = waves.wavenumber * radius
        furthest = spacing * (0.5 * grid.cells + RIM) + furthest_shift(grid, number, wave_levels)
        whole = window_reach(grid, waves.wavelength) * FADE_START >= furthest
        carry = whole & (turn < _MOST_TURN)
        if radius > anywhere or not carry.any():
            break  # tiles of coarser levels are larger yet: waves hardly change which of them are seen
        unknown = np.where(carry, 1.0 - np.cos(turn), 0.5)
        unmoved.highest[number] = _bound(np.sum(unknown * waves.amplitude**2))
        factors = _factors(waves, heading, carry, spacing * middles)
        levels.append(_LevelCarriers(np.flatnonzero(carry), *factors))
    return _Carriers(waves.wavenumber * heading, tuple(levels), unmoved)


def _factors(waves, heading, carry, places):
    """`along` and `across` of `_LevelCarriers`, by corrected Eq. 2."""
    C, (x, y) = waves.orbit_ratio[carry], heading[:, carry]
    k = waves.wavenumber[carry]
    along, across = _phasors(np.outer(places, k * x)), _phasors(np.outer(k * y, places))
    weights = np.stack([1j * C * x, 1j * C * y, np.ones_like(C)], axis=-1)
    weighted = (across[:, :, None] * weights[:, None, :]).astype(np.complex64)  # (waves, columns, 3)
    return along, np.stack([weighted.real, -weighted.imag], axis=1).reshape(2 * len(k), -1)


def _phasors(phases):
    """exp(i phase); in float32, whose sines are many times as fast and good to a millionth of the amplitude."""
    phases = phases.astype(np.float32)
    return np.cos(phases) + np.complex64(1j) * np.sin(phases)
