# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of `cost` as text for the terminal, and as a table of numbers."""

from ...core.cost.model import STAGES
from . import budgets, prediction
from .budgets import BudgetResult
from .configurations import ConfigurationResult
from .knobs.misprints import MISPRINTS
from .ladders import Ladder
from .pictures import Pictures
from .prediction import Prediction

PASS, MISS = "PASS", "MISS"

CSV_HEADER = ("knob", "value", "error", "unit", "ms", "worth_having")


def number(value: float) -> str:
    """Three digits, for people."""
    return "0" if abs(value) < 1e-9 else f"{value:.3g}"


def verdict(reached: bool) -> str:
    """PASS or MISS."""
    return PASS if reached else MISS


def ladder_lines(ladder: Ladder) -> list[str]:
    """One knob."""
    knob = ladder.knob
    lines = [f"{knob.label}: {knob.affects}"]
    lines.append(f"  error: {knob.error_of} ({knob.unit}); ms: {knob.time_of}")
    width = max(len(step.value) for step in ladder.steps)
    for step in ladder.steps:
        note = "" if step.worth_having else "   left out: another is no worse and faster"
        lines.append(f"  {step.value:{width}}  {number(step.error):>9}  {number(step.milliseconds):>9} ms{note}")
    return lines


def misprint_lines(errors: list[float]) -> list[str]:
    """What each printed equation would have cost."""
    return [
        f"  Eq. {misprint.equation:6} {misprint.printed:28} {number(error):>8} {misprint.unit}:"
        f" {misprint.error_of}"
        for misprint, error in zip(MISPRINTS, errors, strict=True)
    ]


def configuration_lines(results: list[ConfigurationResult]) -> list[str]:
    """Whole configurations."""
    lines = [
        f"  {'':10}{'vertices':>9}{'per wave':>9}{'reach':>6}{'ripples':>8}{'foam':>5}{'mm':>7}{'% wrong':>8}"
        f"{'steps':>7}{'95 %':>7}{'predicted':>10}{'measured':>9}"
    ]
    for each in results:
        picture = each.picture
        steps = ("-", "-") if picture is None else (f"{picture.mean:.2f}", f"{picture.percentile_95:.2f}")
        lines.append(
            f"  {each.label:10}{each.vertices:>9}{each.samples:>9g}{each.reach:>6g}{each.texels:>8}"
            f"{each.instants:>5}{each.height:>7.2f}{each.ripples:>8.2f}{steps[0]:>7}{steps[1]:>7}"
            f"{each.predicted:>7.1f} ms{'-' if each.measured is None else f'{each.measured:.1f} ms':>9}"
        )
    return lines


def picture_line(pictures: Pictures) -> str:
    """Whether the Reference has converged."""
    twice = pictures.reference_from_twice
    return (
        f"  Twice of everything changes the Reference's picture by {twice.mean:.3f} steps of 1/255 in the mean,"
        f" {twice.percentile_95:.3f} at most in 95 % and {twice.percentile_99:.2f} in 99 % of it:"
        f" {verdict(pictures.converged)}"
    )


def prediction_lines(predictions: list[Prediction]) -> list[str]:
    """Predicted beside measured times."""
    lines = [
        f"  {each.name:56}{1e3 * each.predicted:8.2f} ms predicted {1e3 * each.measured:8.2f} ms measured "
        f"{100.0 * each.off_by:+6.1f} %"
        for each in predictions
    ]
    right = sum(abs(each.off_by) <= prediction.LIMIT for each in predictions)
    worst = max(abs(each.off_by) for each in predictions)
    lines.append(
        f"  {right} of {len(predictions)} within {100.0 * prediction.LIMIT:.0f} %, the worst off by"
        f" {100.0 * worst:.1f} %: {verdict(right == len(predictions))}"
    )
    return lines


def budget_lines(results: list[BudgetResult]) -> list[str]:
    """Budgets and what became of them."""
    lines = []
    for result in results:
        reached = result.choice.fits and result.over <= budgets.LIMIT
        lines.append(f"  {result.choice.explain()}")
        lines.append(
            f"    median of {budgets.FRAMES} frames {1e3 * result.measured:.2f} ms,"
            f" {100.0 * result.over:+.1f} % of the budget: {verdict(reached)}"
        )
    return lines


def price_lines(prices) -> list[str]:
    """The prices of this machine."""
    return [
        f"  {STAGES[stage].label:15}" + ", ".join(f"{price:.3g}" for price in values) + " s"
        for stage, values in prices.items()
    ]


def csv_rows(ladders: list[Ladder]) -> list[tuple]:
    """Every step of every knob as a row under CSV_HEADER."""
    return [
        (
            ladder.knob.key,
            step.value,
            repr(step.error),
            ladder.knob.unit,
            repr(step.milliseconds),
            step.worth_having,
        )
        for ladder in ladders
        for step in ladder.steps
    ]
