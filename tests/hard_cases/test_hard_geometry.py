# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of the mesh: folds, smallest rings, ties of the lattice, points on the borders of levels."""

import bpy
import numpy as np

from ocean_lod_addon.core.camera_view import CameraView, plane_centre
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.lod import Grid, level_anchors, topology, undisturbed_positions
from ocean_lod_addon.core.sea import Sea
from ocean_lod_addon.core.windows import window, window_reach
from tests.hard_cases.catalogue import FLOAT64_ROUNDING, hard_case

SMALLEST = Grid(cell_size=0.5, cells=8, levels=4)
"""Rings of one cell: a level is 8 cells wide and its hole 4, with a strip of triangles around the hole."""


def flat_areas(grid, anchors):
    """Areas of all faces in still water, m^2."""
    faces, points = topology(grid.cells, grid.levels), undisturbed_positions(grid, anchors)
    areas = []
    for polygons in (faces.triangles, faces.quads):
        x, y = points[polygons][..., 0], points[polygons][..., 1]
        areas.append(0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1))
    return np.concatenate(areas)


@hard_case(
    title="rings of one cell, the camera on every tie of the lattice",
    truth="the faces tile the square: none is turned over, none is empty",
    naive="levels that follow the camera without a lattice, strips of fixed width",
    error="smallest area below a quarter cell, in cells, or area lost, m^2",
    bound=0.0,
    because="lattice coordinates are multiples of powers of two: exact",
)
def test_smallest_rings_at_lattice_ties():
    worst = lost = 0.0
    naive = 0.0
    for x in np.arange(-2.0, 2.01, 0.25):
        anchors = level_anchors(SMALLEST, (x, -x))
        areas = flat_areas(SMALLEST, anchors) / SMALLEST.cell_size**2
        worst = max(worst, 0.25 - areas.min())
        lost = max(lost, abs(areas.sum() * SMALLEST.cell_size**2 - (2.0 * SMALLEST.half_extent) ** 2))
        free = np.array([[(-1.0) ** level * x, x] for level in range(SMALLEST.levels)])
        naive = max(naive, 0.25 - flat_areas(SMALLEST, free).min() / SMALLEST.cell_size**2)
    return float(naive), float(max(worst, lost))


@hard_case(
    title="a camera exactly above a vertex, and half way between two",
    truth="the plane is where the camera is, to half a cell of each level",
    naive="rounding down",
    error="distance beyond half a cell, in cells",
    bound=0.0,
    because="powers of two: exact",
)
def test_a_camera_at_a_vertex():
    naive = ours = 0.0
    for x in (0.0, 0.5, 0.25, -0.25, 1.5, 4.0 - 2.0**-40):
        view = CameraView(np.array([x, x, 0.0]), np.diag([1.0, -1.0, -1.0]), (-1.0, 1.0, -1.0, 1.0))
        centre = plane_centre(SMALLEST, view)
        for level, anchor in enumerate(level_anchors(SMALLEST, centre)):
            cell = SMALLEST.spacing(level)
            ours = max(ours, np.abs(anchor - x).max() / cell - 0.5)
            naive = max(naive, abs(np.floor(x / cell) * cell - x) / cell - 0.5)
    return float(naive), float(max(ours, 0.0))


@hard_case(
    title="points exactly on the borders of levels",
    truth="a wave is as high on the finer side of a border as on the coarser",
    naive="each level shows the waves that its own cells resolve",
    error="step in height over the significant height",
    bound=8 * FLOAT64_ROUNDING,
    because="windows know positions, not levels: the same number twice",
)
def test_borders_of_levels():
    grid = Grid(cell_size=0.25, cells=64, levels=6)
    waves = discretise(Sea(), grid.shortest_wavelength)
    reach = window_reach(grid, waves.wavelength)
    height = 4.0 * np.sqrt(0.5 * np.sum(waves.amplitude**2))
    naive = ours = 0.0
    for level in range(1, grid.levels):
        border = grid.lines(level)[3 * grid.cells // 4]
        resolved = grid.samples_per_wavelength * grid.spacing(level)
        fine, coarse = (waves.wavelength > length for length in (0.5 * resolved, resolved))
        naive = max(naive, np.sum(waves.amplitude[fine & ~coarse]) / height)
        sides = [np.sum(waves.amplitude * window(x, reach)) for x in (border, np.nextafter(border, np.inf))]
        ours = max(ours, abs(sides[1] - sides[0]) / height)
    return float(naive), float(ours)


@hard_case(
    title="zero-area cells at folds (choppiness 2 in a storm)",
    truth="a mesh normal exists on every face",
    naive="the cross product over its length",
    error="normals that are no number, share",
    bound=0.0,
    because="Blender gives an empty face an upward normal; positions are finite",
)
def test_cells_without_area():
    mesh = bpy.data.meshes.new("Folded")
    corners = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 1], [0, 0, 1], [1, 0, 0], [1, 0, 1]], np.float32)
    mesh.from_pydata(corners.tolist(), [], [(0, 1, 2, 3), (1, 4, 5, 2)])
    mesh.update()
    ours = np.array([polygon.normal[:] for polygon in mesh.polygons])
    bpy.data.meshes.remove(mesh)
    cross = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    with np.errstate(invalid="ignore"):
        naive = cross / np.linalg.norm(cross)
    return float(np.isnan(naive).any()), float((~(np.abs(np.linalg.norm(ours, axis=1) - 1.0) < 1e-6)).mean())
