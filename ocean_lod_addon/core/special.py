# SPDX-License-Identifier: GPL-3.0-or-later
"""Special functions that NumPy does not have."""

import numpy as np

EULER_GAMMA = 0.57721566490153286061

_SERIES_LIMIT = 2.0
_SERIES_TERMS = 40
_FRACTION_TERMS = 120


def exponential_integral_e1(x) -> np.ndarray:
    """E1(x) = int_x^inf e^-t / t dt for x > 0, any shape; 0 where it underflows.

    Abramowitz and Stegun 5.1.11 (series, x < 2) and 5.1.22 (continued fraction, beyond).
    """
    x = np.asarray(x, dtype=np.float64)
    small, large = np.minimum(x, _SERIES_LIMIT), np.maximum(x, _SERIES_LIMIT)
    term, total = -np.ones_like(small), np.zeros_like(small)
    for n in range(1, _SERIES_TERMS):
        term = -term * small / n
        total = total + term / n
    series = -EULER_GAMMA - np.log(small) + total
    fraction = large + 2.0 * _FRACTION_TERMS + 1.0
    for n in range(_FRACTION_TERMS, 0, -1):
        fraction = large + 2.0 * n - 1.0 - n * n / fraction
    return np.where(x < _SERIES_LIMIT, series, np.exp(-large) / fraction)
