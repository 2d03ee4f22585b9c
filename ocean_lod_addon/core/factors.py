# SPDX-License-Identifier: GPL-3.0-or-later
"""The left and right factors of the frame kernel's products on one level, as core.kernel defines them.

A contraction that wants mirrored products gets factors that make use of the level's symmetry about its middle
line y = 0. There exp(-i ky y) = conj(exp(i ky y)), so that in a column whose weights are real (s = 1) or imaginary
(s = -1), a row of R that goes with Re P has s times its value on the mirrored line, and one that goes with Im P -s
times. With U the part of the sum that the former rows make and V that of the latter,

    value at y = U + V,    value at -y = s (U - V):

half the multiplications for two additions. Rows of waves that fade within the level, whose windows have no such
symmetry, and of the undisturbed plane are split into a part of either kind, and stand in both U and V.

A column whose weights are complex, such as that of an instant of the past, has no such s. Its block gets the plain
factors: all of its rows would stand in both U and V, and nothing would be saved.
"""

import weakref

import numpy as np

from .column_blocks import ColumnBlock, Still
from .contraction import aligned_matrix
from .lod import Grid
from .waves import WaveSet
from .windows import FADE_START, fading_waves, first_wave, window, window_levels, window_reach


class Level:
    """One level's left factor, and its right factors, one for each block of columns that was asked for.

    `plain_left` is L, `mirrored_lefts` those of U and V; a level that is not `mirrored` has none of these, one
    that is has an L only once a block asks for it. Their last columns are those of the undisturbed plane, last so
    that small terms are summed first: x, 1, and with a curved Earth also x^2, which takes a second column (of
    zeros) to keep L an array of complex pairs.
    """

    def __init__(
        self, grid: Grid, number: int, waves: WaveSet, order: np.ndarray, curved_earth: bool, mirrored: bool
    ):
        """`order` sorts the waves from short to long."""
        lines = grid.lines(number)
        self.number, self.lines, self.curved = number, lines, curved_earth
        self.first_wave = first_wave(grid, number, waves.wavelength[order])
        self.present = order[self.first_wave :]
        self.wave_count = len(self.present)
        self.waves = waves
        wavelength = waves.wavelength[self.present]
        self.reach = window_reach(grid, wavelength)
        self.window_levels = window_levels(grid, wavelength)
        self.fading = fading_waves(grid, number, wavelength)
        self.base_rows = 4 if curved_earth else 2
        self.grid = grid
        self._mirrored = mirrored
        self._windows = Windows(self, axis=0)
        self._blocks: dict[ColumnBlock, _Right] = {}

        k, theta = waves.wavenumber[self.present], waves.direction[self.present]
        self._wave_x = np.exp(1j * np.outer(lines, k * np.cos(theta))).astype(np.complex64)  # (lines, waves)
        self.wave_y = np.exp(1j * np.outer(k * np.sin(theta), lines)).astype(np.complex64)  # (waves, lines)
        self._static_left = np.empty_like(self._wave_x)
        self._phased = np.empty_like(self._wave_x) if mirrored else None
        self.plain_left = None if mirrored else self._new_left(2 * self.wave_count)
        width = self.mirrored_rows(self.wave_count)
        self.mirrored_lefts = tuple(self._new_left(width) for _ in range(2 if mirrored else 0))

    def _new_left(self, wave_columns):
        left = np.zeros((len(self.lines), wave_columns + self.base_rows), np.float32)
        left[:, -2], left[:, -1] = self.lines, 1.0
        return left

    def mirrored_rows(self, wave_count: int) -> int:
        """Columns of each of `mirrored_lefts` that the `wave_count` longest waves take."""
        return int(mirrored_terms(wave_count, self.wave_count, self.fading))

    @property
    def _lefts(self):
        return (*self.mirrored_lefts, *(() if self.plain_left is None else (self.plain_left,)))

    def _add(self, block):
        """Make the right factor of a block, and L if it is the first that needs it."""
        mirrored = self._mirrored and _signs(block.weights(self.waves)) is not None
        self._blocks[block] = (_MirroredRight if mirrored else _PlainRight)(self, block)
        if not mirrored and self.plain_left is None:
            self.plain_left = self._new_left(2 * self.wave_count)

    def fill(self, phasor: np.ndarray, anchors: np.ndarray, blocks, rows: slice) -> None:
        """Refill rows of L with the phasors of all waves, shortest first, and R where the anchors have moved."""
        for block in blocks:
            if block not in self._blocks:
                self._add(block)
            self._blocks[block].place(anchors)
        if self.curved:
            for left in self._lefts:
                left[:, -4] = (self.lines + (anchors[self.number] - anchors[0])[0]) ** 2
        if rows.start == rows.stop:
            return
        self._windows.place(anchors, self._refill)
        phasor = phasor[self.first_wave :]
        if self.plain_left is not None:
            waves_of_left = self.plain_left.view(np.complex64)[rows, : self.wave_count]
            np.multiply(self._static_left[rows], phasor, out=waves_of_left)
        if self._mirrored:
            self._fill_mirrored(phasor, rows)

    def _fill_mirrored(self, phasor, rows):
        phased = np.multiply(self._static_left[rows], phasor, out=self._phased[rows])
        both, whole = slice(0, 2 * self.fading), slice(2 * self.fading, -self.base_rows)
        parts = phased[:, self.fading :].real, phased[:, self.fading :].imag
        for left, part in zip(self.mirrored_lefts, parts, strict=True):
            left[rows, both] = phased.view(np.float32)[:, both]
            left[rows, whole] = part

    @property
    def blocks(self) -> set[ColumnBlock]:
        """The blocks that have been filled."""
        return set(self._blocks)

    def right(self, block: ColumnBlock):
        """The right factor of a block that has been filled."""
        return self._blocks[block]

    def _refill(self, waves, shift):
        """Put the windows of some waves into L's static part; `shift` is this level's centre from the windows'."""
        values = window(np.abs(self.lines + shift)[:, None], self.reach[None, waves])
        np.multiply(self._wave_x[:, waves], values, out=self._static_left[:, waves], casting="same_kind")


