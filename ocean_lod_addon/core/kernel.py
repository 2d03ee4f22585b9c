# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame kernel: a whole sea surface as matrix products that write straight into the vertex buffer.

On a tensor-product grid of lines x_a, y_b the phase of a wave separates,

    exp(i (kx x_a + ky y_b + phi(t))) = exp(i (kx x_a + phi(t))) exp(i ky y_b),

so the corrected Eq. 2 of the paper, summed over waves i, is for each tile of the plane one real product

    L[a, :]      = [ Re P_ai, Im P_ai, ...,  x_a, 1 ]     P_ai  = A_i exp(i (kx_i x_a + phi_i(t))) w_i(x_a)
    R[:, (b, c)] = [ Re Q_cib, -Im Q_cib, ..., base ]     Q_cib = weight_ci exp(i ky_i y_b) w_i(y_b)
    positions    = L @ R

with weights i C cos(theta), i C sin(theta), 1 for x, y, z (C the orbit ratio) and the window w_i of each wave.
R never changes with time; per frame only L is formed, a vector of phases times a static matrix. Phases are
formed in float64 on line coordinates and reduced modulo 2 pi before they are rounded, so that precision does
not depend on where or when. Waves are sorted from short to long: a tile far out drops the short ones, whose
windows are zero there, by taking the tail of the inner dimension.
"""

from dataclasses import dataclass

import numpy as np

from .contraction import CONTRACTIONS, Product, fastest_contraction
from .lod import Grid, tiles
from .waves import WaveSet
from .windows import window, window_reach

_BASE_COLUMNS = 2  # x_a and 1, the undisturbed plane; last, so that the small terms are summed first


@dataclass(frozen=True, eq=False)
class _Level:
    """One level's factors. `first_wave` is the first (shortest) of the sorted waves present in it."""

    first_wave: int
    static_left: np.ndarray  # exp(i kx x_a) w(x_a), (lines, waves) complex64
    left: np.ndarray  # L, (lines, 2 waves + 2) float32, refilled each frame
    right: np.ndarray  # R, (2 waves + 2, 3 lines) float32


class FrameKernel:
    """Positions of a plane's vertices at any time, for one grid and one set of waves.

    Building it costs some tens of milliseconds; `evaluate` is the fast part. It holds no state of earlier
    frames: `left` above is scratch memory.
    """

    def __init__(self, grid: Grid, waves: WaveSet, contraction: str | None = None):
        """`contraction` is one of contraction.CONTRACTIONS, or None for the fastest here."""
        order = np.argsort(waves.wavelength, kind="stable")
        reach = window_reach(grid, waves.wavelength[order])
        self._waves = waves
        self._multiply = CONTRACTIONS[contraction or fastest_contraction()]
        self._order = order
        self._levels = [_build_level(grid, level, waves, order, reach) for level in range(grid.levels)]
        self._tiles = tiles(grid.cells, grid.levels)
        self._first_waves = [_first_wave_of_tile(grid, tile, reach) for tile in self._tiles]

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return self._tiles[-1].vertices.stop

    def evaluate(self, time: float, out: np.ndarray) -> None:
        """Write the positions at `time` (s) into `out`, (vertex_count, 3) float32, C-contiguous, in m."""
        self.fill_left(time)
        self._multiply(self.products(out))

    def fill_left(self, time: float) -> None:
        """Form the left factors of all levels at `time`: one complex multiplication per line and wave."""
        phasor = self._waves.amplitude * np.exp(1j * self._waves.phase_at(time))
        phasor = phasor[self._order].astype(np.complex64)
        for level in self._levels:
            as_complex = level.left.view(np.complex64)[:, :-1]
            np.multiply(level.static_left, phasor[level.first_wave :], out=as_complex)

    def products(self, out: np.ndarray) -> list[Product]:
        """The matrix products of one frame, tile by tile, into `out`, (vertex_count, 3) float32."""
        result = []
        for tile, first_wave in zip(self._tiles, self._first_waves, strict=True):
            level = self._levels[tile.level]
            inner = slice(2 * (first_wave - level.first_wave), None)
            result.append(
                Product(
                    level.left[tile.row_start : tile.row_stop, inner],
                    level.right[inner, 3 * tile.column_start : 3 * tile.column_stop],
                    out[tile.vertices].reshape(tile.rows, 3 * tile.columns),
                )
            )
        return result


def _build_level(grid, level, waves, order, reach):
    lines = grid.lines(level)
    nearest = 0.0 if level == 0 else grid.lines(level)[3 * grid.cells // 4 + 1]
    first_wave = int(np.searchsorted(reach, nearest, side="right"))
    present = order[first_wave:]
    window_on_lines = window(np.abs(lines)[:, None], reach[None, first_wave:])
    theta, k = waves.direction[present], waves.wavenumber[present]

    static_left = window_on_lines * np.exp(1j * np.outer(lines, k * np.cos(theta)))
    left = np.empty((len(lines), 2 * len(present) + _BASE_COLUMNS), np.float32)
    left[:, -2], left[:, -1] = lines, 1.0

    q = (window_on_lines * np.exp(1j * np.outer(lines, k * np.sin(theta)))).T  # (waves, lines)
    orbit = waves.orbit_ratio[present]
    weights = np.stack([1j * orbit * np.cos(theta), 1j * orbit * np.sin(theta), np.ones(len(present))], axis=-1)
    right = np.zeros((2 * len(present) + _BASE_COLUMNS, len(lines), 3), np.float32)
    weighted = q[:, :, None] * weights[:, None, :]
    right[:-2:2], right[1:-2:2] = weighted.real, -weighted.imag
    right[-2, :, 0] = 1.0  # X = x_a + ...
    right[-1, :, 1] = lines  # Y = y_b + ...
    return _Level(first_wave, static_left.astype(np.complex64), left, right.reshape(len(right), -1))


def _first_wave_of_tile(grid, tile, reach):
    """The shortest wave whose window is not zero everywhere on the tile."""
    distance = np.abs(grid.lines(tile.level))
    nearest = max(
        distance[tile.row_start : tile.row_stop].min(), distance[tile.column_start : tile.column_stop].min()
    )
    return int(np.searchsorted(reach, nearest, side="right"))
