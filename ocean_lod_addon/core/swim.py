# SPDX-License-Identifier: GPL-3.0-or-later
"""How much the sea moves only because the plane does.

With the sea's clock stopped, the height of the mesh at a point fixed in the world should not change while the
camera travels. It is compared with the exact sum of the waves that the local windows keep, so that what remains
is the mesh's doing: interpolation between vertices whose lattice would slide if it were not anchored.
"""

import math
from dataclasses import dataclass

import numpy as np

from .camera_view import CameraView
from .lod import Grid, parts
from .ocean import Surface
from .windows import window, window_levels, window_reach

_HALF_WIDTH = 18.0 / 35.0
"""Tangent of half the horizontal view of a 35 mm lens on a 36 mm wide sensor."""


@dataclass(frozen=True)
class SwimReport:
    """All errors over the significant wave height.

    interpolation_rms   what straight edges between vertices miss of the waves; constant in time
    swim_rms, swim_max  how much that changes at a fixed point while the camera moves
    """

    frames: int
    points: int
    significant_wave_height: float
    interpolation_rms: float
    swim_rms: float
    swim_max: float


def dolly_and_pan(frames: int, height: float = 3.0, speed: float = 0.05, pan: float = math.pi / 2):
    """Camera views of a dolly along x at `speed` m per frame that pans by `pan` rad, `height` m over the water."""
    for frame in range(frames):
        heading = pan * frame / max(frames - 1, 1)
        forward = np.array([math.cos(heading), math.sin(heading), 0.0])
        right = np.array([math.sin(heading), -math.cos(heading), 0.0])
        position = np.array([speed * frame, 0.0, height])
        extent = (-_HALF_WIDTH, _HALF_WIDTH, -_HALF_WIDTH * 9 / 16, _HALF_WIDTH * 9 / 16)
        yield CameraView(position, np.stack([right, np.array([0.0, 0.0, 1.0]), forward]), extent)


def measure(surface: Surface, views, x, y, time: float = 0.0) -> SwimReport:
    """Measure the swim at undisturbed points x, y (m) while the camera takes `views`, at one sea time (s).

    A point counts in the frames where it lies in a cell whose four vertices are on one level.
    """
    positions = np.empty((surface.vertex_count, 3), np.float32)
    errors = []
    for view in views:
        placement = surface.placement(view)
        surface.positions(time, placement, positions)
        drawn = heights_of_mesh(surface.ocean.grid, placement.anchors, positions[:, 2], x, y)
        errors.append(drawn - windowed_heights(surface, placement.anchors, time, x, y))
    errors = np.ma.masked_invalid(errors)
    change = errors - errors.mean(axis=0)
    significant = 4.0 * math.sqrt(0.5 * float(np.sum(surface.waves.amplitude**2)))
    return SwimReport(
        len(errors),
        len(x),
        significant,
        float(np.sqrt((errors**2).mean())) / significant,
        float(np.sqrt((change**2).mean())) / significant,
        float(np.abs(change).max()) / significant,
    )


def windowed_heights(surface: Surface, anchors: np.ndarray, time: float, x, y) -> np.ndarray:
    """Z of Eq. 2 at undisturbed points, each wave times its window, in float64, m."""
    waves, grid = surface.waves, surface.ocean.grid
    reach = window_reach(grid, waves.wavelength)
    centre_x, centre_y = anchors[window_levels(grid, waves.wavelength)].T
    weight = window(np.abs(x[:, None] - centre_x), reach) * window(np.abs(y[:, None] - centre_y), reach)
    along = np.outer(x, np.cos(waves.direction)) + np.outer(y, np.sin(waves.direction))
    psi = waves.wavenumber * along + waves.phase_at(time)
    return (waves.amplitude * weight * np.cos(psi)).sum(axis=-1)


def heights_of_mesh(grid: Grid, anchors: np.ndarray, z: np.ndarray, x, y) -> np.ndarray:
    """Height of the drawn surface at undisturbed points, bilinear in the finest cell there, m.

    NaN where the cell joins two levels, and outside the plane.
    """
    side, z = grid.cells + 1, np.ascontiguousarray(z)
    lattices = np.full((grid.levels, side, side), np.nan)
    for level, lattice in enumerate(lattices):
        for part in parts(grid.cells, level):
            lattice[part.rows, part.columns] = part.of(z)
    heights = np.full(len(x), np.nan)
    for level in reversed(range(grid.levels)):
        u = (x - anchors[level, 0]) / grid.spacing(level) + grid.cells // 2
        v = (y - anchors[level, 1]) / grid.spacing(level) + grid.cells // 2
        inside = (u >= 0) & (v >= 0) & (u < grid.cells) & (v < grid.cells)
        heights[inside] = _bilinear(lattices[level], u[inside], v[inside])
    return heights


def _bilinear(values, u, v):
    i, j = u.astype(int), v.astype(int)
    s, t = u - i, v - j
    low = values[i, j] * (1 - s) + values[i + 1, j] * s
    high = values[i, j + 1] * (1 - s) + values[i + 1, j + 1] * s
    return low * (1 - t) + high * t
