# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame kernel: a whole sea surface as matrix products that write straight into the vertex buffer.

On a tensor-product grid of lines x_a, y_b the phase of a wave separates,

    exp(i (kx x_a + ky y_b + phi(t))) = exp(i (kx x_a + phi(t))) exp(i ky y_b),

so the corrected Eq. 2 of the paper, summed over waves i, is for any rectangle of a level's lines one real product

    L[a, :]      = [ Re P_ai, Im P_ai, ...,  x_a, 1 ]     P_ai  = A_i exp(i (kx_i x_a + phi_i(t))) w_i(x_a)
    R[:, (b, c)] = [ Re Q_cib, -Im Q_cib, ..., base ]     Q_cib = weight_ci exp(i ky_i y_b) w_i(y_b)
    positions    = L @ R

with weights i C cos(theta), i C sin(theta), 1 for x, y, z (C the orbit ratio) and the window w_i of each wave.
Velocities and derivatives are further blocks of columns of R (core.column_blocks), over the same L. A block that
is never asked for is never formed.
Lines are counted from their level's anchor, whose own phase k . anchor joins phi. R changes only with the anchors,
and then only for waves that fade within the level; per frame only L is formed, a vector of phases times a static
matrix. Phases are formed in float64, and so are their sines before they are rounded, so that precision does not
depend on where or when. Waves are sorted from short to long: a rectangle far out drops the short ones, whose
windows are zero there, by taking the tail of the inner dimension, and water that nobody sees drops them all. Which
rectangles there are is decided in core.patches.

