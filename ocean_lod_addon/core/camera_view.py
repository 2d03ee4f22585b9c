# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera sees of the sea: where the water nearest to it is, and which tiles are in its frame.

All coordinates are the ocean's own: metres, z up, the mean water level at z = 0.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np

from .carried import RIM, Carried
from .lod import Grid, tile_sides, tile_sizes


@dataclass(frozen=True, eq=False)
class CameraView:
    """A camera for one frame.

    position   (3,) m
    axes       (3, 3): rows are the camera's right, up and forward directions, unit vectors
    extent     (left, right, bottom, top) of the frame: tangents of angles from the forward axis, or for an
               orthographic camera metres from it
    kind       "PERSP", "ORTHO" or "PANO"; a panoramic camera sees in all directions
    """

    position: np.ndarray
    axes: np.ndarray
    extent: tuple[float, float, float, float]
    kind: str = "PERSP"


def frame_planes(view: CameraView, margin: float = 0.0) -> np.ndarray:
    """The planes that bound what a camera sees, (planes, 4): n . x + d >= 0 inside, n a unit vector.

    `margin` in rad widens a perspective frame on each side, up to a half space; an orthographic frame grows by
    tan(margin) of its own size. A panoramic camera has no planes.
    """
    right, up, forward = view.axes
    left_edge, right_edge, bottom_edge, top_edge = view.extent
    if view.kind == "PANO":
        return np.empty((0, 4))
    if view.kind == "ORTHO":
        grown = 0.5 * np.tan(min(margin, _WIDEST_HALF_ANGLE))
        extra_x, extra_y = grown * (right_edge - left_edge), grown * (top_edge - bottom_edge)
        sides = [(right, left_edge - extra_x), (-right, -right_edge - extra_x)]
        sides += [(up, bottom_edge - extra_y), (-up, -top_edge - extra_y)]
        return np.array([[*n, -n @ view.position - offset] for n, offset in sides])
    angles = np.minimum(np.arctan([-left_edge, right_edge, -bottom_edge, top_edge]) + margin, np.pi / 2)
    inwards = [right, -right, up, -up]
    normals = [np.cos(a) * n + np.sin(a) * forward for a, n in zip(angles, inwards, strict=True)]
    normals.append(forward)  # nothing behind the camera: boxes that straddle its axis there pass the other four
    return np.array([[*n, -n @ view.position] for n in normals])


_WIDEST_HALF_ANGLE = 1.5
"""rad; tan() of a margin beyond this is as good as infinite."""


def visible_tiles(
    grid: Grid, anchors: np.ndarray, planes: np.ndarray, carried: Carried, curved_radius: float = np.inf
) -> np.ndarray:
    """Which tiles can be seen, a flag for each: boxes around them that are not wholly outside some plane.

    A vertex stays around its undisturbed place moved by `carried.shift`, within an ellipsoid of the half axes
    `carried.highest` up and down and `carried.orbit_ratio` times that sideways. With a finite `curved_radius` (m)
    the sea sinks with distance. A box is a product of sides in x and in y: what they add to n . x + d adds up.
    """
    n, offset, tiles = planes[:, :3], planes[:, 3], tile_sizes(grid.cells, grid.levels)
    ellipsoid = np.hypot(carried.orbit_ratio * np.hypot(n[:, 0], n[:, 1]), n[:, 2])
    at_level = n[:, :2] @ anchors.T + offset[:, None] + np.outer(ellipsoid, carried.highest)  # (planes, levels)
    n = n.astype(np.float32)  # from here on places count from the anchors
    sides = np.stack([n[:, :2], np.abs(n[:, :2])], axis=2) @ _sides(grid)
    x, y = sides.reshape(len(n), 2, *tiles.shape[:2]).swapaxes(0, 1)  # each (planes, levels, tiles)
    if np.isfinite(curved_radius):
        off = anchors - anchors[0]
        centres, halves = _sides(grid).reshape(2, *tiles.shape[:2])
        upside = np.maximum(-n[:, 2], 0.0)[:, None, None] / (2.0 * curved_radius)
        x += upside * (np.abs(centres + off[:, :1]) + halves) ** 2
        y += upside * (np.abs(centres + off[:, 1:]) + halves) ** 2
    x += at_level[:, :, None]
    inwards = x[:, :, :, None] + y[:, :, None, :]
    shift = carried.shift
    inwards[:, : len(shift)] += (n @ shift.reshape(-1, 3).T).reshape(len(n), *shift.shape[:-1])
    return (inwards >= 0.0).all(axis=0) & (tiles > 0)


