# SPDX-License-Identifier: GPL-3.0-or-later
"""The most accurate configuration that a time allows, and why it is that one."""

from collections.abc import Callable
from dataclasses import dataclass

from ..readback_text import plain_number
from .model import STAGES
from .quality import Rung


@dataclass(frozen=True)
class Choice:
    """What a budget buys.

    rung      the configuration
    stages    predicted seconds of each stage of a frame
    budget    s
    above     the next configuration and its predicted seconds, or None for the last one
    """

    rung: Rung
    stages: dict[str, float]
    budget: float
    above: tuple[Rung, float] | None

    @property
    def seconds(self) -> float:
        """Predicted seconds of a frame."""
        return sum(self.stages.values())

    @property
    def fits(self) -> bool:
        """Whether the prediction is within the budget: if not, even the cheapest configuration is too slow."""
        return self.seconds <= self.budget

    def explain(self) -> str:
        """The choice and its reasons in one or two sentences."""
        budget, taken = f"{1e3 * self.budget:g} ms", milliseconds(self.seconds)
        shares = sorted(self.stages.items(), key=lambda item: -item[1])[:3]
        parts = ", ".join(f"{STAGES[name].label.lower()} {milliseconds(seconds)}" for name, seconds in shares)
        chosen = f"{self.rung.label} ({describe(self.rung)})"
        if not self.fits:
            return f"Even {chosen}, the cheapest, takes {taken}, more than the budget of {budget}: {parts}"
        text = f"{chosen} takes {taken} of the {budget}, a little of which is kept free: {parts}."
        if self.above is None:
            return f"{text} There is nothing more accurate to spend the rest on"
        rung, seconds = self.above
        return f"{text} The next step, {describe(rung)}, would take {milliseconds(seconds)}"


def describe(rung: Rung) -> str:
    """What a configuration is, in a few words."""
    quality = rung.quality
    ripples = "no ripples" if quality.ripples == "off" else f"ripples of {quality.ripples}"
    return f"{quality.samples:.3g} vertices a wavelength, {ripples}"


def milliseconds(seconds: float) -> str:
    """Seconds as a text in ms, three digits."""
    return f"{plain_number(1e3 * seconds)} ms"


HEADROOM = 0.08
"""Share of a budget that is kept free: a frame may take so much longer than predicted, and yet not exceed it."""


def choose(rungs: list[Rung], predict: Callable[[Rung], dict[str, float]], budget: float) -> Choice:
    """The most accurate of `rungs`, from cheap to accurate, predicted to take `budget` s at most, less HEADROOM.

    `predict` gives the seconds of each stage. If none fits it is the first, and the choice says that it does not.
    """
    predictions = [predict(rung) for rung in rungs]
    totals = [sum(stages.values()) for stages in predictions]
    allowed = (1.0 - HEADROOM) * budget
    best = max((number for number, total in enumerate(totals) if total <= allowed), default=0)
    above = None if best + 1 == len(rungs) else (rungs[best + 1], totals[best + 1])
    return Choice(rungs[best], predictions[best], budget, above)
