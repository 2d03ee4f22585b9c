# SPDX-License-Identifier: GPL-3.0-or-later
"""How strongly water must be compressed to become foam, so that as much of the sea is white as the wind asks for.

Foam at a place is  F = max_j e_j clip((c_j - c*) / s, 0, 1), with c_j the compression of the same water at the
age tau_j in deviations, and e_j = exp(-tau_j / T) its decay. All c_j are sums of many waves, thus Gaussian, so the
mean of F is an integral over the probability that some c_j exceeds c* + s f / e_j. The threshold c* is where that
mean is what was asked for. A Gaussian value exceeds a high threshold c by 1 / c on average; the ramp s is a little
less, so that most crests that break are white.
"""

from dataclasses import dataclass

import numpy as np

from ..foam_settings import Foam
from ..waves import WaveSet
from .exceedance import NEVER, some_above

_SPAN = 2.5
"""The oldest foam that is looked for, in decay times: 8 % of it is left."""

_CROWDING = 1.4
"""Power by which instants crowd towards the present."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_SHARES, _SHARE_WEIGHTS = 0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS

_THRESHOLDS = np.linspace(-4.0, 7.0, 89)
"""In deviations; the logarithm of the mean foam is nearly a parabola of them, 0.2 % from its chords."""

_LEAST_FOAM = 1e-30
"""Keeps that logarithm finite."""


@dataclass(frozen=True, eq=False)
class Memory:
    """The instants that foam is looked for at: their `ages` from 0 on in s, and the `decay` e_j of foam since."""

    ages: np.ndarray
    decay: np.ndarray


def memory_of(settings: Foam) -> Memory:
    """Steps over a few decay times, the shorter the fresher the foam: there gaps between them would show most."""
    numbers = np.arange(settings.memory_steps) / settings.memory_steps
    ages = _SPAN * settings.decay_time * numbers**_CROWDING
    return Memory(ages, np.exp(-ages / settings.decay_time))


@dataclass(frozen=True, eq=False)
class Statistics:
    """Of the compression c = sum b A cos(psi) of waves.

    deviation     of c
    correlations  (instants - 1,) of c at each instant and the next
    shift         (instants,) covariance of c at each with the present Jacobian's 1 - J, over the deviation of c
    """

    deviation: float
    correlations: np.ndarray
    shift: np.ndarray


def statistics_of(breaking: np.ndarray, waves: WaveSet, memory: Memory) -> Statistics:
    """For the waves' weights b (waves,) in rad/m, of which one or more are not 0."""
    b, jacobian = breaking * waves.amplitude, waves.orbit_ratio * waves.wavenumber * waves.amplitude
    variance = 0.5 * float(np.sum(b**2))
    since = np.cos(np.outer(memory.ages, waves.angular_frequency))
    between = np.cos(np.outer(np.diff(memory.ages), waves.angular_frequency))
    return Statistics(
        variance**0.5,
        0.5 * (between @ b**2) / variance,
        0.5 * (since @ (b * jacobian)) / variance**0.5,
    )


def ramp_of(threshold) -> np.ndarray:
    """s: deviations over which water turns from bare to white."""
    return 1.0 / (1.0 + np.maximum(threshold, 0.0))


def mean_foam(thresholds: np.ndarray, memory: Memory, statistics: Statistics) -> np.ndarray:
    """Mean of F over horizontal area for each threshold c* in deviations.

    Area counts by J = 1 - c', to first order exp(-c'), and a Gaussian mean weighted by that is the plain mean with
    every c_j lowered by its covariance with c'.
    """
    thresholds = np.asarray(thresholds, dtype=np.float64)[:, None, None]
    reached = _SHARES[:, None] / memory.decay
    levels = np.where(reached <= 1.0, thresholds + ramp_of(thresholds) * reached, NEVER) + statistics.shift
    likely = some_above(levels.reshape(-1, len(memory.ages)), statistics.correlations)
    return likely.reshape(len(thresholds), -1) @ _SHARE_WEIGHTS


def threshold_for(coverage: float, memory: Memory, statistics: Statistics) -> float:
    """c* in deviations for which the mean foam is `coverage`, above 0 and below 1."""
    foam = np.maximum(mean_foam(_THRESHOLDS, memory, statistics), _LEAST_FOAM)
    return float(np.interp(-np.log(coverage), -np.log(foam), _THRESHOLDS))


def breaking_weights(wavenumber: np.ndarray, largest: float) -> np.ndarray:
    """b = k exp(-k^2 / (2 k_b^2)), rad/m: the compression averaged over a patch of the size 1 / k_b of a breaker.

    Without it the shortest waves, which carry most of the slope, would make specks of foam everywhere.
    """
    weights = wavenumber * np.exp(-0.5 * (wavenumber / largest) ** 2)
    return np.where(wavenumber < _CUT * largest, weights, 0.0)


_CUT = 3.0
"""Waves with k > 3 k_b weigh less than 1.1 % and are left out."""


def breaker_wavenumber(peak_wavenumber: float) -> float:
    """k_b in rad/m of a sea with its peak at this wavenumber.

    Air is drawn in by crests about a quarter as fast as the dominant ones or faster (Kleiss and Melville 2010), in
    deep water thus a sixteenth as long.
    """
    return 16.0 * peak_wavenumber
