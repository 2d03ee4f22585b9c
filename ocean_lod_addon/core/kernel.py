# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame kernel: a whole sea surface as matrix products that write straight into the vertex buffer.

On a tensor-product grid of lines x_a, y_b the phase of a wave separates,

    exp(i (kx x_a + ky y_b + phi(t))) = exp(i (kx x_a + phi(t))) exp(i ky y_b),

so the corrected Eq. 2 of the paper, summed over waves i, is for each tile of the plane one real product

    L[a, :]      = [ Re P_ai, Im P_ai, ...,  x_a, 1 ]     P_ai  = A_i exp(i (kx_i x_a + phi_i(t))) w_i(x_a)
    R[:, (b, c)] = [ Re Q_cib, -Im Q_cib, ..., base ]     Q_cib = weight_ci exp(i ky_i y_b) w_i(y_b)
    positions    = L @ R

with weights i C cos(theta), i C sin(theta), 1 for x, y, z (C the orbit ratio) and the window w_i of each wave.
Lines are counted from their level's anchor, whose own phase k . anchor joins phi. R changes only with the anchors,
and then only for waves that fade within the level; per frame only L is formed, a vector of phases times a static
matrix. Phases are formed in float64 and reduced modulo 2 pi before they are rounded, so that precision does not
depend on where or when. Waves are sorted from short to long: a tile far out drops the short ones, whose windows
are zero there, by taking the tail of the inner dimension, and a tile that nobody sees drops them all.
"""

import numpy as np

from .constants import EARTH_RADIUS
from .contraction import CONTRACTIONS, Product, fastest_contraction
from .lod import Grid, tiles
from .waves import WaveSet
from .windows import FADE_START, window, window_levels, window_reach


class FrameKernel:
    """Positions of a plane's vertices at any time and place, for one grid and one set of waves.

    Building it costs some tens of milliseconds; `evaluate` is the fast part. Its result depends on its arguments
    alone: the factors it keeps are scratch memory that remembers which anchors it was filled for.
    """

    def __init__(self, grid: Grid, waves: WaveSet, contraction: str | None = None, curved_earth: bool = False):
        """`contraction` is one of contraction.CONTRACTIONS, or None for the one that suits this NumPy.

        With `curved_earth` the plane sinks by d^2 / (2 R) at the distance d from the finest level's anchor.
        """
        self._grid = grid
        self._waves = waves
        self._order = np.argsort(waves.wavelength, kind="stable")
        self._multiply = CONTRACTIONS[contraction or fastest_contraction()]
        self._tiles = tiles(grid.cells, grid.levels)
        self._levels = [_Level(grid, level, waves, self._order, curved_earth) for level in range(grid.levels)]
        reach = window_reach(grid, waves.wavelength[self._order])
        self._wave_counts = [len(waves) - _first_wave(grid, tile, reach) for tile in self._tiles]
        self._whole_plane = _runs(self._tiles, self._wave_counts)

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return self._tiles[-1].vertices.stop

    def evaluate(
        self, time: float, anchors: np.ndarray, out: np.ndarray, visible=None, wave_limit: int | None = None
    ) -> None:
        """Write the positions at `time` (s) into `out`, (vertex_count, 3) float32, C-contiguous, in m.

        anchors      (levels, 2) float64, m: where each level's lattice is centred, from `lod.level_anchors`
        visible      a flag for each tile, or None for all; tiles without it lie flat
        wave_limit   how many waves to show, the longest, or None for all
        """
        self.fill_factors(time, anchors)
        self._multiply(self.products(out, visible, wave_limit))

    def fill_factors(self, time: float, anchors: np.ndarray) -> None:
        """Form the factors of all levels at `time`: per line and wave one complex multiplication."""
        phase = self._waves.phase_at(time)
        k, theta = self._waves.wavenumber, self._waves.direction
        for number, level in enumerate(self._levels):
            x, y = anchors[number]
            at_anchor = np.mod(phase + k * (x * np.cos(theta) + y * np.sin(theta)), 2.0 * np.pi)
            phasor = self._waves.amplitude * np.exp(1j * at_anchor)
            level.fill(phasor[self._order].astype(np.complex64), anchors)

    def products(self, out: np.ndarray, visible=None, wave_limit: int | None = None) -> list[Product]:
        """The matrix products of one frame, into `out`, (vertex_count, 3) float32."""
        runs = self._whole_plane
        if visible is not None or wave_limit is not None:
            most = len(self._waves) if wave_limit is None else wave_limit
            flags = np.ones(len(self._tiles), bool) if visible is None else visible
            runs = _runs(self._tiles, np.where(flags, np.minimum(self._wave_counts, most), 0).tolist())
        return [self._product(out, *run) for run in runs]

    def _product(self, out, first, last, wave_count):
        """The product of consecutive tiles with the `wave_count` longest waves."""
        tile, end = self._tiles[first], self._tiles[last]
        level = self._levels[tile.level]
        inner = slice(2 * (level.wave_count - wave_count), None)
        vertices = slice(tile.first_vertex, end.vertices.stop)
        return Product(
            level.left[tile.row_start : end.row_stop, inner],
            level.right[inner, 3 * tile.column_start : 3 * tile.column_stop],
            out[vertices].reshape(-1, 3 * tile.columns),
        )


_LONGEST_RUN = 512
"""Rows of one product, at most; more do not make it faster."""

_WASTE = 1 / 8
"""Tiles share a product if that adds no more than this share to the waves of the one that needs fewer."""


def _runs(plane, wave_counts):
    """Neighbouring tiles grouped into products: (first tile, last tile, number of waves) of each.

    Larger products run closer to the processor's speed. All tiles of a run take as many waves as the one that
    needs most; in the others the windows of the added ones are zero.
    """
    runs = []
    for number, (tile, count) in enumerate(zip(plane, wave_counts, strict=True)):
        if runs:
            first, last, shared = runs[-1]
            if _continues(plane[first], plane[last], tile) and abs(count - shared) <= _WASTE * min(count, shared):
                runs[-1] = (first, number, max(count, shared))
                continue
        runs.append((number, number, count))
    return runs


def _continues(first, last, tile):
    """Whether a tile's rows go on where those of the run first..last end, within the longest run."""
    same_strip = (last.level, last.column_start, last.row_stop) == (tile.level, tile.column_start, tile.row_start)
    return same_strip and tile.row_stop - first.row_start <= _LONGEST_RUN


