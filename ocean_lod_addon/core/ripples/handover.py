# SPDX-License-Identifier: GPL-3.0-or-later
"""What each vertex of the mesh leaves to the bump: static in time.

The waves of a band that the mesh shows are off the bump: of the band's slope variance B the bump shows the share

    share = 1 - sum_i f_i w_i^2 / trace B        over the mesh's waves i in the band, with their windows w_i.
"""

import numpy as np

from ..lod import Grid
from ..slope_budget import resolved_sums, wave_tensors
from ..waves import TWO_PI, WaveSet
from .layout import Band


def handed_over_count(bands, shortest_resolved: float) -> int:
    """How many of the bands, which come from long to short, have waves that the mesh shows somewhere."""
    return sum(band.longest > shortest_resolved for band in bands)


def members(waves: WaveSet, bands: tuple[Band, ...]) -> np.ndarray:
    """Which of the mesh's waves are in which band, (waves, bands), True or False."""
    k = waves.wavenumber[:, None]
    low = np.array([TWO_PI / band.longest for band in bands])
    high = np.array([TWO_PI / band.shortest for band in bands])
    return (k > low) & (k <= high)


def band_variances(waves: WaveSet, bands: tuple[Band, ...]) -> np.ndarray:
    """Slope variance of each wave, both axes together, in the column of its band: (waves, bands)."""
    return wave_tensors(waves)[:, :2].sum(axis=1, keepdims=True) * members(waves, bands)


def bump_share(resolved, tensors) -> np.ndarray:
    """1 - resolved / trace B, in [0, 1], of what the mesh shows of each band, (..., bands), and B, (bands, 3)."""
    trace = tensors[:, 0] + tensors[:, 1]
    present = trace > 0.0
    return np.clip(1.0 - np.where(present, resolved, 0.0) / np.where(present, trace, 1.0), 0.0, 1.0)


def bump_amplitudes(grid: Grid, waves: WaveSet, bands: tuple[Band, ...], tensors: np.ndarray) -> np.ndarray:
    """Roots of the shares of the bands that the mesh shows in part, (vertices, bands) float32.

    `tensors` (bands, 3) are the slope variances of these bands.
    """
    resolved = resolved_sums(grid, waves, band_variances(waves, bands))
    return np.sqrt(bump_share(resolved, tensors)).astype(np.float32)
