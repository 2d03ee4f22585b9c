# SPDX-License-Identifier: GPL-3.0-or-later
"""How rough the wind makes the sea, and slope variances in the wind's axes."""

import math

import numpy as np

from .optics.cox_munk import SLOPE_VARIANCE_FLOOR, slope_variance_across, slope_variance_along
from .sea import Sea, WaveSystem
from .wind import COX_MUNK_HEIGHT, wind_at_height


def roughening_system(sea: Sea) -> int | None:
    """Index of the wave system whose wind roughens the surface: the strongest wind, None if no system is enabled.

    Systems sized by their wind come first; the wind of a system sized by its height counts if there is no other.
    """
    enabled = [index for index, system in enumerate(sea.systems) if system.enabled]
    wind_seas = [index for index in enabled if sea.systems[index].sized_by == "wind"]
    return max(wind_seas or enabled, key=lambda index: sea.systems[index].wind_speed, default=None)


def cox_munk_along_across(system: WaveSystem) -> tuple[float, float]:
    """Slope variances along and across the system's wind, Eqs. 9 and 10; a mirror without wind."""
    if system.wind_speed == 0.0:
        return SLOPE_VARIANCE_FLOOR, SLOPE_VARIANCE_FLOOR
    U = wind_at_height(system.wind_speed, COX_MUNK_HEIGHT)
    return slope_variance_along(U), slope_variance_across(U)


def tensor_of_axes(along: float, across: float, direction: float) -> np.ndarray:
    """Slope variances (xx, yy, xy) in world axes of variances along and across a direction in rad."""
    c, s = math.cos(direction), math.sin(direction)
    return np.array([along * c * c + across * s * s, along * s * s + across * c * c, (along - across) * c * s])


def along_across(tensor, direction: float) -> tuple[float, float]:
    """Slope variances along and across a direction in rad of a tensor (xx, yy, xy)."""
    xx, yy, xy = tensor
    c, s = math.cos(direction), math.sin(direction)
    mixed = 2.0 * c * s * xy
    return c * c * xx + s * s * yy + mixed, s * s * xx + c * c * yy - mixed
