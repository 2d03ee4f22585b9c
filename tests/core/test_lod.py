# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane is one welded, watertight surface whose only boundary is the outer square."""

import numpy as np
import pytest

from ocean_lod_addon.core.errors import OceanError
from ocean_lod_addon.core.lod import Grid, level_anchors, parts, rectangle, tile_edges, tile_sizes, topology

from .plane_tiles import tiles

SHAPES = [(8, 1), (8, 2), (8, 5), (64, 4), (256, 9), (512, 2)]


def flat_positions(cells, levels, centre=(0.0, 0.0)):
    """Undisturbed vertex positions, (vertices, 2); NaN would show a vertex that no part owns."""
    grid = Grid(1.0, cells, levels)
    positions = np.full((grid.vertex_count, 2), np.nan)
    anchors = level_anchors(grid, centre)
    for level in range(levels):
        x_lines, y_lines = (grid.lines(level) + anchor for anchor in anchors[level])
        for part in parts(cells, level):
            x, y = np.meshgrid(x_lines[part.rows], y_lines[part.columns], indexing="ij")
            part.of(positions)[:] = np.stack([x, y], axis=-1)
    return positions


@pytest.mark.parametrize(("cells", "levels"), SHAPES)
def test_tiles_own_every_vertex_once(cells, levels):
    grid = Grid(1.0, cells, levels)
    owners = np.zeros(grid.vertex_count, int)
    sizes = tile_sizes(cells, levels)
    for number, tile in tiles(grid):
        tile.of(owners)[:] += 1
        assert sizes[number] == np.prod(tile.shape)
    assert (owners == 1).all()
    assert sizes.sum() == grid.vertex_count


@pytest.mark.parametrize("cells", [8, 72, 256, 520])
def test_tiles_mirror_each_other_about_the_middle_line(cells):
    """But for that line itself; and the edges of the hole are among theirs."""
    edges = list(tile_edges(cells))
    middle = len(edges) // 2
    assert edges[middle] == cells // 2
    mirrored = [cells + 1 - edge for edge in reversed(edges)]
    assert mirrored[:middle] + mirrored[middle + 1 :] == edges[:middle] + edges[middle + 1 :]
    assert (edges[middle // 2], edges[3 * middle // 2]) == (cells // 4, 3 * cells // 4 + 1)


@pytest.mark.parametrize("cells", [64, 200, 256, 520, 1000, 2048])
def test_tiles_have_as_many_lines_as_a_blas_likes(cells):
    """A multiple of 8, but for the innermost of each quarter, which has what is left: no less than half a tile."""
    lengths = np.diff(tile_edges(cells))
    quarter = len(lengths) // 4
    common = lengths[0]
    assert common % 8 == 0
    for outwards in (lengths[: 2 * quarter][::-1], lengths[2 * quarter :]):
        for innermost, *others in outwards.reshape(2, quarter):
            assert set(others) <= {common}
            assert common / 2 <= innermost <= 1.5 * common + 1


@pytest.mark.parametrize(
    ("rows", "columns"),
    [((0, 20), (0, 65)), ((16, 20), (0, 17)), ((16, 20), (40, 49)), ((40, 65), (49, 65)), ((20, 21), (10, 60))],
)
def test_a_rectangle_keeps_clear_of_the_hole(rows, columns):
    with pytest.raises(ValueError, match="clear of the hole of level 1"):
        rectangle(64, 1, rows, columns)
    assert rectangle(64, 0, rows, columns).shape == (rows[1] - rows[0], columns[1] - columns[0])


def directed_edges(faces):
    """All edges of all faces in the face's order, (edges, 2) int64."""
    return np.concatenate(
        [np.stack([f, np.roll(f, -1, axis=1)], axis=-1).reshape(-1, 2) for f in (faces.triangles, faces.quads)]
    ).astype(np.int64)


def signed_areas(positions, polygons):
    """Areas by the shoelace formula, positive for counter-clockwise."""
    x, y = positions[polygons][..., 0], positions[polygons][..., 1]
    return 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)


@pytest.mark.parametrize(("cells", "levels"), SHAPES)
def test_every_edge_has_two_faces_except_on_the_outer_square(cells, levels):
    faces = topology(cells, levels)
    edges = directed_edges(faces)
    forward = edges[:, 0] * faces.vertex_count + edges[:, 1]
    backward = edges[:, 1] * faces.vertex_count + edges[:, 0]
    assert len(np.unique(forward)) == len(forward), "two faces run along an edge in the same direction"
    boundary = edges[~np.isin(forward, backward)]
    assert len(boundary) == 4 * cells
    outer = np.abs(flat_positions(cells, levels)[boundary]).max(axis=-1)
    assert (outer == Grid(1.0, cells, levels).half_extent).all()


@pytest.mark.parametrize(("cells", "levels"), SHAPES)
def test_the_surface_is_one_disc(cells, levels):
    """Euler: V - E + F = 1 for a connected disc, and every vertex is in a face."""
    faces = topology(cells, levels)
    edges = directed_edges(faces)
    undirected = np.unique(np.sort(edges, axis=1), axis=0)
    face_count = len(faces.triangles) + len(faces.quads)
    assert faces.vertex_count - len(undirected) + face_count == 1
    assert len(np.unique(edges)) == faces.vertex_count


def snap_offsets(levels):
    """Centres that between them put neighbouring levels at every offset they can have, ties included."""
    reach = 2 ** (levels - 1)
    random = np.random.default_rng(levels)
    return [(0.0, 0.0), (reach / 2, -reach / 2), *random.uniform(-reach, reach, (12, 2))]


@pytest.mark.parametrize(("cells", "levels"), SHAPES)
def test_faces_tile_the_square_once_at_every_snap_offset(cells, levels):
    """All areas positive and their sum that of the square: no gap, no overlap, nothing degenerate.

    Lines are multiples of powers of two, so the areas are exact in float64 and the sum has no rounding.
    """
    faces = topology(cells, levels)
    for centre in snap_offsets(levels):
        positions = flat_positions(cells, levels, centre)
        areas = np.concatenate([signed_areas(positions, faces.triangles), signed_areas(positions, faces.quads)])
        assert areas.min() >= 0.25  # a strip half a cell thick, cut into triangles: no sliver
        assert areas.sum() == (2 * Grid(1.0, cells, levels).half_extent) ** 2


@pytest.mark.parametrize(("cells", "levels"), SHAPES)
def test_no_two_vertices_coincide(cells, levels):
    positions = flat_positions(cells, levels, centre=(3.3, -1.1))
    assert not np.isnan(positions).any()
    assert len(np.unique(positions, axis=0)) == len(positions)


def test_cells_must_allow_a_hole():
    with pytest.raises(OceanError, match="cells is 100, allowed is a multiple of 8"):
        Grid(cells=100)
