# SPDX-License-Identifier: GPL-3.0-or-later
"""How much slope variance the sea has, and how much of it each vertex leaves to the shading.

The wind sea has what Cox and Munk measured at its wind, whatever waves were chosen to stand for it, but no less
than its spectrum carries (in a light wind, a spectrum may be steeper than the mean of their measurements); every
other wave system has what its waves carry. What the geometry shows at a vertex is taken off. What is added to the
waves' own tensor is never negative along any direction, and so is what is left of the sum.
"""

import numpy as np

from .errors import OceanError
from .lod import Grid, parts
from .optics.cox_munk import SLOPE_VARIANCE_FLOOR
from .optics.trochoid_slopes import mean_square_slope
from .ripples.spectrum import wind_ripples
from .roughness import along_across, roughening_system, tensor_of_axes
from .sea import Sea
from .waves import WaveSet
from .windows import window, window_reach


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
    system, own = sea.systems[rough], waves.system == rough
    tensors = wave_tensors(waves)
    own_tensor = tensors[own].sum(axis=0)
    carried = along_across(own_tensor, system.direction)
    along, across = np.maximum(np.subtract(wind_ripples(sea, rough).total, carried), 0.0)
    return own_tensor + tensor_of_axes(along, across, system.direction) + tensors[~own].sum(axis=0)


def resolved_sums(grid: Grid, waves: WaveSet, values: np.ndarray) -> np.ndarray:
    """sum_i values_i w_i^2 at every vertex, with the window w_i of each wave: (vertices, n) float32.

    `values` is (waves, n). For the many small waves of a sea f(e) - f(w e) is f(e) (1 - w^2) (THEORY section 8),
    so a wave's slope variance is shown in this proportion. w_i^2 separates in x and y like the frame kernel, so
    this is a matrix product for each part of a level, static in time.
    """
    reach = window_reach(grid, waves.wavelength)
    result = np.empty((grid.vertex_count, values.shape[1]), np.float32)
    for level in range(grid.levels):
        squared = np.square(window(np.abs(grid.lines(level))[:, None], reach))  # (lines, waves)
        present = squared.any(axis=0)
        left = squared[:, present].astype(np.float32)
        right = (squared[:, present].T[:, :, None] * values[present][:, None, :]).astype(np.float32)
        for part in parts(grid.cells, level):
            part.of(result)[:] = np.tensordot(left[part.rows], right[:, part.columns], axes=1)
    return result


def unresolved_slope_variance(sea: Sea, grid: Grid, waves: WaveSet) -> np.ndarray:
    """Slope variance (xx, yy, xy) that the geometry does not show, (vertices, 3) float32."""
    total = total_slope_variance(sea, waves)
    result = np.float32(total) - resolved_sums(grid, waves, wave_tensors(waves))
    if not np.isfinite(result).all():
        raise OceanError("the slope variance of this sea is not finite")
    return result
