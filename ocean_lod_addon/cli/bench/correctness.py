# SPDX-License-Identifier: GPL-3.0-or-later
"""What a frame must get right however fast it is: no swimming, no seams, the same precision everywhere."""

import itertools
from dataclasses import asdict, dataclass

import numpy as np

from ...core.lod import Grid, level_anchors, topology, undisturbed_positions
from ...core.ocean import Ocean, Surface
from ...core.placement import Placement
from ...core.sea import Sea
from ...core.swim import SwimReport, windowed_heights
from ..swim import measure_shot


@dataclass(frozen=True)
class SeamReport:
    """Area between and across levels over that of the plane, at all offsets that levels can have."""

    levels: int
    offsets: int
    gap: float
    overlap: float


def measure_seams(cells: int, levels: int) -> SeamReport:
    """Gaps and overlaps of a plane at every offset between neighbouring levels.

    A level stands up to half of its cell, one cell of the finer one, off the finer one's anchor to each side.
    Faces share their vertices, so what is left to go wrong is their area: a gap is area that no face covers, an
    overlap area of faces that lie the wrong way up, on top of others. Coordinates are small whole numbers, so the
    areas are exact.
    """
    grid = Grid(cell_size=1.0, cells=cells, levels=levels)
    faces = topology(cells, levels)
    offsets = [np.zeros(levels), *_offsets(levels)]
    gap = overlap = 0.0
    square = (2.0 * grid.half_extent) ** 2
    for x, y in itertools.product(offsets, repeat=2):
        points = undisturbed_positions(grid, np.stack([x, y], axis=-1))
        areas = np.concatenate([_signed_areas(points[polygons]) for polygons in (faces.triangles, faces.quads)])
        gap = max(gap, abs(square - areas.sum()) / square)
        overlap = max(overlap, -areas[areas < 0.0].sum() / square)
    return SeamReport(levels, len(offsets) ** 2, gap, overlap)


def _offsets(levels):
    """Anchors along one axis with each level half its cell on one side of the next finer one, or alternating."""
    half_cells = 0.5 * np.exp2(np.arange(levels))
    half_cells[0] = 0.0
    alternating = np.where(np.arange(levels) % 2, half_cells, -half_cells)
    return [np.cumsum(steps) for steps in (half_cells, -half_cells, alternating)]


def _signed_areas(polygons):
    """By the shoelace formula, positive for counter-clockwise, (polygons,) for (polygons, corners, 2)."""
    x, y = polygons[..., 0], polygons[..., 1]
    return 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)


@dataclass(frozen=True)
class PrecisionReport:
    """Largest error of a height against the float64 sum, over the significant wave height."""

    at_origin: float
    far_and_late: float


FAR, LATE = 1e5, 1e6
"""m and s."""


def measure_precision(contraction: str) -> PrecisionReport:
    """Heights of a plane to the horizon at the origin and time 0, and far and late."""
    surface = Surface(Ocean(Sea(), Grid(cell_size=0.1, cells=128, levels=9)), contraction)
    return PrecisionReport(_height_error(surface, 0.0, 0.0), _height_error(surface, FAR, LATE))


def _height_error(surface, x, time):
    positions = np.empty((surface.vertex_count, 3), np.float32)
    anchors = level_anchors(surface.ocean.grid, (x, -x))
    surface.positions(time, Placement(anchors), positions)
    sample = slice(None, None, 37)
    points = surface.undisturbed(anchors)[sample]
    exact = windowed_heights(surface, anchors, time, *points.T)
    significant = 4.0 * np.sqrt(0.5 * np.sum(surface.waves.amplitude**2))
    return float(np.abs(positions[sample, 2] - exact).max() / significant)


@dataclass(frozen=True)
class Correctness:
    """All of it."""

    swim: SwimReport
    seams: SeamReport
    precision: PrecisionReport

    def as_mapping(self) -> dict:
        """For the saved file."""
        return asdict(self)


def measure_correctness(swim_frames: int, swim_grid: Grid, contraction: str) -> Correctness:
    """Swim, seams and precision."""
    return Correctness(
        measure_shot(Surface(Ocean(Sea(), swim_grid), contraction), swim_frames, points=300),
        measure_seams(cells=64, levels=9),
        measure_precision(contraction),
    )
