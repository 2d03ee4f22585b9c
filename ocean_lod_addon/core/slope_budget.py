# SPDX-License-Identifier: GPL-3.0-or-later
"""How much slope variance the sea has, and how much of it each vertex leaves to the shading.

The wind sea has what Cox and Munk measured at its wind, whatever waves were chosen to stand for it; every other
wave system has what its waves carry. What the geometry shows at a vertex is taken off.
"""

import math

import numpy as np

from .errors import OceanError
from .lod import Grid, tiles
from .optics.cox_munk import SLOPE_VARIANCE_FLOOR, slope_variance_across, slope_variance_along
from .optics.trochoid_slopes import mean_square_slope
from .sea import Sea, WaveSystem
from .waves import WaveSet
from .wind import COX_MUNK_HEIGHT, wind_at_height
from .windows import window, window_reach


def roughening_system(sea: Sea) -> int | None:
    """Index of the wave system whose wind roughens the surface: the strongest wind, None if no system is enabled.

    Systems sized by their wind come first; the wind of a system sized by its height counts if there is no other.
    """
    enabled = [index for index, system in enumerate(sea.systems) if system.enabled]
    wind_seas = [index for index in enabled if sea.systems[index].sized_by == "wind"]
    return max(wind_seas or enabled, key=lambda index: sea.systems[index].wind_speed, default=None)


def cox_munk_tensor(system: WaveSystem) -> np.ndarray:
    """Slope variances (xx, yy, xy) in world axes at the system's wind, Eqs. 9 and 10; a mirror without wind."""
    if system.wind_speed == 0.0:
        along = across = SLOPE_VARIANCE_FLOOR
    else:
        U = wind_at_height(system.wind_speed, COX_MUNK_HEIGHT)
        along, across = slope_variance_along(U), slope_variance_across(U)
    c, s = math.cos(system.direction), math.sin(system.direction)
    return np.array([along * c * c + across * s * s, along * s * s + across * c * c, (along - across) * c * s])


def wave_tensors(waves: WaveSet) -> np.ndarray:
    """Slope variances (xx, yy, xy) that each wave carries, (waves, 3): k_x^2/k^2 f(k A) and so on (Eq. 26)."""
    f = mean_square_slope(waves.wavenumber * waves.amplitude, waves.orbit_ratio)
    x, y = np.cos(waves.direction), np.sin(waves.direction)
    return f[:, None] * np.stack([x * x, y * y, x * y], axis=-1)


def total_slope_variance(sea: Sea, waves: WaveSet) -> np.ndarray:
    """Slope variances (xx, yy, xy) of the whole sea, all lengths of waves together."""
    rough = roughening_system(sea)
    if rough is None:
        return np.array([SLOPE_VARIANCE_FLOOR, SLOPE_VARIANCE_FLOOR, 0.0])
    others = waves.system != rough
    return cox_munk_tensor(sea.systems[rough]) + wave_tensors(waves)[others].sum(axis=0)


def unresolved_slope_variance(sea: Sea, grid: Grid, waves: WaveSet) -> np.ndarray:
    """Slope variance (xx, yy, xy) that the geometry does not show, (vertices, 3) float32.

    total - sum_i f_i w_i^2, with the window w_i of each wave; for the many small waves of a sea f(e) - f(w e)
    is f(e) (1 - w^2) (THEORY section 8). w_i^2 separates in x and y like the frame kernel, so this is one
    matrix product a tile, static in time. Where the waves are steeper than Cox and Munk's total, a variance
    here is negative; the shader floors it (optics.principal_slopes).
    """
    total = total_slope_variance(sea, waves)
    tensors = wave_tensors(waves)
    reach = window_reach(grid, waves.wavelength)
    plane = tiles(grid.cells, grid.levels)
    result = np.empty((plane[-1].vertices.stop, 3), np.float32)
    for level in range(grid.levels):
        squared = np.square(window(np.abs(grid.lines(level))[:, None], reach))  # (lines, waves)
        present = squared.any(axis=0)
        left = squared[:, present].astype(np.float32)
        right = (squared[:, present].T[:, :, None] * tensors[present][:, None, :]).astype(np.float32)
        for tile in plane:
            if tile.level != level:
                continue
            resolved = left[tile.row_start : tile.row_stop] @ right[
                :, tile.column_start : tile.column_stop
            ].reshape(len(right), 3 * tile.columns)
            result[tile.vertices] = total - resolved.reshape(-1, 3)
    if not np.isfinite(result).all():
        raise OceanError("the slope variance of this sea is not finite")
    return result
