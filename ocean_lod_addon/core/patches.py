# SPDX-License-Identifier: GPL-3.0-or-later
"""Which rectangles of the plane a frame evaluates, each with as many waves as reach it: one matrix product each.

Tiles in view are put together: a rectangle takes a row of them from the first to the last, and goes on to the next
row as long as that costs less than another product, by what is multiplied though it is not in view, or has fewer
waves than it is given.
"""

from typing import NamedTuple

import numpy as np

from .contraction import CallCost
from .lod import Grid, tile_edges, tile_sizes
from .windows import nearest_vertex, window_reach


class Patch(NamedTuple):
    """A rectangle of tiles of one level, by their numbers along the axes, and how many waves it takes, the
    longest.

    On a plane that is folded about its middle line the columns are counted from there on, and `own` and `image`
    say which of the two halves are wanted.
    """

    level: int
    row_start: int
    row_stop: int
    column_start: int
    column_stop: int
    wave_count: int
    own: bool = True
    image: bool = False


def wave_counts(grid: Grid, wavelength) -> np.ndarray:
    """How many of these waves (lengths in m) have windows that are not zero everywhere on a tile: for each."""
    edges, middle = np.array(tile_edges(grid.cells)), grid.cells // 2
    lines_off = np.maximum(np.maximum(edges[:-1] - middle, middle - (edges[1:] - 1)), 0)
    lines_off = np.maximum.outer(lines_off, lines_off)
    reach, counts = np.sort(window_reach(grid, wavelength)), []
    for level in range(grid.levels):
        nearest = np.maximum((lines_off - 1) * grid.spacing(level), nearest_vertex(grid, level))
        counts.append(len(reach) - np.searchsorted(reach, nearest, side="right"))
    return np.where(tile_sizes(grid.cells, grid.levels) > 0, counts, 0)


def lines_in_view(cells: int, visible: np.ndarray) -> list[slice]:
    """For each level its lines from the first to the last row of tiles that has visible ones (a flag for each)."""
    edges, rows = tile_edges(cells), visible.any(axis=2)
    first, past = rows.argmax(axis=1), rows.shape[1] - rows[:, ::-1].argmax(axis=1)
    ends = zip(rows.any(axis=1).tolist(), first.tolist(), past.tolist(), strict=True)
    return [slice(edges[start], edges[stop]) if some else slice(0, 0) for some, start, stop in ends]