def looks_down(view: CameraView, margin: float, highest: float) -> bool:
    """Whether a camera may see water: a quick test for the whole sea, before that of its tiles.

    From above the highest crest (m) only rays that sink meet the sea, and if any ray of a perspective frame sinks,
    one through a corner does. `margin` in rad widens the frame. Other cameras may always see water.
    """
    if view.kind != "PERSP" or view.position[2] <= highest:
        return True
    outwards = np.array([-1.0, 1.0, -1.0, 1.0])
    angles = np.minimum(outwards * np.arctan(view.extent) + margin, _WIDEST_HALF_ANGLE)
    tangents = outwards * np.tan(angles)
    corners = [(x, y, 1.0) @ view.axes for x in tangents[:2] for y in tangents[2:]]
    return any(corner[2] < 0.0 for corner in corners)


@functools.lru_cache(maxsize=8)
def _sides(grid):
    """Along either axis, of tiles with the cells that join them to others: the middles, from the level's anchor,
    and half the lengths, (2, levels x tiles) float32, m."""
    middles, halves = tile_sides(grid.cells)
    spacing = grid.cell_size * np.exp2(np.arange(grid.levels))
    sides = np.stack([np.outer(spacing, middles), np.outer(spacing, halves + RIM)])
    return sides.reshape(2, -1).astype(np.float32)


def nearest_visible_water(view: CameraView) -> np.ndarray:
    """The point (x, y) of the mean water level, among what the camera sees, that is nearest to below the camera.

    Below the camera itself if that is in the frame, if the camera is under water or if it sees no water at all.
    """
    below = view.position[:2].astype(np.float64)
    if view.position[2] <= 0.0 or _sees_below(view):
        return below
    ahead = _border_on_water(view)
    return below + min(ahead, key=lambda point: math.hypot(*point), default=(0.0, 0.0))


def _sees_below(view):
    """Whether the point of the mean water level below a camera that is above it is in its frame."""
    if view.kind == "PANO":
        return True
    x, y, forward = (-view.position[2] * view.axes[:, 2]).tolist()
    if view.kind == "PERSP" and forward < 0.0:
        return False
    distance = forward if view.kind == "PERSP" else 1.0
    left, right, bottom, top = (edge * distance for edge in view.extent)
    return left <= x <= right and bottom <= y <= top


_GRAZING = 1e-6
"""Rays that sink less than this never reach the water."""

_EDGE = [number / 8.0 for number in range(9)]
_BORDER = sorted({place for share in _EDGE for end in (0.0, 1.0) for place in ((share, end), (end, share))})
"""Places along the four edges of the frame, as shares of its width and height."""


def _border_on_water(view):
    """Where rays through the border of the frame meet the mean water level: (x, y) m from below the camera.

    In plain numbers: this is done in every frame, and there are few.
    """
    left, right, bottom, top = view.extent
    (across_x, across_y, across_z), (up_x, up_y, up_z), (x, y, z) = view.axes.tolist()
    height, parallel = float(view.position[2]), view.kind == "ORTHO"
    result = []
    for share_across, share_up in _BORDER:
        u, v = left + share_across * (right - left), bottom + share_up * (top - bottom)
        aside_x, aside_y, aside_z = u * across_x + v * up_x, u * across_y + v * up_y, u * across_z + v * up_z
        if parallel and z < -_GRAZING:
            distance = (height + aside_z) / -z
            result.append((aside_x + distance * x, aside_y + distance * y))
        elif not parallel and aside_z + z < -_GRAZING:
            distance = height / -(aside_z + z)
            result.append((distance * (aside_x + x), distance * (aside_y + y)))
    return result


def plane_centre(grid: Grid, view: CameraView) -> np.ndarray:
    """Where to centre the plane's levels for a camera, (x, y) in m.

    Below the camera, but moved ahead when the nearest water in frame lies beyond the finest level, as with a long
    lens: the fine cells are then where they are seen.
    """
    below = view.position[:2].astype(np.float64)
    ahead = nearest_visible_water(view) - below
    distance = math.hypot(*ahead)
    finest_level = 0.5 * grid.spacing(0) * grid.cells / 2
    if distance <= finest_level:
        return below
    return below + ahead * (1.0 - finest_level / distance)
