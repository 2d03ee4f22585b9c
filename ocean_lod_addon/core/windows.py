# SPDX-License-Identifier: GPL-3.0-or-later
"""How far from the centre of the plane each wave is geometry.

Every wave has one smooth window, a function of position alone: 1 near the centre, 0 beyond the distance where
the mesh stops resolving the wave. It is a product of a window in x and one in y, so that it rides along in the
frame kernel's matrix product, and it knows nothing of levels, so that it is continuous across them.
"""

import numpy as np

from .lod import Grid

FADE_START = 0.5
"""A window begins to fall at this share of its reach. Half the reach is one whole level of the plane."""


def window_reach(grid: Grid, wavelength) -> np.ndarray:
    """Distance from the centre at which a wave has left the geometry, m, for wavelengths in m.

    Just outside a distance d the mesh can be as coarse as h = 4 d / cells (a level begins where the finer one's
    half extent, cells/2 half-spacings, ends). The wave still has `samples_per_wavelength` vertices per
    wavelength there if d <= wavelength cells / (4 samples_per_wavelength).
    """
    return np.asarray(wavelength) * (grid.cells / (4.0 * grid.samples_per_wavelength))


def window_levels(grid: Grid, wavelength) -> np.ndarray:
    """The level whose anchor is the centre of each wave's window, int, for wavelengths in m.

    Windows follow a moving plane in steps of that level's spacing, at most half a cell of the mesh where the wave
    fades: 4/cells of the width over which it does, so that no step shows.
    """
    finest = np.asarray(wavelength) / (2.0 * grid.samples_per_wavelength * grid.cell_size)
    return np.clip(np.floor(np.log2(finest)), 0, grid.levels - 1).astype(int)


def furthest_shift(grid: Grid, level: int, levels_of_windows) -> np.ndarray:
    """How far a level's anchor may be from those that windows are centred on, along one axis, m.

    Each of them (lod.level_anchors) is half a cell of its own level at most from the point that all follow.
    """
    return 0.5 * grid.spacing(level) + 0.5 * grid.cell_size * np.exp2(levels_of_windows)


def nearest_vertex(grid: Grid, level: int) -> float:
    """The least distance from any wave's window centre at which the level owns a vertex, m.

    Centres and anchors differ by half a cell of each, less than a cell of this level where a window matters.
    """
    if level == 0:
        return 0.0
    return grid.lines(level)[3 * grid.cells // 4 + 1] - grid.spacing(level)


def fading_waves(grid: Grid, level: int, wavelength) -> int:
    """How many of a level's waves (lengths in m, sorted), the shortest, have windows that may fall on it below 1,
    wherever it stands."""
    shift = furthest_shift(grid, level, window_levels(grid, wavelength))
    falls = window_reach(grid, wavelength) * FADE_START < grid.lines(level)[-1] + shift
    return int(np.flatnonzero(falls).max(initial=-1)) + 1


def first_wave(grid: Grid, level: int, wavelength) -> int:
    """The first of these waves (lengths in m, sorted) that is not zero everywhere on a level."""
    return int(np.searchsorted(window_reach(grid, wavelength), nearest_vertex(grid, level), side="right"))


def window(distance, reach, fade_start: float = FADE_START) -> np.ndarray:
    """The window at a distance (>= 0, m) along one axis for a wave of this reach (m); they broadcast.

    A quintic step: 1 up to `fade_start` (below 1) times the reach, 0 from reach on, with continuous first and
    second derivatives, so that neither the surface nor its shading shows where a wave fades.
    """
    u = np.clip((reach - distance) / (reach * (1.0 - fade_start)), 0.0, 1.0)
    return u * u * u * (u * (6.0 * u - 15.0) + 10.0)
