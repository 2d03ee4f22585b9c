# SPDX-License-Identifier: GPL-3.0-or-later
"""Times of several things, measured in turns, so that what else the machine does slows all of them alike."""

import itertools
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

FRAMES_PER_SECOND = 24.0

_MOST_RUNS, _TURN = 9, 0.1
"""Timed runs of a contestant in one turn, at most, and s that they take together; what is longer is timed once."""

_SETTLED = 0.3
"""s; anything shorter first runs once without being timed. By then the caches are its own, and the threads of a
BLAS that the one before has used no longer wait for more to do, which keeps a core busy for some 20 ms."""

_PATIENCE = 4.0
"""s; a contestant that has used this much sits out the turns that are left."""

_SILENCE = 1.0
"""s between lines that say how far the measurement is."""


@dataclass(frozen=True)
class Contestant:
    """Something to measure: parts that run one after the other, each timed by itself.

    A part is called with the sea's time in s, which goes on by a frame from run to run.
    """

    name: str
    parts: dict[str, Callable[[float], object]]


@dataclass(frozen=True, eq=False)
class Timing:
    """Seconds of each run of one contestant: `samples` (runs, parts), for the `parts` of these names."""

    parts: tuple[str, ...]
    samples: np.ndarray

    def seconds(self, *without: str) -> np.ndarray:
        """Seconds of each run, (runs,), without the parts of these names."""
        kept = [name not in without for name in self.parts]
        return self.samples[:, kept].sum(axis=1)

    def median(self, *without: str) -> float:
        """Median over the runs, s, without the parts of these names."""
        return float(np.median(self.seconds(*without)))

    def minimum(self, *without: str) -> float:
        """The fastest run, s, without the parts of these names."""
        return float(self.seconds(*without).min())

    def part(self, name: str) -> float:
        """Median of one part, s."""
        return float(np.median(self.samples[:, self.parts.index(name)]))

    def as_mapping(self) -> dict:
        """For the saved file, in milliseconds."""
        return {
            "median_ms": 1e3 * self.median(),
            "minimum_ms": 1e3 * self.minimum(),
            "runs": len(self.samples),
            "parts_median_ms": {name: 1e3 * self.part(name) for name in self.parts},
        }


@dataclass(frozen=True)
class Ratio:
    """One time over another: of their medians, and of their fastest runs."""

    of_medians: float
    of_minima: float


def ratio(above: Timing, below: Timing, above_without=(), below_without=()) -> Ratio:
    """How many times longer `above` takes than `below`, each without some of its parts."""
    return Ratio(
        above.median(*above_without) / below.median(*below_without),
        above.minimum(*above_without) / below.minimum(*below_without),
    )


@dataclass(frozen=True)
class PairedRatio:
    """One time over another, both measured in turns: the median over the turns, and its standard error."""

    value: float
    error: float


def paired_ratio(above: Timing, below: Timing) -> PairedRatio:
    """How many times longer `above` takes than `below`, run by run: the machine's pace in a turn falls out.

    The error is that of a median of normally distributed numbers, whose deviation is 1.4826 times the median one.
    """
    ratios = above.seconds() / below.seconds()
    value = float(np.median(ratios))
    deviation = 1.4826 * float(np.median(np.abs(ratios - value)))
    return PairedRatio(value, float(np.sqrt(0.5 * np.pi / len(ratios))) * deviation)


def measure(contestants: list[Contestant], rounds: int) -> dict[str, Timing]:
    """Times of all contestants by name, from `rounds` turns of each. Prints how far it is."""
    samples = {contestant.name: [] for contestant in contestants}
    used = dict.fromkeys(samples, 0.0)
    clock = _FrameClock()
    last_line = time.perf_counter()
    for number in range(1, rounds + 1):
        for contestant in contestants:
            if used[contestant.name] < _PATIENCE:
                taken = _turn(contestant, clock)
                samples[contestant.name] += taken
                used[contestant.name] += float(np.sum(taken))
            if time.perf_counter() - last_line > _SILENCE:
                print(f"    round {number} of {rounds}: {contestant.name}", flush=True)
                last_line = time.perf_counter()
    return {
        contestant.name: Timing(tuple(contestant.parts), np.array(samples[contestant.name]))
        for contestant in contestants
    }


def alternate(contestants: list[Contestant], cycles: int) -> dict[str, Timing]:
    """Times of all contestants by name, each run once in every cycle: for small differences between equals.

    What else the machine does changes more slowly than a cycle, and no run finds the caches as it left them. Cycle
    by cycle they take every order, so that none always runs after the same other. The first cycle is not timed.
    """
    clock = _FrameClock()
    for one in contestants:
        _timed_run(one, clock)
    runs = {one.name: [] for one in contestants}
    for order in itertools.islice(itertools.cycle(itertools.permutations(contestants)), cycles):
        for one in order:
            runs[one.name].append(_timed_run(one, clock))
    return {one.name: Timing(tuple(one.parts), np.array(runs[one.name])) for one in contestants}


def one_after_another(contestant: Contestant) -> Callable[[], None]:
    """A function that runs all parts of a contestant, a frame later at each call."""
    clock = _FrameClock()

    def run():
        moment = clock.next()
        for part in contestant.parts.values():
            part(moment)

    return run


class _FrameClock:
    """The sea's time, a frame later at each run: nothing is measured twice for the same moment."""

    def __init__(self):
        self._frame = 0

    def next(self):
        self._frame += 1
        return self._frame / FRAMES_PER_SECOND


def _turn(contestant, clock):
    first = _timed_run(contestant, clock)
    if sum(first) > _SETTLED:
        return [first]
    runs = min(max(1, int(_TURN / sum(first))), _MOST_RUNS) if sum(first) > 0.0 else _MOST_RUNS
    return [_timed_run(contestant, clock) for _ in range(runs)]


def _timed_run(contestant, clock):
    moment = clock.next()
    marks = [time.perf_counter()]
    for part in contestant.parts.values():
        part(moment)
        marks.append(time.perf_counter())
    return np.diff(marks)
