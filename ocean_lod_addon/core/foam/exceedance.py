# SPDX-License-Identifier: GPL-3.0-or-later
"""How likely it is that a Gaussian process exceeds given thresholds at one or more of several instants."""

import numpy as np

from ..optics.erf import erfc

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)

NEVER = 9.0
"""Deviations that a Gaussian value never exceeds: once in 10^19."""

_CORRELATION_LIMIT = 1.0 - 1e-9
"""Keeps the exponent of the double integral finite where two instants are the same."""


def below(threshold) -> np.ndarray:
    """Probability of a standard normal value below a threshold, any shape."""
    return 0.5 * erfc(-np.asarray(threshold) / np.sqrt(2.0))


def both_below(first, second, correlation: float) -> np.ndarray:
    """Probability that two standard normal values are below their thresholds, (n,) each.

    d/d rho of it is the density at the thresholds (Plackett 1954), so with rho = sin(a)
    P = Phi(h) Phi(k) + 1/(2 pi) int_0^asin(rho) exp(-(h^2 - 2 h k sin a + k^2) / (2 cos^2 a)) da.
    """
    limit = np.arcsin(np.clip(correlation, -_CORRELATION_LIMIT, _CORRELATION_LIMIT))
    a = 0.5 * limit * (_NODES + 1.0)
    h, k = np.minimum(first, NEVER)[:, None], np.minimum(second, NEVER)[:, None]
    density = np.exp(-(h * h - 2.0 * h * k * np.sin(a) + k * k) / (2.0 * np.cos(a) ** 2))
    return below(h[:, 0]) * below(k[:, 0]) + 0.5 * limit * (density @ _WEIGHTS) / (2.0 * np.pi)


def some_above(thresholds: np.ndarray, correlations: np.ndarray) -> np.ndarray:
    """Probability, (n,), that a standard normal process exceeds thresholds (n, instants) at one or more instants.

    `correlations` (instants - 1,) are those of each instant with the next. Given one instant the process is taken
    to have forgotten the ones before (a Markov chain): of a sea's waves that is right within a seventh.
    """
    staying_below = below(thresholds[:, 0])
    for before, now, correlation in zip(thresholds.T[:-1], thresholds.T[1:], correlations, strict=True):
        staying_below = staying_below * both_below(before, now, correlation) / below(np.minimum(before, NEVER))
    return 1.0 - staying_below
