# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions drawn from a spreading law that is cut off beyond an angle from its mean direction."""

import numpy as np

from .table import Spreading

_LARGEST_STEPS = 60
_CONVERGED = 1e-15

_SMALLEST_DENSITY = np.finfo(np.float64).tiny
"""1/rad; a law that is flatter, as far behind the wind as subnormal numbers, would make a step of infinity."""


def mean_cos2(spreading: Spreading, omega, cutoff: float) -> np.ndarray:
    """<cos^2 theta> at omega in rad/s over the directions with |theta| <= cutoff in rad."""
    return spreading.cos2_integral(omega, cutoff) / share_within(spreading, omega, cutoff)


def share_within(spreading: Spreading, omega, cutoff: float) -> np.ndarray:
    """Share of the energy at omega in rad/s that has |theta| <= cutoff in rad."""
    return 2.0 * spreading.cumulative(omega, cutoff) - 1.0


def direction_at_share(spreading: Spreading, omega, share, cutoff: float = np.pi) -> np.ndarray:
    """The angle from the mean direction, rad, up to which the given share (0 to 1) of the energy lies.

    Inverts the cumulative law of each pair (omega, share) by Newton's rule inside a shrinking bracket; each pair
    is independent of the others to the last bit.
    """
    omega, share = np.broadcast_arrays(np.asarray(omega, dtype=np.float64), np.asarray(share, dtype=np.float64))
    side = np.where(share < 0.5, -1.0, 1.0)
    target = 0.5 + np.abs(share - 0.5) * share_within(spreading, omega, cutoff)
    low, high = np.zeros(omega.shape), np.full(omega.shape, float(cutoff))
    theta = 0.5 * (low + high)
    running = np.ones(omega.shape, dtype=bool)
    for _ in range(_LARGEST_STEPS):
        excess = spreading.cumulative(omega, theta) - target
        low, high = np.where(excess < 0.0, theta, low), np.where(excess < 0.0, high, theta)
        density = spreading.density(omega, theta)
        steep = density > _SMALLEST_DENSITY
        newton = theta - np.where(steep, excess, 0.0) / np.where(steep, density, 1.0)
        inside = steep & (newton > low) & (newton < high)
        following = np.where(running, np.where(inside, newton, 0.5 * (low + high)), theta)
        running = running & (np.abs(following - theta) > _CONVERGED)
        theta = following
        if not running.any():
            break
    return side * theta
