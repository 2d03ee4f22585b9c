# SPDX-License-Identifier: GPL-3.0-or-later
"""Prices that stay true on a machine that is not always equally fast.

A processor that grows warm or is shared with others changes its pace within tenths of a second. What a prediction
is worth shows only while the machine is as fast as it was when the prices were found: so a yardstick is timed
before and after each measurement. What was measured at another pace does not count; where the pace stays another,
the prices are found anew.
"""

import itertools
import time
from collections.abc import Callable

import numpy as np

from ...core.contraction import CONTRACTIONS, Product, fastest_contraction
from ...core.cost.model import CostModel
from ...core.cost.probe import typical

_STEADY = 0.08
"""The pace may change by this share."""

_ATTEMPTS = 3
"""So often prices are found for one measurement; then what was measured counts, disturbed or not."""

_WANTED, _TRIES = 6, 14
"""Turns that count and are enough, and turns that are tried at one pace. Half of those wanted will do."""

_TURN = 0.05
"""s of runs in a turn, at least."""

_SIDE, _STEPS, _RUNS, _GLANCE = 384, 20_000, 15, 3


class _Yardstick:
    """Always the same work: arithmetic on all cores, memory that caches do not hold, and Python."""

    def __init__(self, contraction: str | None):
        generator = np.random.Generator(np.random.PCG64(0))
        left, right = (generator.random((_SIDE, _SIDE), np.float32) for _ in range(2))
        self._multiply = CONTRACTIONS[contraction or fastest_contraction()].multiply
        self._products = [Product(left, right, np.empty_like(left))]
        self._long = generator.random(1 << 21, np.float32)
        self._squares = np.empty_like(self._long)

    def seconds(self, runs: int) -> float:
        """What it takes now, a third of the way from the fastest run to the slowest."""
        taken = []
        for _ in range(runs):
            start = time.perf_counter()
            self._multiply(self._products)
            np.multiply(self._long, self._long, out=self._squares)
            sum(number * number for number in range(_STEPS))
            taken.append(time.perf_counter() - start)
        return typical(taken)


class SteadyPrices:
    """The prices of a machine at its present pace, found by `find`, with a contraction of core.contraction."""

    def __init__(self, find: Callable[[], CostModel], contraction: str | None = None):
        self._find, self._yardstick = find, _Yardstick(contraction)
        self._refresh()

    def while_steady(self, measure: Callable[[CostModel], object]):
        """What `measure`(prices) returns, while the machine keeps the pace that the prices were found at."""
        for _ in range(_ATTEMPTS):
            if not self._is_steady(_RUNS):
                self._refresh()
            result = measure(self.model)
            if self._is_steady(_RUNS):
                break
        return result

    def typical_seconds(self, run: Callable[[], object]) -> float:
        """What `run` takes at the pace that the prices were found at last, reckoned as the probe does it.

        A first run is not counted. Many short turns are tried, and those that were disturbed left out.
        """
        run()
        for _ in range(_ATTEMPTS):
            steady, disturbed = self._turns(run)
            if 2 * len(steady) >= _WANTED:
                break
            self._refresh()
        else:
            steady += disturbed
        return typical(list(itertools.chain.from_iterable(steady)))

    def _turns(self, run):
        """Seconds of each run in turns at the present prices' pace, and in others."""
        steady, disturbed = [], []
        before = self._is_steady(_GLANCE)
        while len(steady) < _WANTED and len(steady) + len(disturbed) < _TRIES:
            taken = _turn(run)
            after = self._is_steady(_GLANCE)
            (steady if before and after else disturbed).append(taken)
            before = after
        return steady, disturbed

    def _refresh(self):
        """Find the prices, again if the pace has changed meanwhile."""
        for _ in range(_ATTEMPTS):
            self._pace = self._yardstick.seconds(_RUNS)
            start = time.perf_counter()
            self.model = self._find()
            self.seconds_to_find = time.perf_counter() - start
            if self._is_steady(_RUNS):
                break

    def _is_steady(self, runs):
        return abs(self._yardstick.seconds(runs) / self._pace - 1.0) <= _STEADY


def _turn(run):
    """Seconds of each run, of as many as fill a turn."""
    taken = []
    while sum(taken) < _TURN:
        start = time.perf_counter()
        run()
        taken.append(time.perf_counter() - start)
    return taken
