# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a frame takes: for each stage a sum of the work in it, each kind of work at its own price.

The prices are those of one machine, one NumPy and one Blender; `probe` finds them in about a second.
"""

import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from .work import Work


@dataclass(frozen=True)
class Stage:
    """A part of a frame.

    label   for panels and tables
    counts  the kinds of work in it, in a fixed order
    """

    label: str
    counts: Callable[[Work], tuple[float, ...]]


def _by_cores(count, shared):
    """What one core does, and what all share, which has a price of its own: together they wait for the memory."""
    return (1.0 - shared) * count, shared * count


STAGES: dict[str, Stage] = {
    "setup": Stage("Plan", lambda work: (1.0,)),
    "factors": Stage("Wave factors", lambda work: (work.levels, work.factor_terms)),
    "products": Stage(
        "Wave products", lambda work: (work.multiplications, work.passes, work.floats, work.products)
    ),
    "normals": Stage(
        "Normals", lambda work: (float(work.normals > 0.0), *_by_cores(work.normals, work.normals_shared))
    ),
    "foam_products": Stage(
        "Foam products",
        lambda work: (work.foam_multiplications, work.foam_passes, work.foam_floats, work.foam_products),
    ),
    "foam": Stage(
        "Foam",
        lambda work: (
            float(work.foam_instants > 0.0),
            *_by_cores(work.foam_instants, work.foam_shared),
            work.foam_lines,
        ),
    ),
    "write": Stage("Write mesh", lambda work: (work.vectors, work.vectors * work.vertices)),
    "ripples": Stage("Ripples", lambda work: (work.images, work.texels, work.shared_texels)),
    "blender": Stage(
        "Blender",
        lambda work: (
            1.0,
            work.vertices,
            work.vertices if not work.normals else 0.0,
            float(work.images > 0.0),
        ),
    ),
}
"""The stages of a frame in their order, up to the object that Blender has evaluated."""


@dataclass(frozen=True)
class CostModel:
    """Prices in s of each stage's kinds of work; a stage that was not probed is missing."""

    prices: Mapping[str, tuple[float, ...]]

    def predict(self, work: Work) -> dict[str, float]:
        """Seconds of each probed stage."""
        return {name: float(np.dot(prices, STAGES[name].counts(work))) for name, prices in self.prices.items()}

    def total(self, work: Work) -> float:
        """Seconds of a frame, of the stages that were probed."""
        return sum(self.predict(work).values())


def fit_prices(stage: str, works: list[Work], seconds) -> tuple[float, ...]:
    """The prices of a stage that explain measured seconds best, relative to each; none is negative.

    Least squares on every choice of kinds of work whose prices come out positive: there are few of both.
    """
    counts = np.array([STAGES[stage].counts(work) for work in works])
    seconds = np.asarray(seconds, dtype=float)
    relative = counts / seconds[:, None]
    best, least = np.zeros(counts.shape[1]), np.inf
    for size in range(1, counts.shape[1] + 1):
        for chosen in itertools.combinations(range(counts.shape[1]), size):
            columns = list(chosen)
            scale = np.maximum(np.abs(relative[:, columns]).max(axis=0), TINY)
            solution = np.linalg.lstsq(relative[:, columns] / scale, np.ones(len(seconds)), rcond=None)[0] / scale
            error = float(np.sum((relative[:, columns] @ solution - 1.0) ** 2))
            if (solution >= 0.0).all() and error < least - TINY:
                least, best = error, np.zeros(counts.shape[1])
                best[columns] = solution
    return tuple(map(float, best))


TINY = 1e-12
"""Keeps a column of zeros from being divided by 0, and equal fits from being told apart by rounding."""