class _Level:
    """One level's factors L and R, and what is needed to refill them.

    The last rows of R are the undisturbed plane, last so that small terms are summed first. They multiply the
    columns x, 1 of L, and with a curved Earth also x^2, which takes a second column (1 again, times 0) to keep L
    an array of complex pairs.
    """

    def __init__(self, grid, number, waves, order, curved_earth):
        lines = grid.lines(number)
        self._number, self._lines, self._curved = number, lines, curved_earth
        reach = window_reach(grid, waves.wavelength[order])
        self.first_wave = int(np.searchsorted(reach, _nearest(grid, number), side="right"))
        present = order[self.first_wave :]
        self.wave_count = len(present)
        self._reach = reach[self.first_wave :]
        self._groups = _groups(window_levels(grid, waves.wavelength[present]))
        self._placed = None

        theta, k = waves.direction[present], waves.wavenumber[present]
        orbit = waves.orbit_ratio[present]
        self._wave_x = np.exp(1j * np.outer(lines, k * np.cos(theta))).astype(np.complex64)  # (lines, waves)
        self._wave_y = np.exp(1j * np.outer(k * np.sin(theta), lines)).astype(np.complex64)  # (waves, lines)
        self._weights = np.stack(
            [1j * orbit * np.cos(theta), 1j * orbit * np.sin(theta), np.ones(len(present))], axis=-1
        ).astype(np.complex64)
        base = 4 if curved_earth else 2
        self._static_left = np.empty_like(self._wave_x)
        self.left = np.zeros((len(lines), 2 * len(present) + base), np.float32)
        self.left[:, -2], self.left[:, -1] = lines, 1.0
        self.right = np.zeros((2 * len(present) + base, 3 * len(lines)), np.float32)
        self.right[-2, 0::3] = 1.0  # X = x_a + ...

    def fill(self, phasor, anchors):
        """Refill R where the anchors have moved, and L with the phasors of all waves, shortest first."""
        placed = anchors.tobytes()
        if placed != self._placed:
            self._place(anchors)
            self._placed = placed
        waves_of_left = self.left.view(np.complex64)[:, : self.wave_count]
        np.multiply(self._static_left, phasor[self.first_wave :], out=waves_of_left)

    def _place(self, anchors):
        for group in self._groups:
            group.place(self, anchors[self._number] - anchors[group.level])
        (x, y), centre = anchors[self._number], anchors[0]
        self.right[-1, 0::3] = x
        self.right[-1, 1::3] = self._lines + y
        if self._curved:
            drop = -0.5 / EARTH_RADIUS
            self.left[:, -4] = (self._lines + (x - centre[0])) ** 2
            self.right[-4, 2::3] = drop
            self.right[-1, 2::3] = drop * (self._lines + (y - centre[1])) ** 2

    def shows_whole(self, waves, shift):
        """Whether the windows of some waves are 1 on the whole level, and thus need no refilling when it moves."""
        return self._reach[waves].min() * FADE_START >= self._lines[-1] + abs(shift)

    def window_x(self, waves, shift):
        """Put the windows of some waves into L's static part; `shift` is this level's centre from the windows'."""
        values = window(np.abs(self._lines + shift)[:, None], self._reach[None, waves])
        np.multiply(self._wave_x[:, waves], values, out=self._static_left[:, waves], casting="same_kind")

    def window_y(self, waves, shift):
        """Put the windows of some waves into R."""
        values = window(np.abs(self._lines + shift)[None, :], self._reach[waves, None]).astype(np.float32)
        weighted = (self._wave_y[waves] * values)[:, :, None] * self._weights[waves, None, :]
        rows = self.right[: 2 * self.wave_count].reshape(self.wave_count, 2, -1)
        flat = weighted.reshape(len(weighted), -1)
        rows[waves, 0], rows[waves, 1] = flat.real, -flat.imag


