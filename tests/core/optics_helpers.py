# SPDX-License-Identifier: GPL-3.0-or-later
"""What several tests of optics share."""

import numpy as np

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import cox_munk
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes
from ocean_lod_addon.core.optics.smith import masked_area_exact

OPS = NumpyOps()
WATER = 1.333

SEAS = {
    "smooth": (1e-4, 1e-4),
    "10 m/s": (0.0316, 0.0222),
    "20 m/s": (0.0632, 0.0414),
    "rough": (0.25, 0.1),
    "crosswind 3:1": (0.005, 0.045),
}
"""Slope variances along and across the wind."""


def direction(theta, phi):
    """The unit vector at angle theta from z and phi from x."""
    return np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)


def exact_slopes(variance_x, variance_y):
    """Gaussian slopes with Smith's masking to float64."""
    return GaussianSlopes(np.sqrt(variance_x), np.sqrt(variance_y), masked_area_exact)


def cox_munk_sigmas(U):
    """Slope deviations along and across a wind of U m/s."""
    return np.sqrt(cox_munk.slope_variance_along(U)), np.sqrt(cox_munk.slope_variance_across(U))


def random_directions(rng, count, grazing=False):
    """Unit vectors (x, y, z) with z >= 0, uniform in z or (grazing) in its logarithm down to 1e-6.

    One in fifty lies exactly on the horizon and one exactly at the zenith.
    """
    z = 10.0 ** rng.uniform(-6.0, 0.0, count) if grazing else rng.uniform(0.0, 1.0, count)
    z[::50], z[1::50] = 0.0, 1.0
    phi = rng.uniform(-np.pi, np.pi, count)
    r = np.sqrt(1.0 - z * z)
    return r * np.cos(phi), r * np.sin(phi), z


def mirrored(view, tilt_x, tilt_y):
    """The directions to which facets of the given tilts mirror `view`."""
    f = np.stack(np.broadcast_arrays(tilt_x, tilt_y, 1.0)) / np.sqrt(1.0 + tilt_x**2 + tilt_y**2)
    twice = 2.0 * (view[0] * f[0] + view[1] * f[1] + view[2] * f[2])
    return tuple(twice * f[axis] - view[axis] for axis in range(3))
