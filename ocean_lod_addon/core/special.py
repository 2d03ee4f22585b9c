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


_STIRLING = (1.0 / 12.0, -1.0 / 360.0, 1.0 / 1260.0, -1.0 / 1680.0, 1.0 / 1188.0, -691.0 / 360360.0)
_STIRLING_FROM = 10.0


def log_gamma(x) -> np.ndarray:
    """ln Gamma(x) for x > 0, any shape.

    Stirling's series (Abramowitz and Stegun 6.1.41) beyond 10, the recurrence Gamma(x + 1) = x Gamma(x) before.
    """
    x = np.asarray(x, dtype=np.float64)
    shift, z = np.zeros_like(x), x
    for _ in range(int(_STIRLING_FROM)):
        small = z < _STIRLING_FROM
        shift = shift + np.where(small, np.log(np.where(small, z, 1.0)), 0.0)
        z = np.where(small, z + 1.0, z)
    inverse = 1.0 / z
    series = np.zeros_like(z)
    for coefficient in reversed(_STIRLING):
        series = series * inverse * inverse + coefficient
    return (z - 0.5) * np.log(z) - z + 0.5 * np.log(2.0 * np.pi) + series * inverse - shift


_LENTZ_STEPS = 200
_LENTZ_CONVERGED = 1e-16
_LENTZ_TINY = 1e-300
"""What Lentz's rule puts in place of a denominator that happens to be 0."""


def incomplete_beta(a, b, x) -> np.ndarray:
    """Regularised incomplete beta function I_x(a, b) for a, b > 0 and 0 <= x <= 1, any shapes.

    Abramowitz and Stegun 26.5.8 (continued fraction), on the side of x where it converges fast. Each element is
    independent of the others to the last bit.
    """
    a, b, x = np.broadcast_arrays(*(np.asarray(v, dtype=np.float64) for v in (a, b, x)))
    result = np.array(x)  # already right at 0 and 1
    inside = (x > 0.0) & (x < 1.0)
    result[inside] = _incomplete_beta_inside(a[inside], b[inside], x[inside])
    return result


def _incomplete_beta_inside(a, b, x):
    flip = x > (a + 1.0) / (a + b + 2.0)
    p, q, y = np.where(flip, b, a), np.where(flip, a, b), np.where(flip, 1.0 - x, x)
    log_front = log_gamma(p + q) - log_gamma(p) - log_gamma(q) + p * np.log(y) + q * np.log1p(-y)
    tail = np.exp(log_front) / p * _beta_fraction(p, q, y)
    return np.where(flip, 1.0 - tail, tail)


def _beta_fraction(a, b, x):
    """The continued fraction 1 / (1 + d1 / (1 + d2 / ...)) of 26.5.8 by Lentz's rule; elements stop when done."""
    c = np.ones_like(x)
    d = 1.0 / _away_from_zero(1.0 - (a + b) * x / (a + 1.0))
    value, running = d, np.ones(x.shape, dtype=bool)
    for m in range(1, _LENTZ_STEPS):
        even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0))
        step = np.ones_like(x)
        for numerator in (even, odd):
            d = 1.0 / _away_from_zero(1.0 + numerator * d)
            c = _away_from_zero(1.0 + numerator / c)
            step = step * d * c
        value = np.where(running, value * step, value)
        running = running & (np.abs(step - 1.0) > _LENTZ_CONVERGED)
        if not running.any():
            break
    return value


def _away_from_zero(x):
    return np.where(np.abs(x) < _LENTZ_TINY, _LENTZ_TINY, x)
