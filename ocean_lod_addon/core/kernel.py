# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame kernel: a whole sea surface as matrix products that write straight into the vertex buffer.

On a tensor-product grid of lines x_a, y_b the phase of a wave separates,

    exp(i (kx x_a + ky y_b + phi(t))) = exp(i (kx x_a + phi(t))) exp(i ky y_b),

so the corrected Eq. 2 of the paper, summed over waves i, is for each tile of the plane one real product

    L[a, :]      = [ Re P_ai, Im P_ai, ...,  x_a, 1 ]     P_ai  = A_i exp(i (kx_i x_a + phi_i(t))) w_i(x_a)
    R[:, (b, c)] = [ Re Q_cib, -Im Q_cib, ..., base ]     Q_cib = weight_ci exp(i ky_i y_b) w_i(y_b)
    positions    = L @ R

with weights i C cos(theta), i C sin(theta), 1 for x, y, z (C the orbit ratio) and the window w_i of each wave.
Velocities and derivatives are further blocks of columns of R (core.column_blocks), over the same L. A block that
is never asked for is never formed.
Lines are counted from their level's anchor, whose own phase k . anchor joins phi. R changes only with the anchors,
and then only for waves that fade within the level; per frame only L is formed, a vector of phases times a static
matrix. Phases are formed in float64 and reduced modulo 2 pi before they are rounded, so that precision does not
depend on where or when. Waves are sorted from short to long: a tile far out drops the short ones, whose windows
are zero there, by taking the tail of the inner dimension, and a tile that nobody sees drops them all.
"""

import numpy as np

from .column_blocks import POSITION, ColumnBlock, Still
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
        self._wave_vectors = waves.wavenumber * np.stack([np.cos(waves.direction), np.sin(waves.direction)])
        self._multiply = CONTRACTIONS[contraction or fastest_contraction()]
        self._tiles = tiles(grid.cells, grid.levels)
        self._levels = [_Level(grid, level, waves, self._order, curved_earth) for level in range(grid.levels)]
        reach = window_reach(grid, waves.wavelength[self._order])
        self._wave_counts = [len(waves) - _first_wave(grid, tile, reach) for tile in self._tiles]
        self._whole_plane = _runs(self._tiles, self._wave_counts)
        self._last_products = {}

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return self._tiles[-1].vertices.stop

    @property
    def tile_count(self) -> int:
        """Number of tiles."""
        return len(self._tiles)

    @property
    def blocks(self) -> set[ColumnBlock]:
        """The blocks of columns that were asked for so far, and take memory."""
        return self._levels[0].blocks

    def evaluate(
        self,
        time: float,
        anchors: np.ndarray,
        out: np.ndarray,
        visible=None,
        wave_limit: int | None = None,
        more: dict[ColumnBlock, np.ndarray] | None = None,
    ) -> None:
        """Write the positions at `time` (s) into `out`, (vertex_count, 3) float32, C-contiguous, in m.

        anchors      (levels, 2) float64, m: where each level's lattice is centred, from `lod.level_anchors`
        visible      a flag for each tile, or None for all; tiles without it lie flat
        wave_limit   how many waves to show, the longest, or None for all
        more         further blocks of columns to evaluate, each into an array like `out` with its columns
        """
        outputs = {POSITION: out} | (more or {})
        self.fill_factors(time, anchors, outputs)
        products = [
            product
            for block, array in outputs.items()
            for product in self.products(array, visible, wave_limit, block)
        ]
        self._multiply(products)

    def fill_factors(self, time: float, anchors: np.ndarray, blocks=(POSITION,)) -> None:
        """Form the factors of all levels at `time`: per line and wave one complex multiplication."""
        at_anchors = np.mod(self._waves.phase_at(time) + anchors @ self._wave_vectors, 2.0 * np.pi)
        phasors = self._waves.amplitude * np.exp(1j * at_anchors)  # (levels, waves)
        phasors = phasors[:, self._order].astype(np.complex64)
        for level, phasor in zip(self._levels, phasors, strict=True):
            level.fill(phasor, anchors, blocks)

    def products(
        self, out: np.ndarray, visible=None, wave_limit: int | None = None, block: ColumnBlock = POSITION
    ) -> list[Product]:
        """The matrix products of one block of a frame, into `out`, (vertex_count, block.columns) float32."""
        if visible is None and wave_limit is None:
            return self._products_of_whole_plane(out, block)
        most = len(self._waves) if wave_limit is None else wave_limit
        flags = np.ones(len(self._tiles), bool) if visible is None else visible
        runs = _runs(self._tiles, np.where(flags, np.minimum(self._wave_counts, most), 0).tolist())
        return [self._product(out, block, *run) for run in runs]

    def _products_of_whole_plane(self, out, block):
        """Made once for an array that is used frame after frame."""
        last_out, products = self._last_products.get(block, (None, []))
        if last_out is not out:
            products = [self._product(out, block, *run) for run in self._whole_plane]
            self._last_products[block] = (out, products)
        return products

    def _product(self, out, block, first, last, wave_count):
        """The product of consecutive tiles with the `wave_count` longest waves."""
        tile, end = self._tiles[first], self._tiles[last]
        level = self._levels[tile.level]
        inner = slice(2 * (level.wave_count - wave_count), None)
        vertices = slice(tile.first_vertex, end.vertices.stop)
        columns = slice(block.columns * tile.column_start, block.columns * tile.column_stop)
        return Product(
            level.left[tile.row_start : end.row_stop, inner],
            level.right(block)[inner, columns],
            out[vertices].reshape(-1, block.columns * tile.columns),
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
    """One level's left factor L, and its right factors R, one for each block of columns that was asked for.

    The last columns of L are those of the undisturbed plane, last so that small terms are summed first: x, 1, and
    with a curved Earth also x^2, which takes a second column (of zeros) to keep L an array of complex pairs.
    """

    def __init__(self, grid, number, waves, order, curved_earth):
        lines = grid.lines(number)
        self.number, self.lines, self.curved = number, lines, curved_earth
        reach = window_reach(grid, waves.wavelength[order])
        self.first_wave = int(np.searchsorted(reach, _nearest(grid, number), side="right"))
        self.present = order[self.first_wave :]
        self.wave_count = len(self.present)
        self.waves = waves
        self.reach = reach[self.first_wave :]
        self.window_levels = window_levels(grid, waves.wavelength[self.present])
        self._windows = _Windows(self, axis=0)
        self._blocks: dict[ColumnBlock, _Right] = {}

        k, theta = waves.wavenumber[self.present], waves.direction[self.present]
        self._wave_x = np.exp(1j * np.outer(lines, k * np.cos(theta))).astype(np.complex64)  # (lines, waves)
        self.wave_y = np.exp(1j * np.outer(k * np.sin(theta), lines)).astype(np.complex64)  # (waves, lines)
        self._static_left = np.empty_like(self._wave_x)
        self.base_rows = 4 if curved_earth else 2
        self.left = np.zeros((len(lines), 2 * self.wave_count + self.base_rows), np.float32)
        self.left[:, -2], self.left[:, -1] = lines, 1.0

    def fill(self, phasor, anchors, blocks):
        """Refill L with the phasors of all waves, shortest first, and the blocks' R where the anchors moved."""
        self._windows.place(anchors, self._refill)
        if self.curved:
            self.left[:, -4] = (self.lines + (anchors[self.number] - anchors[0])[0]) ** 2
        waves_of_left = self.left.view(np.complex64)[:, : self.wave_count]
        np.multiply(self._static_left, phasor[self.first_wave :], out=waves_of_left)
        for block in blocks:
            if block not in self._blocks:
                self._blocks[block] = _Right(self, block)
            self._blocks[block].place(anchors)

    @property
    def blocks(self):
        """The blocks that have been filled."""
        return set(self._blocks)

    def right(self, block):
        """The right factor of a block that has been filled."""
        return self._blocks[block].matrix

    def _refill(self, waves, shift):
        """Put the windows of some waves into L's static part; `shift` is this level's centre from the windows'."""
        values = window(np.abs(self.lines + shift)[:, None], self.reach[None, waves])
        np.multiply(self._wave_x[:, waves], values, out=self._static_left[:, waves], casting="same_kind")


