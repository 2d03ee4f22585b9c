# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of float32 in shaders: inputs at which a formula cancels, divides by nothing or overflows.

What NumPy computes in float32 is what the nodes compute: tests/nodes/test_formulas_as_nodes.py.
"""

import numpy as np

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import beckmann
from ocean_lod_addon.core.optics.principal_slopes import principal_slopes
from ocean_lod_addon.core.optics.reflected_share import reflected_share
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes
from ocean_lod_addon.core.optics.smith import slope_spread
from tests.hard_cases.catalogue import FLOAT32_ROUNDING, hard_case

OPS, OPS32 = NumpyOps(), NumpyOps(np.float32)


def naive_axis(xx, yy, xy):
    """The eigenvector (xy, lambda - xx), normalised."""
    radius = np.sqrt((np.float32(0.5) * (xx - yy)) ** 2 + xy * xy)
    x, y = xy, np.float32(0.5) * (xx + yy) + radius - xx
    length = np.sqrt(x * x + y * y)
    return x / length, y / length


@hard_case(
    title="equal slope variances along and across: every direction is an axis",
    truth="the axis is a unit vector",
    naive="the eigenvector (xy, lambda - xx), normalised",
    error="length of the axis, less 1",
    bound=8 * FLOAT32_ROUNDING,
    because="two squares, a sum, a root and quotients",
)
def test_an_isotropic_sea_has_an_axis():
    xx = yy = np.float32([0.0, 1.4e-6, 0.02, 0.3])
    xy = np.zeros(4, np.float32)
    with np.errstate(invalid="ignore"):
        lengths = [np.hypot(*axis) for axis in (naive_axis(xx, yy, xy), principal_slopes(OPS32, xx, yy, xy)[2:])]
    return tuple(float(np.abs(length - 1.0).max()) for length in lengths)


@hard_case(
    title="slope variances with next to no covariance",
    truth="the axis in float64",
    naive="the eigenvector (xy, lambda - xx), normalised",
    error="sine of the angle between them",
    bound=16 * FLOAT32_ROUNDING,
    because="the sum that does not cancel is taken: ten operations",
)
def test_an_almost_aligned_axis():
    random = np.random.default_rng(7)
    xx = random.uniform(0.02, 0.03, 10_000).astype(np.float32)
    yy, xy = np.float32(0.5) * xx, (1e-6 * random.uniform(-1.0, 1.0, 10_000)).astype(np.float32)
    x, y = principal_slopes(OPS, *(np.float64(values) for values in (xx, yy, xy)))[2:]
    with np.errstate(invalid="ignore"):
        axes = naive_axis(xx, yy, xy), principal_slopes(OPS32, xx, yy, xy)[2:]
        sines = [axis[0] * y - axis[1] * x for axis in axes]
    return tuple(float(np.abs(sine).max()) for sine in sines)


@hard_case(
    title="closure sockets of a calm, and of absurd variances",
    truth="roughness and anisotropy are between 0 and 1",
    naive="anisotropy 1 - sqrt(minor / major)",
    error="values outside or no number, share",
    bound=0.0,
    because="variances are held between 2.5e-7 and 0.5",
)
def test_closure_sockets_at_their_ends():
    values = np.float32([0.0, 1e-30, 1e-12, 1.4e-6, 0.05, 0.5, 3.0, 1e30])
    x, y = (grid.ravel() for grid in np.meshgrid(values, values))
    with np.errstate(invalid="ignore"):
        naive = 1.0 - np.sqrt(np.minimum(x, y) / np.maximum(x, y))
    ours = np.array(beckmann.metallic_sockets(OPS32, x, y)[:2])
    return tuple(float((~((part >= 0.0) & (part <= 1.0 + 1e-6))).mean()) for part in (naive, ours))


@hard_case(
    title="the sky's reflection at exact grazing, at the zenith and in a mirror",
    truth="between 0 and 1",
    naive="cot theta / sigma",
    error="reflected shares outside or no number, share",
    bound=0.0,
    because="the slope spread is kept above 0, the effective cosine within 0 and 1",
)
def test_the_reflected_share_at_its_ends():
    cosines, sigmas = np.float32([0.0, 1e-30, 1e-6, 0.5, 1.0 - 2.0**-24, 1.0]), np.float32([0.0, 1e-6, 0.1, 0.7])
    c, sigma = (grid.ravel() for grid in np.meshgrid(cosines, sigmas))
    s = slope_spread(OPS32, np.sqrt(np.float32(1.0) - c * c), np.float32(0.0), sigma, sigma)
    ours = reflected_share(OPS32, c, s, np.float32(WATER_REFRACTIVE_INDEX))
    with np.errstate(all="ignore"):
        naive = c / np.sqrt(1 - c * c) / sigma
    return tuple(float((~((part >= 0.0) & (part <= 1.0))).mean()) for part in (naive, ours))


@hard_case(
    title="facets far out in the tail: exp underflows where 1 / h_z^4 is large",
    truth="no light",
    naive="exp of each axis, over h_z^4",
    error="values that are no number or infinite, share",
    bound=0.0,
    because="h_z is held at 1e-6, so (1 + slope^2)^2 < 2e25 fits float32",
)
def test_the_far_tail():
    h_z = np.float32([0.0, 1e-20, 1e-10, 1e-6, 1e-3])
    with np.errstate(all="ignore"):
        naive = np.exp(-np.float32(1.0) / (h_z * np.float32(0.1)) ** 2) / h_z**4
    tilt = np.float32(1.0) / np.maximum(h_z, np.float32(1e-6))
    slopes = GaussianSlopes(np.float32(0.1), np.float32(0.1))
    with np.errstate(under="ignore"):
        secant2 = 1.0 + tilt * tilt
        ours = slopes.density(OPS32, tilt, np.float32(0.0)) * secant2 * secant2
    return tuple(float((~np.isfinite(values)).mean()) for values in (naive, ours))