class _Right:
    """The right factor of one block of columns on one level, which owns it; its `base` is for still water.

    A weak reference back lets a level that is no longer used go at once, not with the next search for cycles.
    """

    def __init__(self, level, block):
        self._level, self._block = weakref.proxy(level), block
        self._windows = Windows(level, axis=1)
        self._weights = block.weights(level.waves)[level.present].astype(np.complex64)  # (waves, columns)
        self.base = np.zeros((level.base_rows, block.columns * len(level.lines)), np.float32)

    def place(self, anchors):
        """Refill what changes when the anchors have moved."""
        if not self._windows.place(anchors, self._refill):
            return
        level = self._level
        still = Still(level.lines, anchors[level.number], anchors[0], level.curved)
        one, x, x_squared = self._block.base(still)
        base = np.zeros((level.base_rows, *one.shape))  # (rows, lines, columns)
        base[-1], base[-2] = one, x
        if level.curved:
            base[-4] = x_squared
        self.base[:] = base.reshape(len(base), -1)
        self._put_base(base)

    def _refill(self, waves, shift):
        """Put the windows of some waves into R; `shift` is the level's centre from the windows'."""
        level = self._level
        values = window(np.abs(level.lines + shift)[None, :], level.reach[waves, None]).astype(np.float32)
        self._put_waves(waves, (level.wave_y[waves] * values)[:, :, None] * self._weights[waves, None, :])


class _PlainRight(_Right):
    """R as it stands in core.kernel."""

    mirrored = False

    def __init__(self, level, block):
        super().__init__(level, block)
        self.matrix = aligned_matrix(2 * level.wave_count + level.base_rows, self.base.shape[1])

    def _put_base(self, base):
        self._put(slice(2 * self._level.wave_count, None), base)

    def _put_waves(self, waves, weighted):
        self._put(slice(2 * waves.start, 2 * waves.stop, 2), weighted.real)
        self._put(slice(2 * waves.start + 1, 2 * waves.stop, 2), -weighted.imag)

    def _put(self, rows, values):
        """Values (rows, lines, columns)."""
        self.matrix[rows] = values.reshape(len(values), -1)


