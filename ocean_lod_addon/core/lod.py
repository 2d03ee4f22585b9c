# SPDX-License-Identifier: GPL-3.0-or-later
"""The multi-LOD plane: nested square levels, each twice as coarse as the one inside it, welded into one mesh.

Level l is a square lattice of spacing h_l = h_0 2^l with `cells` cells a side; all levels but the innermost
have a hole in the middle, half as wide, which the next finer level fills. The vertices of a level stand on its
own lattice, shifted as a whole by the level's anchor, so that a plane that follows a camera moves over a fixed
lattice and the surface does not swim. A strip one cell thick joins a level's hole to the finer level's outer
edge; it alone stretches when the two anchors differ. The topology never depends on the anchors.

Each level is cut into rectangular tiles. A tile is a tensor-product grid of lines, evaluated by one matrix
product, and a contiguous range of the vertex buffer.
"""

import dataclasses
import functools
import itertools
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
        return sum(tile.vertex_count for tile in tiles(self.cells, self.levels))

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
class Tile:
    """A rectangle of one level's lines: rows [row_start, row_stop) of x, columns [...) of y.

    Its vertices are a contiguous range of the vertex buffer from `first_vertex`, row by row.
    """

    level: int
    row_start: int
    row_stop: int
    column_start: int
    column_stop: int
    first_vertex: int

    @property
    def rows(self) -> int:
        """Number of x lines."""
        return self.row_stop - self.row_start

    @property
    def columns(self) -> int:
        """Number of y lines."""
        return self.column_stop - self.column_start

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return self.rows * self.columns

    @property
    def vertices(self) -> slice:
        """The tile's range of the vertex buffer."""
        return slice(self.first_vertex, self.first_vertex + self.vertex_count)


_TILE_ROWS, _TILE_COLUMNS = 16, 64
"""Lines along a tile's sides, about. Tiles that follow each other in x are evaluated as one product, so short ones
cost nothing there and leave out the more of what is not in view; strips of them must be wide to be fast."""

_MOST_PIECES = 16
"""Of a quarter of a level's lines: the finest planes have tiles enough."""


def _tile_edges(cells, size):
    """Line numbers where tiles begin, and the end; the closed hole [cells/4, 3 cells/4] is a union of tiles.

    They mirror each other about the middle line, which itself belongs to the tile after it.
    """
    middle, quarter = cells // 2, cells // 4
    pieces = min(max(1, round(quarter / size)), _MOST_PIECES)
    cuts = [quarter * piece // pieces for piece in range(pieces)]
    low = [side * quarter + cut for side in range(2) for cut in cuts]
    high = [cells + 1 - start for start in reversed(low[1:])]
    return [*low, middle, *high, cells + 1]


@functools.lru_cache(maxsize=32)
def tiles(cells: int, levels: int) -> tuple[Tile, ...]:
    """The tiles of the plane in vertex order, innermost level first; together they own every vertex once.

    Within a level, tiles that follow each other in x do so in the vertex buffer, where their rows make one
    longer block: neighbours can be evaluated as one product.
    """
    rows = list(itertools.pairwise(_tile_edges(cells, _TILE_ROWS)))
    hole = range(cells // 4, 3 * cells // 4 + 1)
    result, first_vertex = [], 0
    for level in range(levels):
        for column_start, column_stop in tile_columns(cells):
            for row_start, row_stop in rows:
                if level > 0 and row_start in hole and column_start in hole:
                    continue
                tile = Tile(level, row_start, row_stop, column_start, column_stop, first_vertex)
                result.append(tile)
                first_vertex += tile.vertex_count
    return tuple(result)


def tile_columns(cells: int) -> list[tuple[int, int]]:
    """The strips that tiles stand in: (first, past the last) of their y lines, in order.

    Each has a mirror image about the middle line, but for that line itself, with which the first of the upper half
    begins.
    """
    return list(itertools.pairwise(_tile_edges(cells, _TILE_COLUMNS)))


@dataclass(frozen=True, eq=False)
class TileTable:
    """The numbers of all tiles as arrays, (tiles,) int."""

    level: np.ndarray
    row_start: np.ndarray
    row_stop: np.ndarray
    column_start: np.ndarray
    column_stop: np.ndarray
    first_vertex: np.ndarray


@functools.lru_cache(maxsize=32)
def tile_table(cells: int, levels: int) -> TileTable:
    """The tiles of the plane in vertex order, for sums over all of them."""
    fields = [field.name for field in dataclasses.fields(TileTable)]
    numbers = [[getattr(tile, field) for field in fields] for tile in tiles(cells, levels)]
    return TileTable(*np.array(numbers).T)


def undisturbed_positions(grid: Grid, anchors: np.ndarray) -> np.ndarray:
    """Where the vertices stand in still water, (vertices, 2) float64, m, for level anchors (levels, 2)."""
    plane = tiles(grid.cells, grid.levels)
    positions = np.empty((plane[-1].vertices.stop, 2))
    for tile in plane:
        x, y = (grid.lines(tile.level) + anchor for anchor in anchors[tile.level])
        block = positions[tile.vertices].reshape(tile.rows, tile.columns, 2)
        block[..., 0] = x[tile.row_start : tile.row_stop, None]
        block[..., 1] = y[None, tile.column_start : tile.column_stop]
    return positions


@dataclass(frozen=True, eq=False)
class Topology:
    """Faces of the plane as vertex numbers, counter-clockwise seen from above."""

    vertex_count: int
    triangles: np.ndarray  # (T, 3) int32
    quads: np.ndarray  # (Q, 4) int32


def topology(cells: int, levels: int) -> Topology:
    """The faces of the plane. Quads within a level, triangles in the strips that join two levels."""
    plane = tiles(cells, levels)
    numbers = _vertex_numbers(cells, levels, plane)
    quads = [_level_quads(numbers[0], with_hole=False)]
    triangles = [np.empty((0, 3), np.int32)]
    for coarse, fine in zip(numbers[1:], numbers[:-1], strict=True):
        quads.append(_level_quads(coarse, with_hole=True))
        triangles.append(_strip_triangles(coarse, fine))
    count = plane[-1].vertices.stop
    return Topology(count, np.concatenate(triangles), np.concatenate(quads))


def _vertex_numbers(cells, levels, plane):
    """Vertex number at each lattice point of each level, (cells + 1)^2 int32; -1 in a level's hole."""
    numbers = [np.full((cells + 1, cells + 1), -1, np.int32) for _ in range(levels)]
    for tile in plane:
        block = np.arange(tile.vertices.start, tile.vertices.stop, dtype=np.int32)
        numbers[tile.level][tile.row_start : tile.row_stop, tile.column_start : tile.column_stop] = (
            block.reshape(tile.rows, tile.columns)
        )
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
