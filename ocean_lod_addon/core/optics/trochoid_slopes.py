# SPDX-License-Identifier: GPL-3.0-or-later
"""The slope variance that a sum of trochoids carries (Eq. 26, corrected: THEORY section 8)."""

from typing import NamedTuple

import numpy as np

from ..waves import WaveSet


class SlopeCovariance(NamedTuple):
    """Variances and covariance of the slopes dz/dx and dz/dy, per horizontal area."""

    xx: float
    yy: float
    xy: float


def mean_square_slope(steepness, orbit_ratio=1.0):
    """f_Q(e) = [1 - sqrt(1 - (Q e)^2)]/Q^2 per horizontal area, of waves of steepness e = k A (any shape).

    Written e^2/(1 + sqrt(1 - (Q e)^2)): nothing cancels for small e, and Q = 0 gives e^2/2. A trochoid that
    would loop (Q e > 1) counts as the steepest one that does not, Q e = 1.
    """
    e = np.asarray(steepness) / np.maximum(1.0, np.multiply(orbit_ratio, steepness))
    Qe = np.minimum(orbit_ratio * e, 1.0)  # rounding can take the steepest one past 1, and its root to NaN
    return e * e / (1.0 + np.sqrt((1.0 - Qe) * (1.0 + Qe)))


def mean_square_slope_by_undisturbed_position(steepness):
    """1/sqrt(1 - e^2) - 1, what averaging over undisturbed positions gives instead (infinite at e = 1)."""
    e = np.asarray(steepness)
    root = np.sqrt((1.0 - e) * (1.0 + e))
    with np.errstate(divide="ignore"):  # the mean is infinite for the cusped wave, e = 1
        return e * e / (root * (1.0 + root))


def mean_square_slope_linear(steepness):
    """e^2/2, the mean square slope of a sinusoid, to which every form tends for small e."""
    return 0.5 * np.square(steepness)


def residual_mean_square_slope(steepness, weight, orbit_ratio=1.0):
    """f(e) - f(w e): what is left to the BRDF of a wave drawn with weight w in [0, 1]; conserves variance."""
    return mean_square_slope(steepness, orbit_ratio) - mean_square_slope(
        np.multiply(weight, steepness), orbit_ratio
    )


def slope_covariance(waves: WaveSet, weight=0.0) -> SlopeCovariance:
    """The slope variance of a sea in world axes (Eq. 26) that is left when wave i is drawn with weight_i.

    sigma_x^2 = sum k_x^2/k^2 [f(e) - f(w e)], and so on. `weight` broadcasts to (..., waves); the result has
    the leading shape. Weight 0 gives the whole sea.
    """
    f = residual_mean_square_slope(waves.wavenumber * waves.amplitude, weight, waves.orbit_ratio)
    x, y = np.cos(waves.direction), np.sin(waves.direction)
    return SlopeCovariance((f * x * x).sum(-1), (f * y * y).sum(-1), (f * x * y).sum(-1))
