# SPDX-License-Identifier: GPL-3.0-or-later
"""Budgets tried out: what is chosen for a time, and the time that its frames then take."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core.cost.budget import Choice, choose
from ...core.cost.model import CostModel
from ...core.cost.quality import apply, ladder
from ...core.lod import Grid
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from . import frames

BUDGETS = (5e-3, 20e-3, 100e-3)
"""s"""

FRAMES = 50
LIMIT = 0.10
"""The median may exceed the budget by this share."""

SIZED = frames.settings_of(Sea(), Grid(), Ripples())
"""The ocean of the Add menu: what budgets and qualities are shown on."""


@dataclass(frozen=True)
class BudgetResult:
    """A budget, the choice that it led to and the median time of its frames, s."""

    choice: Choice
    measured: float

    @property
    def over(self) -> float:
        """Measured time over the budget, less 1."""
        return self.measured / self.choice.budget - 1.0

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "budget_ms": 1e3 * self.choice.budget,
            "choice": self.choice.explain(),
            "predicted_ms": 1e3 * self.choice.seconds,
            "median_ms": 1e3 * self.measured,
            "over": self.over,
        }


def choose_for(model: CostModel, budget: float) -> Choice:
    """What `budget` s buys for the ocean of the Add menu."""
    rungs = ladder(SIZED.grid)
    return choose(rungs, lambda rung: model.predict(frames.work(apply(rung.quality, SIZED))), budget)


def try_budget(find: Callable[[], CostModel], budget: float, attempts: int, with_blender: bool) -> BudgetResult:
    """Find prices by `find`, choose for a budget and time the frames; of some attempts the middle one counts."""
    results = [_try_choice(choose_for(find(), budget), with_blender) for _ in range(attempts)]
    return sorted(results, key=lambda result: result.over)[attempts // 2]


def _try_choice(choice, with_blender):
    with frames.later_frames(apply(choice.rung.quality, SIZED), with_blender) as run:
        return BudgetResult(choice, float(np.median(frames.times(run, FRAMES, seconds=0.0))))
