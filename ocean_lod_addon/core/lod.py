# SPDX-License-Identifier: GPL-3.0-or-later
"""The multi-LOD plane: nested square levels, each twice as coarse as the one inside it, welded into one mesh.

Level l is a square lattice of spacing h_l = h_0 2^l with `cells` cells a side; all levels but the innermost
have a hole in the middle, half as wide, which the next finer level fills. The vertices of a level stand on its
own lattice, shifted as a whole by the level's anchor, so that a plane that follows a camera moves over a fixed
lattice and the surface does not swim. A strip one cell thick joins a level's hole to the finer level's outer
edge; it alone stretches when the two anchors differ. The topology never depends on the anchors.

The vertices of a level lie in the vertex buffer row by row, one x line after the other, without the hole. So every
rectangle of lines that keeps clear of the hole is an array with a stride, which one matrix product can fill. What
is in view is told by rectangular tiles, cut along both axes at `tile_edges`.
"""

import functools
from dataclasses import dataclass

import numpy as np

from .errors import OceanError
from .parameters import integer, number, validate

CELLS_STEP = 8
"""Cells a side come in multiples of this, so that holes and tiles fall on lattice lines."""


@dataclass(frozen=True)
class Grid:
    """The shape of the plane."""

    cell_size: float = number(
        "Cell Size",
        "Distance between vertices of the innermost level. Every further level is twice as coarse",
        0.1, 1e-4, 1e3, "m", soft_maximum=2.0,
    )  # fmt: skip
    cells: int = integer(
        "Cells",
        "Cells along each side of a level, a multiple of 8. Twice as many cells resolve waves half as long, "
        "at four times the vertices",
        256, CELLS_STEP, 2048,
    )  # fmt: skip
    levels: int = integer(
        "Levels",
        "Number of nested levels; each one doubles the reach of the ocean",
        11, 1, 20,
    )  # fmt: skip
    samples_per_wavelength: float = number(
        "Samples/Wave",
        "A wave is geometry where the mesh has at least this many vertices per wavelength, and fades out "
        "into shading beyond",
        4.0, 2.0, 32.0,
    )  # fmt: skip

    def __post_init__(self):
        validate(self)
        if self.cells % CELLS_STEP:
            raise OceanError(f"cells is {self.cells}, allowed is a multiple of {CELLS_STEP}")

    @property
    def shortest_wavelength(self) -> float:
        """The shortest wave that the innermost level resolves, m."""
        return self.samples_per_wavelength * self.cell_size

    @property
    def half_extent(self) -> float:
        """Distance from the centre to the outer square's edge, m."""
        return self.spacing(self.levels - 1) * self.cells / 2

    @property
    def vertex_count(self) -> int:
        """Number of vertices of the whole mesh."""
        return _level_start(self.cells, self.levels)

    def spacing(self, level: int) -> float:
        """Lattice spacing of a level, m."""
        return self.cell_size * 2.0**level

    def lines(self, level: int) -> np.ndarray:
        """Line coordinates of a level relative to its anchor, m, shape (cells + 1,), float64."""
        return (np.arange(self.cells + 1) - self.cells // 2) * self.spacing(level)


def level_anchors(grid: Grid, centre) -> np.ndarray:
    """Where each level is centred to follow a point `centre` (x, y in m): its nearest own lattice point.

    (levels, 2) float64. Vertices of a level always stand on the same lattice in the world, so a surface does not
    swim under a moving plane. Neighbouring levels differ by no more than half a cell of the coarser one.
    """
    spacing = grid.cell_size * np.exp2(np.arange(grid.levels))[:, None]
    return np.round(np.asarray(centre, dtype=np.float64) / spacing) * spacing


@dataclass(frozen=True)
class Rectangle:
    """Some of one level's lines: rows [row_start, row_stop) of x, columns [column_start, column_stop) of y.

    Its vertices are in the vertex buffer from `first_vertex`, each row `stride` vertices after the one before.
    """

    level: int
    row_start: int
    row_stop: int
    column_start: int
    column_stop: int
    first_vertex: int
    stride: int

    @property
    def rows(self) -> slice:
        """The x lines."""
        return slice(self.row_start, self.row_stop)

    @property
    def columns(self) -> slice:
        """The y lines."""
        return slice(self.column_start, self.column_stop)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of x lines and of y lines."""
        return self.row_stop - self.row_start, self.column_stop - self.column_start

    def of(self, array: np.ndarray) -> np.ndarray:
        """The rectangle in a C-contiguous array over all vertices, (rows, columns, ...): a view of it."""
        step, *rest = array.strides
        shape, strides = (*self.shape, *array.shape[1:]), (self.stride * step, step, *rest)
        return np.ndarray(shape, array.dtype, array, self.first_vertex * step, strides)


def rectangle(cells: int, level: int, rows: tuple[int, int], columns: tuple[int, int]) -> Rectangle:
    """The rectangle of the lines from the first to before the second of `rows` and `columns`.

    In rows that the level's hole is in, either all columns are before it or all are after it.
    """
    (row_start, row_stop), (column_start, column_stop) = rows, columns
    side, hole = cells + 1, _hole(cells) if level else range(0)
    beside = row_start in hole
    if any(row_start < edge < row_stop for edge in (hole.start, hole.stop)) or (
        beside and column_stop > hole.start and column_start < hole.stop
    ):
        raise ValueError(f"rows {rows}, columns {columns} do not keep clear of the hole of level {level}")
    rows_of_hole = min(max(row_start - hole.start, 0), len(hole))
    first_vertex = _level_start(cells, level) + row_start * side - rows_of_hole * len(hole) + column_start
    if beside and column_start >= hole.stop:
        first_vertex -= len(hole)
    stride = side - len(hole) if beside else side
    return Rectangle(level, row_start, row_stop, column_start, column_stop, first_vertex, stride)


def _hole(cells):
    """The lines in the hole of a level, along either axis."""
    return range(cells // 4, 3 * cells // 4 + 1)


def _level_start(cells, level):
    """The first vertex of a level; that of the level past the last one is the number of all vertices."""
    if level == 0:
        return 0
    lattice, hole = (cells + 1) ** 2, len(_hole(cells)) ** 2
    return lattice + (level - 1) * (lattice - hole)


@functools.lru_cache(maxsize=32)
def parts(cells: int, level: int) -> tuple[Rectangle, ...]:
    """Rectangles that together own every vertex of a level once: four around the hole, or the innermost itself."""
    hole, all_lines = _hole(cells), (0, cells + 1)
    low, beside, high = (0, hole.start), (hole.start, hole.stop), (hole.stop, cells + 1)
    around = [(low, all_lines), (beside, low), (beside, high), (high, all_lines)]
    return tuple(rectangle(cells, level, *lines) for lines in (around if level else [(all_lines, all_lines)]))


_TILE_LINES = 16
"""Lines along a tile's sides, about. Tiles that are evaluated are put together to larger rectangles, so small ones
cost nothing there and leave out the more of what is not in view."""

_MOST_PIECES = 16
"""Of a quarter of a level's lines, about: the finest planes have tiles enough."""

_BLAS_ROWS = 8
"""A BLAS makes so many rows of a product at a time, or a divisor of it. A product of 33 or 49 rows takes a fifth
longer per row than one of 32 or 48."""


@functools.lru_cache(maxsize=32)
def tile_edges(cells: int) -> tuple[int, ...]:
    """Line numbers where tiles begin along either axis, and the end; the closed hole [cells/4, 3 cells/4] is a
    union of tiles.

    They mirror each other about the middle line, which itself belongs to the tile after it. A quarter of the tiles
    is before the hole, and a quarter after it. In each quarter all tiles but the innermost have the same multiple
    of `_BLAS_ROWS` lines.
    """
    middle, quarter = cells // 2, cells // 4
    lines = max(_TILE_LINES, _BLAS_ROWS * round(quarter / (_BLAS_ROWS * _MOST_PIECES)))
    cuts = [lines * piece for piece in range(max(1, round(quarter / lines)))]
    low = [side * quarter + cut for side in range(2) for cut in cuts]
    high = [cells + 1 - start for start in reversed(low[1:])]
    return (*low, middle, *high, cells + 1)


def tile_sides(cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Along either axis, of each tile: the middle of its lines from the level's anchor, and half its length, in
    cells."""
    edges = np.array(tile_edges(cells))
    first, last = edges[:-1], edges[1:] - 1
    return 0.5 * (first + last) - cells // 2, 0.5 * (last - first)


@functools.lru_cache(maxsize=32)
def tile_sizes(cells: int, levels: int) -> np.ndarray:
    """Number of vertices of each tile, (levels, tiles in a column, tiles in a row) int; 0 in the hole of a level.

    Arrays over tiles, such as which of them are in view, have this shape.
    """
    lengths = np.diff(tile_edges(cells))
    sizes = np.tile(np.outer(lengths, lengths), (levels, 1, 1))
    quarter = len(lengths) // 4
    sizes[1:, quarter : 3 * quarter, quarter : 3 * quarter] = 0
    sizes.flags.writeable = False
    return sizes


def undisturbed_positions(grid: Grid, anchors: np.ndarray) -> np.ndarray:
    """Where the vertices stand in still water, (vertices, 2) float64, m, for level anchors (levels, 2)."""
    positions = np.empty((grid.vertex_count, 2))
    for level in range(grid.levels):
        x, y = (grid.lines(level) + anchor for anchor in anchors[level])
        for part in parts(grid.cells, level):
            block = part.of(positions)
            block[..., 0] = x[part.rows, None]
            block[..., 1] = y[None, part.columns]
    return positions


@dataclass(frozen=True, eq=False)
class Topology:
    """Faces of the plane as vertex numbers, counter-clockwise seen from above."""

    vertex_count: int
    triangles: np.ndarray  # (T, 3) int32
    quads: np.ndarray  # (Q, 4) int32


def topology(cells: int, levels: int) -> Topology:
    """The faces of the plane. Quads within a level, triangles in the strips that join two levels."""
    count = _level_start(cells, levels)
    numbers = _vertex_numbers(cells, levels, count)
    quads = [_level_quads(numbers[0], with_hole=False)]
    triangles = [np.empty((0, 3), np.int32)]
    for coarse, fine in zip(numbers[1:], numbers[:-1], strict=True):
        quads.append(_level_quads(coarse, with_hole=True))
        triangles.append(_strip_triangles(coarse, fine))
    return Topology(count, np.concatenate(triangles), np.concatenate(quads))


def _vertex_numbers(cells, levels, count):
    """Vertex number at each lattice point of each level, (cells + 1)^2 int32; -1 in a level's hole."""
    numbers = [np.full((cells + 1, cells + 1), -1, np.int32) for _ in range(levels)]
    every = np.arange(count, dtype=np.int32)
    for level, lattice in enumerate(numbers):
        for part in parts(cells, level):
            lattice[part.rows, part.columns] = part.of(every)
    return numbers


def _level_quads(numbers, with_hole):
    corners = np.stack([numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]], axis=-1)
    if not with_hole:
        return corners.reshape(-1, 4)
    return corners[(corners >= 0).all(axis=-1)]


def _strip_triangles(coarse, fine):
    """Join a level's hole to the finer level's outer edge: three triangles a cell, two in each corner."""
    cells = len(coarse) - 1
    ring = [_ring(coarse, cells // 4 - 1), _ring(fine, 0)]
    inner_last, outer_last = cells // 2, cells // 2 + 2
    parts = []
    for side in range(4):
        outer, inner = ring[0][side], ring[1][side]
        left, middle, right = inner[0:-1:2], inner[1::2], inner[2::2]
        below_left, below_right = outer[1 : outer_last - 1], outer[2:outer_last]
        parts += [
            np.stack([below_left, middle, left], axis=-1),
            np.stack([below_left, below_right, middle], axis=-1),
            np.stack([below_right, right, middle], axis=-1),
        ]
        corner = outer[0]
        after, before = outer[1], ring[0][side - 1][outer_last - 1]
        parts.append(np.array([[corner, after, inner[0]], [corner, inner[0], before]]))
    assert len(middle) == inner_last
    return np.concatenate(parts).astype(np.int32)


def _ring(numbers, inset):
    """The four sides of the square `inset` lines inside the border, counter-clockwise from (inset, inset)."""
    low, high = inset, len(numbers) - 1 - inset
    along = slice(low, high + 1)
    return [numbers[along, low], numbers[high, along], numbers[along, high][::-1], numbers[low, along][::-1]]
