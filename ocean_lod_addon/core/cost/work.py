# SPDX-License-Identifier: GPL-3.0-or-later
"""The work that a frame of an ocean takes, counted from its settings without doing it."""

import functools
from dataclasses import dataclass

import numpy as np

from ..column_blocks import TANGENTS, ColumnBlock
from ..contraction import CONTRACTIONS, PIECE_COLUMNS, PIECE_ROWS, piece_count, shares
from ..factors import mirrored_terms
from ..lod import tile_edges, tile_sizes
from ..ocean import Ocean
from ..patches import Patches, lines_in_view
from ..ripples.bump import bump_layout
from ..ripples.synthesis import line_pieces
from ..waves import WaveSet
from ..windows import fading_waves, first_wave


@dataclass(frozen=True)
class Work:
    """Counts of what a frame does.

    multiplications  multiply-adds of all matrix products
    passes           what else goes over the factors: a BLAS rearranges each number of the right one; without one,
                     each row of the products times waves is one run over columns that lie side by side
    floats           numbers that they write
    products         how many there are, or how many pieces they are cut into
    levels           of the plane
    factor_terms     complex numbers of the factors that are formed anew
    vertices         of the mesh
    normals_shared   1 if so many normals are shared out to cores, 0 if one makes them all
    normals          vertices whose normal is made from the waves, 0 without
    vectors          arrays of vectors that are handed to Blender
    texels           texels of ripple images that one core writes, times the bands in each
    shared_texels    those of images so large that they are shared out to cores
    images           how many ripple images are written
    foam_multiplications  multiply-adds of the columns in which foam of the past is looked for as well
    foam_passes      what else goes over their factors
    foam_floats      numbers that they write
    foam_products    how many products they take
    foam_instants    numbers that are looked through for foam, and those that come of it
    foam_shared      1 if so many are shared out to cores, 0 if one takes them all
    foam_lines       lines of the cache that this touches: those of a vertex lie side by side, and are taken one by
                     one
    """

    multiplications: float
    passes: float
    floats: float
    products: float
    levels: float
    factor_terms: float
    vertices: float
    normals_shared: float
    normals: float
    vectors: float
    texels: float
    shared_texels: float
    images: float
    foam_multiplications: float
    foam_passes: float
    foam_floats: float
    foam_products: float
    foam_instants: float
    foam_shared: float
    foam_lines: float


_NUMBERS_IN_LINE = 16
"""float32 in a line of a processor's cache."""

_FOAM_VECTORS = 1 / 3
"""The foam of a vertex is a number, not a vector."""


def work_of(
    ocean: Ocean,
    waves: WaveSet,
    blocks: tuple[ColumnBlock, ...],
    contraction: str,
    visible=None,
    wave_limit: int | None = None,
) -> Work:
    """The work of one frame with these column blocks, and those of foam if the ocean has foam.

    `contraction` is one of contraction.CONTRACTIONS; `visible` and `wave_limit` as in `Placement`. Still water is
    written once and not counted.
    """
    grid, mirrored = ocean.grid, CONTRACTIONS[contraction].mirrored
    visible = tile_sizes(grid.cells, grid.levels) > 0 if visible is None else visible
    base = 4 if ocean.framing.curved_earth else 2
    instants = 0 if ocean.foam is None else ocean.foam.memory_steps
    # The column of the present is real, as those of the blocks are: one more block. Those of the past are complex.
    widths = [block.columns for block in blocks] + [1] * (instants == 1)
    past = [instants] if instants > 1 else []
    present, before = (
        _product_work(grid, waves, base, contraction, columns, mirrored and columns is widths, visible, wave_limit)
        for columns in (widths, past)
    )
    kinds_of_left = 1 + (mirrored and bool(past) and bool(widths))
    vertices = float(grid.vertex_count)
    return Work(
        multiplications=present.multiplications,
        passes=present.passes,
        floats=present.floats,
        products=present.products,
        levels=float(grid.levels),
        factor_terms=float(kinds_of_left * _factor_terms(grid, waves, visible)),
        vertices=vertices,
        normals_shared=_is_shared(grid.vertex_count),
        normals=vertices if TANGENTS in blocks else 0.0,
        vectors=len(blocks) + (_FOAM_VECTORS if instants else 0.0),
        foam_multiplications=before.multiplications,
        foam_passes=before.passes,
        foam_floats=before.floats,
        foam_products=before.products,
        foam_instants=(instants + 1) * vertices if instants else 0.0,
        foam_shared=_is_shared(grid.vertex_count, max(instants, 1)),
        foam_lines=instants * vertices * min(instants / _NUMBERS_IN_LINE, 1.0),
        **ripple_work(_images(ocean)),
    )


