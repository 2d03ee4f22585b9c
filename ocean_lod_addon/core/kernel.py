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

The factors themselves are in core.factors, which also halves the multiplications where they are dear.
"""

from dataclasses import dataclass

import numpy as np

from .column_blocks import POSITION, ColumnBlock
from .contraction import CONTRACTIONS, MirroredProduct, Product, fastest_contraction, small_buffers
from .factors import Level, nearest_vertex
from .lod import Grid, TileTable, tile_table, tiles
from .waves import WaveSet
from .windows import window_reach


@dataclass(eq=False)
class ReusedArray:
    """An array that kernels write into frame after frame, and nobody else does.

    They note in it where they have put still water, which is then not written again until it moves.
    """

    array: np.ndarray
    still: "_StillWater | None" = None


@dataclass(frozen=True, eq=False)
class _StillWater:
    """The tiles of an array that hold a kernel's still water, a flag for each, at level anchors (levels, 2).

    `owner` stands for the kernel, whose memory an array need not keep alive.
    """

    owner: object
    flags: np.ndarray
    anchors: np.ndarray


class _LastProducts:
    """Products into one array: those of the last view, and all that were made so far, by their runs of tiles.

    What a camera sees changes at the rim of its frame, from frame to frame; most products stay.
    """

    def __init__(self, out):
        self.out, self.view, self.products = out, None, []
        self.made: dict[tuple, Product | MirroredProduct] = {}


_MOST_KEPT = 2048
"""Products; some views later they are made anew."""

_NO_ROW = 1 << 30
"""Past all rows."""


class FrameKernel:
    """Positions of a plane's vertices at any time and place, for one grid and one set of waves.

    Building it costs some tens of milliseconds; `evaluate` is the fast part. Its result depends on its arguments
    alone: the factors it keeps are scratch memory that remembers which anchors it was filled for.
    """

    def __init__(self, grid: Grid, waves: WaveSet, contraction: str | None = None, curved_earth: bool = False):
        """`contraction` is one of contraction.CONTRACTIONS, or None for the one that suits this NumPy.

        With `curved_earth` the plane sinks by d^2 / (2 R) at the distance d from the finest level's anchor.
        """
        self._waves, self._curved = waves, curved_earth
        self._identity = object()
        self._order = np.argsort(waves.wavelength, kind="stable")
        self._wave_vectors = waves.wavenumber * np.stack([np.cos(waves.direction), np.sin(waves.direction)])
        self._contraction = CONTRACTIONS[contraction or fastest_contraction()]
        self._tiles = tiles(grid.cells, grid.levels)
        self._table = tile_table(grid.cells, grid.levels)
        self._first_tiles = np.searchsorted(self._table.level, np.arange(grid.levels))
        mirrored = self._contraction.mirrored
        self._levels = [
            Level(grid, number, waves, self._order, curved_earth, mirrored) for number in range(grid.levels)
        ]
        reach = window_reach(grid, waves.wavelength[self._order])
        self._wave_counts = len(waves) - _first_waves(grid, self._table, reach)
        self._plain_tiles = _PlainTiles(grid)
        self._mirrored_tiles = _MirroredTiles(grid) if mirrored else None
        self._follows = _follows(self._table, np.arange(len(self._tiles)))
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
        out: np.ndarray | ReusedArray,
        visible=None,
        wave_limit: int | None = None,
        more: dict[ColumnBlock, np.ndarray | ReusedArray] | None = None,
    ) -> None:
        """Write the positions at `time` (s) into `out`, (vertex_count, 3) float32, C-contiguous, in m.

        anchors      (levels, 2) float64, m: where each level's lattice is centred, from `lod.level_anchors`
        visible      a flag for each tile, or None for all; tiles without it lie flat
        wave_limit   how many waves to show, the longest, or None for all
        more         further blocks of columns to evaluate, each into an array like `out` with its columns
        """
        outputs = {POSITION: out} | (more or {})
        self.fill_factors(time, anchors, outputs, visible)
        products = []
        for block, output in outputs.items():
            reused = output if isinstance(output, ReusedArray) else ReusedArray(output)
            products += self.products(reused.array, visible, wave_limit, block)
            if visible is not None:
                products += self._still_products(reused, block, anchors, visible)
            else:
                reused.still = None
        self._contraction.multiply(products)

    def fill_factors(self, time: float, anchors: np.ndarray, blocks=(POSITION,), visible=None) -> None:
        """Form the factors at `time`, for visible tiles: per line and wave one complex multiplication."""
        at_anchors = np.mod(self._waves.phase_at(time) + anchors @ self._wave_vectors, 2.0 * np.pi)
        phasors = self._waves.amplitude * np.exp(1j * at_anchors)  # (levels, waves)
        phasors = phasors[:, self._order].astype(np.complex64)
        with small_buffers():
            for level, phasor, rows in zip(self._levels, phasors, self._visible_rows(visible), strict=True):
                level.fill(phasor, anchors, blocks, rows)

    def _visible_rows(self, visible):
        """For each level its lines from the first to the last tile that is visible."""
        if visible is None:
            return [slice(0, len(level.lines)) for level in self._levels]
        first = np.minimum.reduceat(np.where(visible, self._table.row_start, _NO_ROW), self._first_tiles)
        past = np.maximum.reduceat(np.where(visible, self._table.row_stop, 0), self._first_tiles)
        return [slice(min(start, stop), stop) for start, stop in zip(first.tolist(), past.tolist(), strict=True)]

    def products(
        self, out: np.ndarray, visible=None, wave_limit: int | None = None, block: ColumnBlock = POSITION
    ) -> list[Product] | list[MirroredProduct]:
        """The products that move one block of a frame, into `out`, (vertex_count, block.columns) float32.

        Made once for an array and a view that stay the same from frame to frame.
        """
        view = None if visible is None else visible.tobytes(), wave_limit
        last = self._last_products.get(block)
        if last is None or last.out is not out:
            last = self._last_products[block] = _LastProducts(out)
        elif last.view == view:
            return last.products
        elif len(last.made) > _MOST_KEPT:
            last.made.clear()
        most = len(self._waves) if wave_limit is None else wave_limit
        flags = np.ones(len(self._tiles), bool) if visible is None else visible
        units = self._mirrored_tiles if self._levels[0].right(block).mirrored else self._plain_tiles
        kinds, counts = units.needs(flags, np.minimum(self._wave_counts, most))
        runs = _runs(units.follows, kinds, counts)
        for run in runs:
            if run not in last.made:
                last.made[run] = units.product(self._levels, out, block, *run)
        last.view, last.products = view, [last.made[run] for run in runs]
        return last.products

    def _still_products(self, reused, block, anchors, visible):
        """The products that put still water where it is wanted and not yet there."""
        flat = ~visible
        missing = flat.copy()
        if reused.still is not None and reused.still.owner is self._identity:
            moved = (anchors != reused.still.anchors).any(axis=1)
            if self._curved:
                moved[:] |= moved[0]
            missing &= ~reused.still.flags | moved[self._table.level]
        reused.still = _StillWater(self._identity, flat, anchors.copy())
        if not missing.any():
            return []
        runs = _runs(self._follows, missing, np.zeros(len(missing), int))
        return [self._still_product(reused.array, block, self._tiles[a], self._tiles[b]) for a, b, _, _ in runs]

    def _still_product(self, out, block, tile, end):
        level = self._levels[tile.level]
        columns = slice(block.columns * tile.column_start, block.columns * tile.column_stop)
        left = level.plain_left if level.plain_left is not None else level.mirrored_lefts[0]
        return Product(
            left[tile.row_start : end.row_stop, -level.base_rows :],
            level.right(block).base[:, columns],
            _rows_of(out, block, tile, end),
        )


class _PlainTiles:
    """Every tile by itself; neighbours make one product."""

    def __init__(self, grid):
        self._tiles = tiles(grid.cells, grid.levels)
        self.follows = _follows(tile_table(grid.cells, grid.levels), np.arange(len(self._tiles)))

    def needs(self, visible, wave_counts):
        """For each: whether it is needed, and with how many waves."""
        return visible.astype(int), wave_counts

    def product(self, levels, out, block, first, last, _kind, wave_count):
        """The product of the units first..last with the `wave_count` longest waves."""
        tile, end = self._tiles[first], self._tiles[last]
        level = levels[tile.level]
        inner = slice(2 * (level.wave_count - wave_count), None)
        return Product(
            level.plain_left[tile.row_start : end.row_stop, inner],
            level.right(block).strips[tile.column_start][inner],
            _rows_of(out, block, tile, end),
        )


_OWN, _IMAGE = 1, 2
"""Bits of what is needed of a tile and its mirror image."""


class _MirroredTiles:
    """The tiles of the upper half, each with its mirror image."""

    def __init__(self, grid):
        self._tiles = tiles(grid.cells, grid.levels)
        table = tile_table(grid.cells, grid.levels)
        numbers = np.arange(len(self._tiles))
        by_place = {(t.level, t.row_start, t.column_stop): number for number, t in enumerate(self._tiles)}
        self._own = numbers[table.column_start >= grid.cells // 2]
        last = [max(self._tiles[number].column_start, grid.cells // 2 + 1) for number in self._own]
        self._image = np.array(
            [
                by_place[self._tiles[number].level, self._tiles[number].row_start, grid.cells + 1 - first]
                for number, first in zip(self._own, last, strict=True)
            ]
        )
        self.follows = _follows(table, self._own)

    def needs(self, visible, wave_counts):
        """For each: which of the two is needed, as bits, and with how many waves."""
        counts = np.where(visible, wave_counts, 0)
        kinds = _OWN * visible[self._own] + _IMAGE * visible[self._image]
        return kinds, np.maximum(counts[self._own], counts[self._image])

    def product(self, levels, out, block, first, last, kind, wave_count):
        """The product of the units first..last with the `wave_count` longest waves."""
        own, own_end = (self._tiles[self._own[number]] for number in (first, last))
        image, image_end = (self._tiles[self._image[number]] for number in (first, last))
        level = levels[own.level]
        right = level.right(block)
        inner = slice(level.mirrored_rows(level.wave_count) - level.mirrored_rows(wave_count), None)
        mirrored = None
        if kind & _IMAGE:
            mirrored = _rows_of(out, block, image, image_end).reshape(-1, image.columns, block.columns)[:, ::-1]
        return MirroredProduct(
            tuple(left[own.row_start : own_end.row_stop, inner] for left in level.mirrored_lefts),
            tuple(matrix[inner] for matrix in right.strips[own.column_start]),
            right.signs,
            _rows_of(out, block, own, own_end) if kind & _OWN else None,
            mirrored,
        )


def _rows_of(out, block, tile, end):
    """The columns of a block of the consecutive tiles tile..end, (rows, columns of all lines)."""
    return out[tile.first_vertex : end.vertices.stop].reshape(-1, block.columns * tile.columns)


def _follows(table: TileTable, numbers):
    """For some tiles in vertex order: whether the rows of each go on where those of the one before end."""
    own, before = numbers[1:], numbers[:-1]
    same_strip = table.column_start[own] == table.column_start[before]
    go_on = table.row_start[own] == table.row_stop[before]
    return np.concatenate([[False], (table.level[own] == table.level[before]) & same_strip & go_on])


_WASTE = 1 / 3
"""Tiles share a product if that adds no more than this share to the waves of the one that needs fewer."""


def _runs(follows, kinds, wave_counts):
    """Neighbours of equal kind, other than 0, as products: (first, last, kind, number of waves) of each.

    Larger products run closer to the processor's speed. All of a run take as many waves as the one that needs
    most; in the others the windows of the added ones are zero.
    """
    starts = np.flatnonzero(~follows | (np.diff(kinds, prepend=-1) != 0))
    stops = np.append(starts[1:], len(kinds))
    wave_counts = wave_counts.tolist()
    runs = []
    for start, stop, kind in zip(starts.tolist(), stops.tolist(), kinds[starts].tolist(), strict=True):
        if not kind:
            continue
        shared = wave_counts[start]
        for number in range(start, stop):
            count = wave_counts[number]
            if abs(count - shared) > _WASTE * min(count, shared):
                runs.append((start, number - 1, kind, shared))
                start, shared = number, count
            shared = max(shared, count)
        runs.append((start, stop - 1, kind, shared))
    return runs


def _first_waves(grid, table, reach):
    """For each tile the shortest wave whose window is not zero everywhere on it."""
    middle, spacing = grid.cells // 2, grid.cell_size * np.exp2(table.level)
    nearest = np.zeros(len(spacing))
    for start, stop in ((table.row_start, table.row_stop), (table.column_start, table.column_stop)):
        lines_off = np.maximum(np.maximum(start - middle, middle - (stop - 1)), 0)
        nearest = np.maximum(nearest, lines_off * spacing)
    outside_hole = np.array([nearest_vertex(grid, level) for level in range(grid.levels)])
    nearest = np.maximum(nearest - spacing, outside_hole[table.level])
    return np.searchsorted(reach, nearest, side="right")
