# SPDX-License-Identifier: GPL-3.0-or-later
"""Tiles in view are put together to rectangles: none is left out, each has its waves, and it costs less."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ocean_lod_addon.core.contraction import CONTRACTIONS, CallCost
from ocean_lod_addon.core.lod import Grid, rectangle, tile_edges, tile_sizes
from ocean_lod_addon.core.patches import Patches, exact_patches, wave_counts
from ocean_lod_addon.core.windows import window, window_reach

from .plane_tiles import no_tile, tiles

GRID = Grid(cell_size=0.25, cells=256, levels=5)
WAVELENGTH = GRID.shortest_wavelength * np.exp2(np.linspace(0.0, 6.0, 60))
SIZES = tile_sizes(GRID.cells, GRID.levels)
EDGES = np.array(tile_edges(GRID.cells))
CALL = CONTRACTIONS["matmul"].call


def some_tiles(seed, share):
    return (np.random.default_rng(seed).random(SIZES.shape) < share) & (SIZES > 0)


def wedge(heading, half_angle):
    """Tiles whose middles lie in a wedge from the plane's middle, as a level camera sees them."""
    middles = 0.5 * (EDGES[:-1] + EDGES[1:] - 1) - GRID.cells // 2
    x, y = np.meshgrid(middles, middles, indexing="ij")
    turned = np.angle((x + 1j * y) * np.exp(-1j * heading))
    return (np.abs(turned) < half_angle) & (SIZES > 0)


views = st.one_of(
    st.builds(some_tiles, st.integers(0, 1000), st.sampled_from([0.0, 0.01, 0.3, 1.0])),
    st.builds(wedge, st.floats(-3.2, 3.2), st.floats(0.05, 3.0)),
)


def vertices_in(patches, first_column=0):
    """How often each vertex is in a patch."""
    counts = np.zeros(GRID.vertex_count, int)
    for patch in patches:
        ends = [(patch.row_start, patch.row_stop)]
        ends.append((first_column + patch.column_start, first_column + patch.column_stop))
        rows, columns = (tuple(int(EDGES[end]) for end in axis) for axis in ends)
        rectangle(GRID.cells, patch.level, rows, columns).of(counts)[:] += 1
    return counts


def vertices_of(flags):
    """Whether each vertex is in one of these tiles."""
    result = np.zeros(GRID.vertex_count, bool)
    for number, tile in tiles(GRID):
        tile.of(result)[:] = flags[number]
    return result


@given(views)
def test_patches_cover_what_is_visible_and_say_what_they_cover(visible):
    patches = Patches(GRID, WAVELENGTH, CALL)
    found = patches.of(visible)
    covered = patches.covered(found)
    assert not (visible & ~covered).any()
    assert ((vertices_in(found) > 0) == vertices_of(covered)).all()


@given(views)
def test_folded_patches_cover_what_is_visible_in_both_halves(visible):
    patches = Patches(GRID, WAVELENGTH, CALL, folded=True)
    found = patches.of(visible)
    covered = patches.covered(found)
    assert not (visible & ~covered).any()
    middle = len(EDGES) // 2
    own = vertices_in([patch for patch in found if patch.own], middle) > 0
    upper = no_tile(GRID)
    upper[:, :, middle:] = covered[:, :, middle:]
    assert (own == vertices_of(upper)).all()
    image = no_tile(GRID)
    for patch in found:
        if patch.image:
            columns = slice(middle - patch.column_stop, middle - patch.column_start)
            image[patch.level, patch.row_start : patch.row_stop, columns] = True
    assert (image[:, :, :middle] == covered[:, :, :middle]).all()


@given(views)
def test_exact_patches_cover_just_these_tiles_once(flags):
    assert (vertices_in(exact_patches(flags)) == vertices_of(flags)).all()


@pytest.mark.parametrize("heading", [0.0, 0.4, 1.5, 3.0, -2.0])
@pytest.mark.parametrize("folded", [False, True])
@pytest.mark.parametrize(
    "call", [CallCost(0, 0.0), CallCost(8, 0.0), *(each.call for each in CONTRACTIONS.values())]
)
def test_putting_rows_together_costs_no_more_than_one_by_one(call, heading, folded):
    """A row of a wedge is a run of tiles. Where calls cost nothing, nothing else is multiplied."""
    patches = Patches(GRID, WAVELENGTH, call, folded)
    visible = wedge(heading, 0.6)
    middle = len(EDGES) // 2 if folded else 0
    wanted = visible[:, :, middle:] | (visible[:, :, middle - 1 :: -1] if folded else False)
    counts = wave_counts(GRID, WAVELENGTH)[:, :, middle:]
    rows, needed, one_by_one = 0, 0, 0.0
    for level, row in np.argwhere(wanted.any(axis=2)):
        for part in _beside_hole(wanted[level, row], level, row, folded):
            lines = np.diff(EDGES)[middle:][part].sum()
            terms = 2 * counts[level, row][part].max() + 2
            rows += 1
            needed += np.diff(EDGES)[row] * lines * terms
            one_by_one += (np.diff(EDGES)[row] + call.rows) * lines * terms + call.terms
    taken, together = 0, 0.0
    found = patches.of(visible)
    for patch in found:
        height = EDGES[patch.row_stop] - EDGES[patch.row_start]
        lines = EDGES[middle + patch.column_stop] - EDGES[middle + patch.column_start]
        terms = 2 * patch.wave_count + 2
        taken += height * lines * terms
        together += (height + call.rows) * lines * terms + call.terms
    assert needed <= taken
    assert together <= one_by_one
    if call == CallCost(0, 0.0):
        assert taken == needed
    else:
        assert len(found) < rows


def _beside_hole(flags, level, row, folded):
    """The tiles of a row, as one run or, beside a level's hole on a plane that is not folded, as two."""
    tiles_in_all = len(EDGES) - 1
    past_hole = np.arange(len(flags)) >= 3 * tiles_in_all // 4
    if folded or not level or not tiles_in_all // 4 <= row < 3 * tiles_in_all // 4:
        return [flags]
    return [part for part in (flags & ~past_hole, flags & past_hole) if part.any()]


@given(views, st.integers(0, 10))
def test_a_patch_has_all_waves_that_reach_it_up_to_the_limit(visible, limit):
    """Straight from the windows, at each of its vertices, however far the level's anchor is from the windows'
    centres: half a cell of either, and a cell of the level is more."""
    reach = np.sort(window_reach(GRID, WAVELENGTH))
    for patch in Patches(GRID, WAVELENGTH, CALL).of(visible):
        lines = np.abs(GRID.lines(patch.level))
        rows = lines[EDGES[patch.row_start] : EDGES[patch.row_stop]].min()
        columns = lines[EDGES[patch.column_start] : EDGES[patch.column_stop]].min()
        nearest = max(max(rows, columns) - GRID.spacing(patch.level), 0.0)
        if patch.level:
            nearest = max(nearest, GRID.lines(patch.level)[3 * GRID.cells // 4 + 1] - GRID.spacing(patch.level))
        assert not window(nearest, reach[: len(reach) - patch.wave_count]).any()
    for patch in Patches(GRID, WAVELENGTH, CALL).of(visible, limit):
        assert patch.wave_count <= limit


def test_still_patches_have_no_waves():
    assert all(patch.wave_count == 0 for patch in exact_patches(some_tiles(1, 0.5)))