@dataclass(frozen=True)
class _ProductWork:
    """The part of `Work` that products of one kind make; all 0 without columns."""

    multiplications: float
    passes: float
    floats: float
    products: float


def _product_work(grid, waves, base, contraction, widths, folded, visible, wave_limit):
    """Of blocks with so many columns each, on a plane that is folded about its middle line or not."""
    patches = _patches(grid, waves, contraction, folded).of(visible, wave_limit) if widths else []
    if not patches:
        return _ProductWork(0.0, 0.0, 0.0, 0.0)
    level, row, row_stop, column, column_stop, count, own, image = np.array(patches, int).T
    edges = np.array(tile_edges(grid.cells))
    rows = edges[row_stop] - edges[row]
    columns = edges[len(edges) // 2 :] if folded else edges
    lines = columns[column_stop] - columns[column]
    written = (own + image) * lines - (image * (column == 0) if folded else 0)  # the middle line has no image
    terms = 2 * count + base
    if folded:
        present, fading = _level_waves(grid, waves)
        terms = 2 * (mirrored_terms(count, present[level], fading[level]) + base)
    multiplications = passes = products = 0.0
    for width in widths:
        multiplications += width * float(np.sum(terms * rows * lines))
        if contraction == "einsum":
            across = _pieces(rows, PIECE_ROWS)
            along = _pieces(lines, PIECE_COLUMNS // width) if folded else _pieces(width * lines, PIECE_COLUMNS)
            passes += float(np.sum(terms * rows * along))
            products += float(np.sum(across * along))
        else:
            passes += width * float(np.sum(terms * lines))
            products += len(rows)
    return _ProductWork(multiplications, passes, sum(widths) * float(np.sum(rows * written)), products)


def _pieces(lengths, size):
    return np.array([piece_count(length, size) for length in lengths.tolist()])


@functools.lru_cache(maxsize=32)
def _patches(grid, waves, contraction, folded):
    return Patches(grid, waves.wavelength, CONTRACTIONS[contraction].call, folded)


def _level_waves(grid, waves):
    """How many waves there are on each level, and how many of them fade on it, (levels,) int."""
    wavelength = np.sort(waves.wavelength)
    firsts = [first_wave(grid, level, wavelength) for level in range(grid.levels)]
    fading = [fading_waves(grid, level, wavelength[first:]) for level, first in enumerate(firsts)]
    return len(wavelength) - np.array(firsts), np.array(fading)


def _factor_terms(grid, waves, visible):
    """Lines times waves of all levels, from the first to the last line in view."""
    lines = [rows.stop - rows.start for rows in lines_in_view(grid.cells, visible)]
    return np.dot(lines, _level_waves(grid, waves)[0])


def _is_shared(vertices: int, columns: int = 1) -> float:
    """Whether so many vertices with so many columns each are shared out to cores, 0 or 1."""
    return float(len(shares(vertices, columns)) > 1)


def ripple_work(images) -> dict[str, float]:
    """The counts of writing these images (ripples.layout.Tile), by their names in `Work`."""
    texels = np.array([image.texels**2 * len(image.bands) for image in images], float)
    shared = np.array([len(line_pieces(image.texels, image.texels)) > 1 for image in images], bool)
    return {
        "texels": float(texels[~shared].sum()),
        "shared_texels": float(texels[shared].sum()),
        "images": float(len(images)),
    }


def _images(ocean):
    """The ripple images that every frame writes; a still one as well, as Blender saves no pixels with a file."""
    if ocean.ripples.kind == "off":
        return ()
    return bump_layout(ocean.ripples, ocean.grid.shortest_wavelength).tiles