class Patches:
    """What puts the tiles of one plane together, with the waves that reach each."""

    def __init__(self, grid: Grid, wavelength, call: CallCost, folded: bool = False):
        """`folded` puts together tiles of the upper half of the plane, each with its mirror image."""
        edges = tile_edges(grid.cells)
        self._tiles, self._call, self._folded = len(edges) - 1, call, folded
        first = self._tiles // 2 if folded else 0
        self._middle = self._tiles // 2, self._tiles // 2 - first
        self._counts = wave_counts(grid, wavelength)[:, :, first:]
        self._wave_count = len(wavelength)
        self._heights, self._column_edges = np.diff(edges), np.array(edges[first:])
        self._lists = self._counts.tolist(), edges, edges[first:]
        self._past_hole = np.zeros((grid.levels, self._tiles, self._tiles), bool)
        self._past_hole[1:, self._tiles // 4 : 3 * self._tiles // 4, 3 * self._tiles // 4 :] = True

    def of(self, visible: np.ndarray, wave_limit: int | None = None) -> list[Patch]:
        """The patches that cover the visible tiles (a flag for each), with so many waves at most."""
        most = self._wave_count if wave_limit is None else wave_limit
        if not self._folded:
            past_hole = visible & self._past_hole
            return self._merged(visible & ~past_hole, most) + self._merged(past_hole, most)
        own, image = self._halves(visible)
        return [
            patch._replace(own=bool(_within(own, patch).any()), image=bool(_within(image, patch).any()))
            for patch in self._merged(own | image, most)
        ]

    def covered(self, patches: list[Patch]) -> np.ndarray:
        """The tiles in these patches, a flag for each."""
        flags = np.zeros(self._past_hole.shape, bool)
        own, image = self._halves(flags) if self._folded else (flags, None)
        for patch in patches:
            if patch.own:
                _within(own, patch)[:] = True
            if patch.image:
                _within(image, patch)[:] = True
        return flags

    def _halves(self, flags):
        """The tiles of the upper half, and their mirror images in the same order."""
        middle = self._tiles // 2
        return flags[:, :, middle:], flags[:, :, middle - 1 :: -1]

    def _merged(self, flags, most) -> list[Patch]:
        """Patches of visible tiles that in each row lie on one side of the hole.

        In plain numbers, as this is done anew whenever the view has changed.
        """
        if not flags.any():
            return []
        counts, row_edges, column_edges = self._lists
        middle_row, middle_column = self._middle
        hole_edges, (rows_of_call, terms_of_call) = _hole_rows(self._tiles), self._call
        result = []
        at, bottom, top, first, past, count, cost = -1, 0, 0, 0, 0, 0, 0  # the patch that grows
        for level, row, start, stop, waves, cost_of_row in self._rows_in_view(flags, most):
            if level == at and row == top and not (level and row in hole_edges):
                low, high = min(first, start), max(past, stop)
                nearest = counts[level][min(max(middle_row, bottom), row)]
                most_there = min(nearest[min(max(middle_column, low), high - 1)], most)
                rows = row_edges[row + 1] - row_edges[bottom] + rows_of_call
                grown = rows * (column_edges[high] - column_edges[low]) * (2 * most_there + 2)
                if grown <= cost + cost_of_row + terms_of_call:
                    top, first, past, count, cost = row + 1, low, high, most_there, grown
                    continue
            if top:
                result.append(Patch(at, bottom, top, first, past, count))
            at, bottom, top, first, past, count, cost = level, row, row + 1, start, stop, waves, cost_of_row
        result.append(Patch(at, bottom, top, first, past, count))
        return result

    def _rows_in_view(self, flags, most):
        """Of rows with visible tiles: level, row, first, past the last, waves and cost of a product of each.

        The waves of a row are those of its tile next to the middle of the plane, where most waves are.
        """
        some = flags.any(axis=2)
        level, row = np.nonzero(some)
        first, past = flags.argmax(axis=2)[some], flags.shape[2] - flags[:, :, ::-1].argmax(axis=2)[some]
        waves = np.minimum(self._counts[level, row, np.clip(self._middle[1], first, past - 1)], most)
        lines = self._column_edges[past] - self._column_edges[first]
        cost = (self._heights[row] + self._call.rows) * lines * (2 * waves + 2)
        numbers = level, row, first, past, waves, cost
        return zip(*(each.tolist() for each in numbers), strict=True)


def _hole_rows(tiles: int) -> tuple[int, int]:
    """Of so many rows of tiles, where a level's hole begins and ends: the vertex buffer has a new stride there."""
    return tiles // 4, 3 * tiles // 4


def _within(flags, patch):
    return flags[patch.level, patch.row_start : patch.row_stop, patch.column_start : patch.column_stop]


def exact_patches(flags: np.ndarray) -> list[Patch]:
    """Patches without waves that cover just these tiles, a flag for each, and nothing else."""
    levels, rows, columns = flags.shape
    hole_rows = _hole_rows(rows)
    spaced = np.zeros(levels * rows * (columns + 1) + 1, bool)  # a gap before each row and at the end
    spaced[:-1].reshape(-1, columns + 1)[:, 1:] = flags.reshape(-1, columns)
    starts, stops = np.flatnonzero(spaced[1:] != spaced[:-1]).reshape(-1, 2).T
    row, first = np.divmod(starts, columns + 1)
    numbers = row // rows, row % rows, first, first + stops - starts
    result, growing = [], {}
    for level, row, first, past in zip(*(each.tolist() for each in numbers), strict=True):
        below = growing.get((level, first, past))
        if below is not None and below.row_stop == row and not (level and row in hole_rows):
            growing[level, first, past] = below._replace(row_stop=row + 1)
            continue
        if below is not None:
            result.append(below)
        growing[level, first, past] = Patch(level, row, row + 1, first, past, 0)
    return result + list(growing.values())
