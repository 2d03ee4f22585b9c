# SPDX-License-Identifier: GPL-3.0-or-later
"""The knobs measured: error and time of every step, and which steps are worth having."""

import itertools
from dataclasses import dataclass

from ..bench.timing import Contestant, measure
from .knobs.knob import Knob
from .knobs.registry import worth_having


@dataclass(frozen=True)
class StepResult:
    """One step: its error in the knob's unit, its time in ms, and whether another beats it in both."""

    value: str
    error: float
    milliseconds: float
    worth_having: bool

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "value": self.value,
            "error": self.error,
            "ms": self.milliseconds,
            "worth_having": self.worth_having,
        }


@dataclass(frozen=True)
class Ladder:
    """A knob with its results."""

    knob: Knob
    steps: tuple[StepResult, ...]

    def as_mapping(self) -> dict:
        """For the saved file."""
        knob = self.knob
        return {
            "knob": knob.key,
            "label": knob.label,
            "affects": knob.affects,
            "error_of": knob.error_of,
            "unit": knob.unit,
            "reference": knob.reference,
            "time_of": knob.time_of,
            "steps": [step.as_mapping() for step in self.steps],
        }


NOISE = 0.03
"""Times that differ by less than this share count as equal: noise must not remove a step."""


def measure_ladder(knob: Knob, rounds: int) -> Ladder:
    """Compute the errors of a knob and time its steps in turns."""
    contestants = [Contestant(step.value, {"work": step.work()}) for step in knob.steps if step.work is not None]
    timings = measure(contestants, rounds) if contestants else {}
    errors = [step.error() for step in knob.steps]
    times = [
        1e3 * step.scale * timings[step.value].minimum() if step.value in timings else 0.0 for step in knob.steps
    ]
    kept = worth_having(errors, _even_out(times))
    return Ladder(
        knob,
        tuple(
            StepResult(step.value, error, time, keep)
            for step, error, time, keep in zip(knob.steps, errors, times, kept, strict=True)
        ),
    )


def _even_out(times):
    """Times with those that noise tells apart made equal, in their order."""
    evened = list(times)
    order = sorted(range(len(times)), key=times.__getitem__)
    for before, number in itertools.pairwise(order):
        if times[number] - evened[before] <= NOISE * times[number]:
            evened[number] = evened[before]
    return evened
