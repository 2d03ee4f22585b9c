# SPDX-License-Identifier: GPL-3.0-or-later
"""The work that a frame of an ocean takes, counted from its settings without doing it."""

import itertools
from dataclasses import dataclass

import numpy as np

from ..column_blocks import TANGENTS, ColumnBlock
from ..contraction import PIECE_COLUMNS
from ..lod import Grid, tiles
from ..ocean import Ocean
from ..ripples.bump import bump_layout
from ..waves import WaveSet
from ..windows import window_reach

_LONGEST_RUN = 512
"""Rows of one product, about."""


@dataclass(frozen=True)
class Work:
    """Counts of what a frame does.

    multiplications  multiply-adds of all matrix products
    runs             rows of the products times waves: each is one run over columns that lie side by side
    floats           numbers that they write
    products         how many there are
    factor_terms     complex numbers of the factors that are formed anew
    vertices         of the mesh
    normals          vertices whose normal is made from the waves, 0 without
    vectors          arrays of vectors that are handed to Blender
    texels           texels of ripple images that are written, times the bands in each
    far_texels       those of images of so many texels that a processor's caches do not hold them
    images           how many ripple images are written
    foam_multiplications  multiply-adds of the columns in which foam of the past is looked for as well
    foam_runs        rows of their products times waves, as for `runs`
    foam_floats      numbers that are looked through for foam
    foam_products    how many products they take
    foam_vertices    vertices with foam, 0 without
    """

    multiplications: float
    runs: float
    floats: float
    products: float
    factor_terms: float
    vertices: float
    normals: float
    vectors: float
    texels: float
    far_texels: float
    images: float
    foam_multiplications: float
    foam_runs: float
    foam_floats: float
    foam_products: float
    foam_vertices: float


_FOAM_VECTORS = 1 / 3
"""The foam of a vertex is a number, not a vector."""


def work_of(
    ocean: Ocean, waves: WaveSet, blocks: tuple[ColumnBlock, ...], visible=None, wave_limit: int | None = None
) -> Work:
    """The work of one frame with these column blocks, and those of foam if the ocean has foam.

    `visible` and `wave_limit` as in `Placement`.
    """
    counts = _waves_of_tiles(ocean.grid, waves.wavelength)
    plane = tiles(ocean.grid.cells, ocean.grid.levels)
    vertices = np.array([tile.vertex_count for tile in plane], dtype=float)
    if wave_limit is not None:
        counts = np.minimum(counts, wave_limit)
    if visible is not None:
        moving = np.asarray(visible)  # still water is written once
        plane, vertices, counts = tuple(itertools.compress(plane, moving)), vertices[moving], counts[moving]
    base = 4 if ocean.framing.curved_earth else 2
    instants = 0 if ocean.foam is None else ocean.foam.memory_steps
    # The column of the present is real, as those of the blocks are: one more block. Those of the past are complex.
    widths = [block.columns for block in blocks] + [1] * (instants == 1)
    past = instants if instants > 1 else 0
    columns = sum(widths)
    inner = 2 * counts + base
    rows = np.array([tile.rows for tile in plane], dtype=float)
    pieces = np.array([sum(_pieces(tile.columns * width) for width in widths) for tile in plane])
    foam_pieces = np.array([_pieces(tile.columns * past) if past else 0 for tile in plane])
    return Work(
        multiplications=float(columns * np.sum(inner * vertices)),
        runs=float(np.sum(inner * rows * pieces)),
        floats=float(columns * vertices.sum()),
        products=float(len(widths) * _run_count(plane, counts)),
        factor_terms=float(_factor_terms(ocean.grid, waves.wavelength)),
        vertices=float(ocean.grid.vertex_count),
        normals=float(ocean.grid.vertex_count) if TANGENTS in blocks else 0.0,
        vectors=len(blocks) + (_FOAM_VECTORS if instants else 0.0),
        foam_multiplications=float(past * np.sum(inner * vertices)),
        foam_runs=float(np.sum(inner * rows * foam_pieces)),
        foam_floats=float(instants * ocean.grid.vertex_count),
        foam_products=float(_run_count(plane, counts)) if past else 0.0,
        foam_vertices=float(ocean.grid.vertex_count) if instants else 0.0,
        **ripple_work(_images(ocean)),
    )


def _pieces(columns):
    """Into how many runs over neighbouring columns a row of a product is cut."""
    return max(1, round(columns / PIECE_COLUMNS))


def _waves_of_tiles(grid: Grid, wavelength):
    """How many waves are not zero on each tile, (tiles,): those that reach its place nearest to the centre."""
    reach = np.sort(window_reach(grid, wavelength))
    nearest = np.empty(len(tiles(grid.cells, grid.levels)))
    for number, tile in enumerate(tiles(grid.cells, grid.levels)):
        distance = np.abs(np.arange(grid.cells + 1) - grid.cells // 2) * grid.spacing(tile.level)
        rows = distance[tile.row_start : tile.row_stop].min()
        columns = distance[tile.column_start : tile.column_stop].min()
        nearest[number] = max(rows, columns) - (grid.spacing(tile.level) if tile.level else 0.0)
    return len(reach) - np.searchsorted(reach, nearest, side="right")


def _run_count(plane, counts):
    """How many products neighbouring tiles are grouped into, about: strips of rows with as many waves."""
    runs, rows, last = 0, 0, None
    for tile, count in zip(plane, counts, strict=True):
        goes_on = last is not None and (tile.level, tile.column_start, tile.row_start) == last[:3]
        if not goes_on or abs(count - last[3]) > min(count, last[3]) / 8 or rows + tile.rows > _LONGEST_RUN:
            runs, rows = runs + 1, 0
        rows += tile.rows
        last = (tile.level, tile.column_start, tile.row_stop, count)
    return runs


def _factor_terms(grid: Grid, wavelength):
    """Lines times waves of all levels: each wave on those that it reaches."""
    reach = window_reach(grid, wavelength)
    inner = [0.0] + [grid.spacing(level) * (grid.cells / 4 - 1) for level in range(1, grid.levels)]
    return sum((grid.cells + 1) * int(np.count_nonzero(reach > distance)) for distance in inner)


_CACHED_TEXELS = 512
"""Texels along a side of an image, in complex numbers of 8 bytes, that caches hold beside all else: 2 MB."""


def ripple_work(images) -> dict[str, float]:
    """The counts of writing these images (ripples.layout.Tile), by their names in `Work`."""
    texels = [float(image.texels**2 * len(image.bands)) for image in images]
    far = [count for count, image in zip(texels, images, strict=True) if image.texels > _CACHED_TEXELS]
    return {"texels": sum(texels), "far_texels": float(sum(far)), "images": float(len(images))}


def _images(ocean):
    """The ripple images that every frame writes; a still one as well, as Blender saves no pixels with a file."""
    if ocean.ripples.kind == "off":
        return ()
    return bump_layout(ocean.ripples, ocean.grid.shortest_wavelength).tiles
