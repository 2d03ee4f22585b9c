# SPDX-License-Identifier: GPL-3.0-or-later
"""The tiles of a plane one by one, for tests that look at each."""

import numpy as np

from ocean_lod_addon.core.lod import Grid, Rectangle, rectangle, tile_edges, tile_sizes


def tiles(grid: Grid) -> list[tuple[tuple[int, int, int], Rectangle]]:
    """All tiles, each with its place in arrays over tiles."""
    edges = tile_edges(grid.cells)
    places = [tuple(place) for place in np.argwhere(tile_sizes(grid.cells, grid.levels)).tolist()]
    return [
        ((level, i, j), rectangle(grid.cells, level, (edges[i], edges[i + 1]), (edges[j], edges[j + 1])))
        for level, i, j in places
    ]


def no_tile(grid: Grid) -> np.ndarray:
    """A flag for each tile, none of them set."""
    return np.zeros(tile_sizes(grid.cells, grid.levels).shape, bool)