class _Group:
    """Waves of a level whose windows share one centre, a slice of its sorted waves, and where they stand now."""

    def __init__(self, level, waves):
        self.level, self._waves = level, waves
        self._shift = [None, None]
        self._whole = [False, False]

    def place(self, owner, shift):
        """Refill the windows that change when the owner's centre is at `shift`, m, from the windows'."""
        for axis, refill in enumerate((owner.window_x, owner.window_y)):
            whole = owner.shows_whole(self._waves, shift[axis])
            if self._shift[axis] != shift[axis] and not (whole and self._whole[axis]):
                refill(self._waves, shift[axis])
            self._shift[axis], self._whole[axis] = shift[axis], whole


def _groups(levels_of_waves):
    """The waves, in order, as runs of equal window level."""
    starts = np.flatnonzero(np.diff(levels_of_waves, prepend=-1))
    stops = np.append(starts[1:], len(levels_of_waves)) if len(starts) else starts
    return [
        _Group(int(levels_of_waves[start]), slice(int(start), int(stop)))
        for start, stop in zip(starts, stops, strict=True)
    ]


def _nearest(grid, level):
    """The least distance from any wave's window centre at which the level owns a vertex, m.

    Centres and anchors differ by half a cell of each, less than a cell of this level where a window matters.
    """
    if level == 0:
        return 0.0
    return grid.lines(level)[3 * grid.cells // 4 + 1] - grid.spacing(level)


def _first_wave(grid, tile, reach):
    """The shortest wave whose window is not zero everywhere on the tile."""
    distance = np.abs(grid.lines(tile.level))
    nearest = max(
        distance[tile.row_start : tile.row_stop].min(), distance[tile.column_start : tile.column_stop].min()
    )
    nearest = max(nearest - grid.spacing(tile.level), _nearest(grid, tile.level))
    return int(np.searchsorted(reach, nearest, side="right"))