The factors themselves are in core.factors, which also halves the multiplications where they are dear.
"""

from dataclasses import dataclass

import numpy as np

from .column_blocks import POSITION, ColumnBlock
from .contraction import CONTRACTIONS, MirroredProduct, Product, fastest_contraction, small_buffers
from .factors import Level
from .lod import Grid, rectangle, tile_edges, tile_sizes
from .patches import Patch, Patches, exact_patches, lines_in_view
from .waves import WaveSet


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
    """Products into one array: those of the last view, the tiles they cover, and all that were made so far.

    What a camera sees changes at the rim of its frame, from frame to frame; most products stay.
    """

    def __init__(self, out):
        self.out, self.view, self.products, self.covered = out, None, [], None
        self.made: dict[Patch, Product | MirroredProduct] = {}


_MOST_KEPT = 2048
"""Products; some views later they are made anew."""


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
        self._grid, self._edges = grid, tile_edges(grid.cells)
        mirrored = self._contraction.mirrored
        self._levels = [
            Level(grid, number, waves, self._order, curved_earth, mirrored) for number in range(grid.levels)
        ]
        call = self._contraction.call
        self._patches = Patches(grid, waves.wavelength, call)
        self._folded_patches = Patches(grid, waves.wavelength, call, folded=True) if mirrored else None
        self._everywhere = tile_sizes(grid.cells, grid.levels) > 0
        self._last_products = {}
        self._anchors_placed, self._kept_at_anchors = None, None

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return self._grid.vertex_count

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
        visible      a flag for each tile (lod.tile_sizes), or None for all; other tiles lie flat, but for those
                     that share a product with visible ones
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
                products += self._still_products(reused, block, anchors, ~self._last_products[block].covered)
            else:
                reused.still = None
        self._contraction.multiply(products)

    def fill_factors(self, time: float, anchors: np.ndarray, blocks=(POSITION,), visible=None) -> None:
        """Form the factors at `time`, for visible tiles: per line and wave one complex multiplication."""
        phase = self._waves.phase_at(time)
        at_origin = self._waves.amplitude * (np.cos(phase) + 1j * np.sin(phase))
        phasors = (at_origin * self._at_anchors(anchors))[:, self._order].astype(np.complex64)  # (levels, waves)
        lines = lines_in_view(self._grid.cells, self._everywhere if visible is None else visible)
        with small_buffers():
            for level, phasor, rows in zip(self._levels, phasors, lines, strict=True):
                level.fill(phasor, anchors, blocks, rows)

    def _at_anchors(self, anchors):
        """exp(i k . anchor) of all waves, (levels, waves), kept until the anchors move."""
        placed = anchors.tobytes()
        if placed != self._anchors_placed:
            phase = anchors @ self._wave_vectors
            self._anchors_placed, self._kept_at_anchors = placed, np.cos(phase) + 1j * np.sin(phase)
        return self._kept_at_anchors

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
        right = self._levels[0].right(block)
        patches = self._folded_patches if right.mirrored else self._patches
        make = self._mirrored_product if right.mirrored else self._product
        found = patches.of(self._everywhere if visible is None else visible, wave_limit)
        for patch in found:
            if patch not in last.made:
                last.made[patch] = make(out, block, patch)
        last.view, last.products = view, [last.made[patch] for patch in found]
        last.covered = None if visible is None else patches.covered(found)
        return last.products

    def _product(self, out, block, patch):
        level = self._levels[patch.level]
        inner = slice(2 * (level.wave_count - patch.wave_count), None)
        place = self._rectangle(patch, 0)
        right = level.right(block).matrix[inner, _columns_of(block, place.columns)]
        return Product(level.plain_left[place.rows, inner], right, _flat(place.of(out)))

    def _mirrored_product(self, out, block, patch):
        level, cells = self._levels[patch.level], self._grid.cells
        right = level.right(block)
        inner = slice(level.mirrored_rows(level.wave_count) - level.mirrored_rows(patch.wave_count), None)
        middle, tiles = cells // 2, len(self._edges) - 1
        own = self._rectangle(patch, tiles // 2)
        of_right = _columns_of(block, slice(own.column_start - middle, own.column_stop - middle))
        mirrored = None
        if patch.image:
            image = patch._replace(column_start=-patch.column_stop, column_stop=-patch.column_start)
            mirrored = self._rectangle(image, tiles // 2).of(out)[:, ::-1]
        return MirroredProduct(
            tuple(left[own.rows, inner] for left in level.mirrored_lefts),
            tuple(matrix[inner, of_right] for matrix in right.matrices),
            right.signs,
            _flat(own.of(out)) if patch.own else None,
            mirrored,
        )

    def _still_products(self, reused, block, anchors, flat):
        """The products that put still water where it is wanted and not yet there."""
        flat &= self._everywhere
        missing = flat.copy()
        if reused.still is not None and reused.still.owner is self._identity:
            moved = (anchors != reused.still.anchors).any(axis=1)
            if self._curved:
                moved[:] |= moved[0]
            missing &= ~reused.still.flags | moved[:, None, None]
        reused.still = _StillWater(self._identity, flat, anchors.copy())
        if not missing.any():
            return []
        return [self._still_product(reused.array, block, patch) for patch in exact_patches(missing)]

    def _still_product(self, out, block, patch):
        level, place = self._levels[patch.level], self._rectangle(patch, 0)
        left = level.plain_left if level.plain_left is not None else level.mirrored_lefts[0]
        right = level.right(block).base[:, _columns_of(block, place.columns)]
        return Product(left[place.rows, -level.base_rows :], right, _flat(place.of(out)))

    def _rectangle(self, patch, first_column):
        """A patch whose columns are counted from the tile `first_column` on, as lines of its level."""
        rows = self._edges[patch.row_start], self._edges[patch.row_stop]
        columns = self._edges[first_column + patch.column_start], self._edges[first_column + patch.column_stop]
        return rectangle(self._grid.cells, patch.level, rows, columns)


def _columns_of(block, lines):
    """The columns that the lines of a block take, side by side."""
    return slice(block.columns * lines.start, block.columns * lines.stop)


def _flat(array):
    """(rows, lines, columns) as (rows, lines x columns): the same memory, as its rows have no gaps."""
    return array.reshape(len(array), -1)