class _MirroredRight(_Right):
    """Those of U and V, for the upper half."""

    mirrored = True

    def __init__(self, level, block):
        super().__init__(level, block)
        self.signs = _signs(self._weights)
        shape = level.wave_count + level.fading + level.base_rows, block.columns * (len(level.lines) // 2 + 1)
        self.matrices = aligned_matrix(*shape), aligned_matrix(*shape)

    def _put_base(self, base):
        rows = slice(self._level.wave_count + self._level.fading, None)
        for which, part in enumerate(self._parts(base)):
            self._put(which, rows, part)

    def _put_waves(self, waves, weighted):
        """A slice of waves that all fade, or none of them."""
        fading = self._level.fading
        u, v = self._parts(weighted)
        if waves.start >= fading:
            rows = slice(waves.start + fading, waves.stop + fading)
            self._put(0, rows, u.real)
            self._put(1, rows, -v.imag)
            return
        for which, part in enumerate((u, v)):
            self._put(which, slice(2 * waves.start, 2 * waves.stop, 2), part.real)
            self._put(which, slice(2 * waves.start + 1, 2 * waves.stop, 2), -part.imag)

    def _parts(self, values):
        """The parts of (rows, lines, columns) that are s and -s times their mirror image, on the upper half."""
        middle = values.shape[1] // 2
        upper, image = values[:, middle:], values[:, middle::-1] * np.float32(self.signs)
        return 0.5 * (upper + image), 0.5 * (upper - image)

    def _put(self, which, rows, values):
        """Values (rows, lines of the upper half, columns) into the factor of U (0) or V (1)."""
        self.matrices[which][rows] = values.reshape(len(values), -1)


def _signs(weights):
    """1 for each column whose weights are real, -1 for imaginary ones; None if a column has both kinds."""
    real, imaginary = ~weights.imag.any(axis=0), ~weights.real.any(axis=0)
    if not (real | imaginary).all():
        return None
    return tuple(np.where(real, 1, -1).tolist())


class Windows:
    """What the windows of a factor were last filled for: along one axis, the waves grouped by their centre.

    Of the level, which owns them, they keep a weak reference, as `_Right` does.
    """

    def __init__(self, level: Level, axis: int):
        self._level, self._axis = weakref.proxy(level), axis
        self._groups = _groups(level.window_levels, level.fading)
        self._placed = None

    def place(self, anchors: np.ndarray, refill) -> bool:
        """Call refill(waves, shift) for those that change, `shift` being the level's centre from the windows', m.

        Returns whether the anchors have moved at all.
        """
        placed = anchors.tobytes()
        if placed == self._placed:
            return False
        self._placed = placed
        for group in self._groups:
            shift = (anchors[self._level.number] - anchors[group.level])[self._axis]
            whole = self._shown_whole(group.waves, shift)
            if group.shift != shift and not (whole and group.whole):
                refill(group.waves, shift)
            group.shift, group.whole = shift, whole
        return True

    def _shown_whole(self, waves, shift):
        """Whether the windows of some waves are 1 on the whole level, and thus need no refilling when it moves."""
        return self._level.reach[waves].min() * FADE_START >= self._level.lines[-1] + abs(shift)


class _Group:
    """Waves of a level whose windows share one centre, a slice of its sorted waves, and where they stand now."""

    def __init__(self, level, waves):
        self.level, self.waves = level, waves
        self.shift, self.whole = None, False


def _groups(levels_of_waves, fading):
    """The waves, in order, as runs of equal window level, which end where waves no longer fade."""
    starts = np.flatnonzero(np.diff(levels_of_waves, prepend=-1))
    if fading < len(levels_of_waves):
        starts = np.union1d(starts, fading)
    stops = np.append(starts[1:], len(levels_of_waves)) if len(starts) else starts
    return [
        _Group(int(levels_of_waves[start]), slice(int(start), int(stop)))
        for start, stop in zip(starts, stops, strict=True)
    ]


def mirrored_terms(wave_count, waves, fading):
    """How many terms the `wave_count` longest of a level's `waves` have in each of U and V; numbers or arrays."""
    return wave_count + np.maximum(fading - (waves - wave_count), 0)