class _Right:
    """The right factor R of one block of columns on one level."""

    def __init__(self, level, block):
        self._level, self._block = level, block
        self._windows = _Windows(level, axis=1)
        self._weights = block.weights(level.waves)[level.present].astype(np.complex64)  # (waves, columns)
        self.matrix = np.zeros(
            (2 * level.wave_count + level.base_rows, block.columns * len(level.lines)), np.float32
        )

    def place(self, anchors):
        """Refill what changes when the anchors have moved."""
        if not self._windows.place(anchors, self._refill):
            return
        level = self._level
        still = Still(level.lines, anchors[level.number], anchors[0], level.curved)
        one, x, x_squared = self._block.base(still)
        self.matrix[-1], self.matrix[-2] = one.ravel(), x.ravel()
        if level.curved:
            self.matrix[-4] = x_squared.ravel()

    def _refill(self, waves, shift):
        """Put the windows of some waves into R; `shift` is the level's centre from the windows'."""
        level = self._level
        values = window(np.abs(level.lines + shift)[None, :], level.reach[waves, None]).astype(np.float32)
        weighted = (level.wave_y[waves] * values)[:, :, None] * self._weights[waves, None, :]
        rows = self.matrix[: 2 * level.wave_count].reshape(level.wave_count, 2, -1)
        flat = weighted.reshape(len(weighted), -1)
        rows[waves, 0], rows[waves, 1] = flat.real, -flat.imag


class _Windows:
    """What the windows of a factor were last filled for: along one axis, the waves grouped by their centre."""

    def __init__(self, level, axis):
        self._level, self._axis = level, axis
        self._groups = _groups(level.window_levels)
        self._placed = None

    def place(self, anchors, refill) -> bool:
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
