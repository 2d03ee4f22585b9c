# SPDX-License-Identifier: GPL-3.0-or-later
"""Prices that stay true on a machine that is not always equally fast.

A processor that grows warm or is shared with others changes its pace within seconds. What a prediction is worth
shows only while the machine is as fast as it was when the prices were found: so a yardstick is timed before and
after each measurement. Where the pace has changed before it, the prices are found anew; where it has changed
meanwhile, the measurement is made again.
"""

import time
from collections.abc import Callable

import numpy as np

from ...core.cost.model import CostModel

_STEADY = 0.08
"""The pace may change by this share."""

_ATTEMPTS = 3
"""After so many the last measurement stands, disturbed or not."""

_SIDE, _STEPS, _RUNS = 384, 20_000, 15


class _Yardstick:
    """Always the same work: arithmetic, memory that caches do not hold, and Python."""

    def __init__(self):
        generator = np.random.Generator(np.random.PCG64(0))
        self._left, self._right = (generator.random((_SIDE, _SIDE), np.float32) for _ in range(2))
        self._out = np.empty_like(self._left)
        self._long = generator.random(1 << 21, np.float32)
        self._squares = np.empty_like(self._long)

    def seconds(self) -> float:
        """What it takes now, a third of the way from the fastest run to the slowest."""
        taken = []
        for _ in range(_RUNS):
            start = time.perf_counter()
            np.matmul(self._left, self._right, out=self._out)
            np.multiply(self._long, self._long, out=self._squares)
            sum(number * number for number in range(_STEPS))
            taken.append(time.perf_counter() - start)
        return sorted(taken)[_RUNS // 3]


class SteadyPrices:
    """The prices of a machine at its present pace, found by `find`."""

    def __init__(self, find: Callable[[], CostModel]):
        self._find, self._yardstick = find, _Yardstick()
        self._refresh()

    def while_steady(self, measure: Callable[[CostModel], object]):
        """What `measure`(prices) returns, while the machine keeps the pace that the prices were found at."""
        for _ in range(_ATTEMPTS):
            if not self._is_steady():
                self._refresh()
            result = measure(self.model)
            if self._is_steady():
                break
        return result

    def _refresh(self):
        start = time.perf_counter()
        self.model = self._find()
        self.seconds_to_find = time.perf_counter() - start
        self._pace = self._yardstick.seconds()

    def _is_steady(self):
        return abs(self._yardstick.seconds() / self._pace - 1.0) <= _STEADY
