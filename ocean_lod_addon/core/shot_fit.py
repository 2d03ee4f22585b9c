# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane and the ripples that suit a shot: fine enough for the nearest water in frame, wide enough for the
horizon."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .camera_view import CameraView, nearest_visible_water
from .constants import EARTH_RADIUS
from .discretise import discretise
from .errors import OceanError
from .lod import CELLS_STEP, Grid
from .parameters import parameters_of
from .ripple_settings import Ripples
from .sea import Sea
from .waves import TWO_PI, WaveSet

_MOST_CELLS, _FEWEST_CELLS = 1024, 64
_MOST_LEVELS = 20
_SMALLEST_CELL = 0.002  # m; shorter waves are ripples
_LEAST_REACH = 5e3  # m, so that an edge close by never shows from a low camera
_HIDDEN_BEYOND = 1.2  # reach of the plane over the distance at which the highest crest sinks below the horizon

PIXELS_PER_CELL = 7.0
"""Of the command line's own shots: a good picture at bearable cost."""

HIGHEST_WAVE = 20.0  # m
"""Of the command line's own shots: the plane reaches past the horizon of such a crest."""


@dataclass(frozen=True)
class ShotNeeds:
    """What one frame asks of the plane.

    nearest        distance from the lens to the nearest water in frame, m
    pixel_angle    angle between two pixels at the middle of the frame, rad
    height         of the lens above the mean water level, m
    """

    nearest: float
    pixel_angle: float
    height: float


def frame_needs(view: CameraView, resolution_x: int) -> ShotNeeds:
    """What a camera asks of the plane in one frame rendered `resolution_x` pixels wide."""
    left, right, _, _ = view.extent
    height = abs(float(view.position[2]))
    ahead = float(np.hypot(*(nearest_visible_water(view) - view.position[:2])))
    distance = max(math.hypot(ahead, height), _SMALLEST_CELL)
    if view.kind == "ORTHO":
        return ShotNeeds(distance, (right - left) / resolution_x / distance, height)
    if view.kind == "PANO":
        return ShotNeeds(distance, 2.0 * math.pi / resolution_x, height)
    return ShotNeeds(distance, (right - left) / resolution_x, height)


def horizon_distance(height: float) -> float:
    """Distance to the sea horizon from a height, both in m: sqrt(2 R h)."""
    return math.sqrt(2.0 * EARTH_RADIUS * height)


def fit(grid: Grid, needs: list[ShotNeeds], pixels_per_cell: float, highest_wave: float) -> Grid:
    """The grid for a whole shot: `grid` with another cell size, cell count and number of levels.

    The cell size is `pixels_per_cell` pixels at the nearest water of any frame. Further out cells grow with
    distance to at most 4 / cells of it, which sets the number of cells; it is limited, as a long lens would ask
    for millions. The levels reach past the horizon of the highest crest. Raises OceanError for an empty shot.
    """
    if not needs:
        raise OceanError("the shot has no frames with a camera")
    finest = min(need.nearest * need.pixel_angle for need in needs) * pixels_per_cell
    cell_size = min(max(finest, _SMALLEST_CELL), 1e3)
    widest_angle = max(need.pixel_angle for need in needs)
    wanted = 4.0 / (pixels_per_cell * widest_angle)
    cells = CELLS_STEP * round(min(max(wanted, _FEWEST_CELLS), _MOST_CELLS) / CELLS_STEP)
    camera = max(need.height for need in needs)
    reach = max(_HIDDEN_BEYOND * (horizon_distance(camera) + horizon_distance(highest_wave)), _LEAST_REACH)
    levels = 1 + math.ceil(math.log2(reach / (0.5 * cells * cell_size)))
    return replace(grid, cell_size=cell_size, cells=cells, levels=min(max(levels, 1), _MOST_LEVELS))


_RIPPLE_PIXELS = 2.0
"""Of a shorter wave a pixel shows less than a third of the slope variance, and the BRDF the rest."""

_HEIGHTS = 4.0
"""Where the mesh is too coarse for a wave longer than this many heights of the lens, a pixel covers more water
than the wave, for it looks at a grazing angle."""

_RESOLVED_WAVES = 8.0
"""From straight above nothing is foreshortened: ripples then also show the waves that the mesh shows in the middle
of the frame and not at its edges, three octaves at most."""


def fit_ripples(ripples: Ripples, needs: list[ShotNeeds], shortest_resolved: float, waves: WaveSet) -> Ripples:
    """The ripples for a whole shot: `ripples` with another shortest and longest wavelength.

    `shortest_resolved` is the shortest wave, m, of the plane that `fit` made; no ripples are longer than the
    longest of `waves`, the sea's. Raises OceanError for an empty shot.
    """
    if not needs:
        raise OceanError("the shot has no frames with a camera")
    pixel = min(need.nearest * need.pixel_angle for need in needs)
    limits = parameters_of(Ripples)
    shortest = _within(limits["shortest_wavelength"], _RIPPLE_PIXELS * pixel)
    longest = max(_HEIGHTS * max(need.height for need in needs), _RESOLVED_WAVES * shortest_resolved)
    if len(waves):
        longest = min(longest, TWO_PI / float(waves.wavenumber.min()))
    longest = _within(limits["longest_wavelength"], max(longest, 4.0 * shortest))
    return replace(ripples, shortest_wavelength=shortest, longest_wavelength=longest)


def _within(parameter, value: float) -> float:
    return min(max(value, parameter.minimum), parameter.maximum)


class FirstFit(NamedTuple):
    """What suits a shot that nobody has sized anything for yet; `waves` are the sea's on this plane."""

    grid: Grid
    ripples: Ripples
    waves: WaveSet


def first_fit(sea: Sea, needs: ShotNeeds) -> FirstFit:
    """The plane and the ripples for one frame, from their defaults."""
    grid = fit(Grid(), [needs], PIXELS_PER_CELL, HIGHEST_WAVE)
    waves = discretise(sea, grid.shortest_wavelength)
    return FirstFit(grid, fit_ripples(Ripples(), [needs], grid.shortest_wavelength, waves), waves)


CURVATURE_PIXELS = 2.0
"""The Earth's curvature shows where it moves the horizon by this many pixels."""


def curvature_pixels(need: ShotNeeds, reach: float) -> float:
    """By how many pixels the Earth's curvature moves the horizon.

    A flat plane's edge at the distance `reach` (m) lies h / reach below the horizontal, the true horizon
    sqrt(2 h / R).
    """
    return (math.sqrt(2.0 * need.height / EARTH_RADIUS) - need.height / reach) / need.pixel_angle


def curvature_shows(needs: list[ShotNeeds], reach: float) -> bool:
    """Whether the Earth's curvature shows in some frame of the shot."""
    return any(curvature_pixels(need, reach) >= CURVATURE_PIXELS for need in needs)
