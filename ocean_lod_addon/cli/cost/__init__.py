# SPDX-License-Identifier: GPL-3.0-or-later
"""`cost`: what accuracy costs in time on this machine, and what a budget buys."""

import csv
import io
import time
from dataclasses import dataclass, replace

from ...core.contraction import CONTRACTIONS, fastest_contraction
from ...core.cost.model import CostModel
from ...core.cost.probe import measured_prices, numpy_cases, probe
from ..arguments import real_number
from ..bench import in_blender
from ..bench.machine import Machine, disturbance, this_machine
from ..results import json_output, save_json, save_text
from . import budgets, configurations, ladders, pictures, plot, prediction, report
from .budgets import BudgetResult
from .configurations import ConfigurationResult, FrontPoint
from .knobs.misprints import MISPRINTS
from .knobs.registry import KNOBS
from .ladders import Ladder
from .pictures import Pictures
from .prediction import Prediction
from .steady import SteadyPrices

NAME = "cost"
HELP = "Measure what accuracy costs in time on this machine, and what a budget buys."

_SCHEMA_VERSION = 1


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument(
        "--quick", action="store_true", help="knobs, configurations and budgets, under a minute (default)"
    )
    extent.add_argument(
        "--full", action="store_true", help="also predictions tried out and pictures; under ten minutes"
    )
    parser.add_argument(
        "--contraction",
        choices=tuple(CONTRACTIONS),
        help="how matrices are multiplied where predictions are tried out without Blender (einsum)",
    )
    parser.add_argument(
        "--budget-ms",
        type=real_number(0.01, 1e6),
        metavar="MS",
        help="only say which quality fits this time a frame, for the ocean of the Add menu",
    )
    parser.add_argument(
        "--output", default="out/cost.json", metavar="FILE", help="results as JSON, CSV and plots (%(default)s)"
    )


@dataclass(frozen=True, eq=False)
class Results:
    """Everything that was measured; what the quick measurement leaves out is None."""

    machine: Machine
    model: CostModel
    probe_seconds: float
    ladders: list[Ladder]
    misprints: list[float]
    front: list[FrontPoint]
    configurations: list[ConfigurationResult]
    budgets: list[BudgetResult]
    pictures: Pictures | None
    predictions: list[Prediction] | None
    predictions_without_blas: list[Prediction] | None

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "schema_version": _SCHEMA_VERSION,
            "machine": self.machine.as_mapping(),
            "probe_seconds": self.probe_seconds,
            "prices": self.model.prices,
            "knobs": [ladder.as_mapping() for ladder in self.ladders],
            "misprints": [
                {
                    "equation": misprint.equation,
                    "printed": misprint.printed,
                    "corrected": misprint.corrected,
                    "error_of": misprint.error_of,
                    "unit": misprint.unit,
                    "error": error,
                }
                for misprint, error in zip(MISPRINTS, self.misprints, strict=True)
            ],
            "front": [point.as_mapping() for point in self.front],
            "configurations": [each.as_mapping() for each in self.configurations],
            "budgets": [each.as_mapping() for each in self.budgets],
            "pictures": self.pictures and self.pictures.as_mapping(),
            "predictions": _mappings(self.predictions),
            "predictions_without_blas": _mappings(self.predictions_without_blas),
        }


def _mappings(results):
    return None if results is None else [each.as_mapping() for each in results]


def run(options) -> None:
    """Measure, print and save. Raises OceanError for bad arguments, before anything is measured."""
    with_blender = in_blender.is_available()
    if options.budget_ms is not None:
        model = _measured_model(with_blender)
        print(budgets.choose_for(model, 1e-3 * options.budget_ms).explain(), flush=True)
        return
    output = json_output(options.output)
    results = _measure(options, output, with_blender)
    _save(output, results)
    knobs_path, front_path = (output.with_name(f"{output.stem}_{name}.png") for name in ("knobs", "front"))
    if plot.save_plots(results, knobs_path, front_path):
        print(f"saved {knobs_path}\nsaved {front_path}", flush=True)
    else:
        print("no plots: the Python package matplotlib is not installed here", flush=True)


def _measured_model(with_blender):
    """The prices of this machine."""
    if not with_blender:
        return probe()
    import bpy

    from ... import register
    from ...scene import costing

    if not hasattr(bpy.types.Object, "ocean_lod"):
        register()
    return costing.measure_machine()


def _measure(options, output, with_blender):
    started = time.perf_counter()
    machine = this_machine(with_blender)
    rounds = 5 if options.full else 3
    print(f"{machine}; matrix products by {fastest_contraction()}", flush=True)
    prices = SteadyPrices(lambda: _measured_model(with_blender))
    model, probe_seconds = prices.model, prices.seconds_to_find
    _print(f"Prices, found in {probe_seconds:.1f} s", report.price_lines(model.prices))

    whole = configurations.measure_configurations(model, rounds, with_blender)
    tried = [budgets.try_budget(prices, budget, with_blender) for budget in budgets.BUDGETS]
    _print("Budgets, the ocean of the Add menu", report.budget_lines(tried))
    predictions, without_blas = _try_predictions(options, prices, with_blender)

    measured = []
    for knob in KNOBS:
        measured.append(ladders.measure_ladder(knob, rounds))
        print("\n" + "\n".join(report.ladder_lines(measured[-1])), flush=True)
    misprints = [misprint.error() for misprint in MISPRINTS]
    _print("Equations as printed, each by itself", report.misprint_lines(misprints))

    rendered = pictures.compare(output.parent) if options.full and with_blender else None
    if rendered is not None:
        whole = [replace(each, picture=rendered.differences[each.name]) for each in whole]
    _print("Whole configurations, the ocean of the Add menu", report.configuration_lines(whole))
    if rendered is not None:
        print(report.picture_line(rendered), flush=True)
    if disturbance():
        print(f"\n{disturbance()}")
    print(f"\nmeasured in {time.perf_counter() - started:.0f} s", flush=True)
    return Results(
        machine,
        model,
        probe_seconds,
        measured,
        misprints,
        configurations.front(model),
        whole,
        tried,
        rendered,
        predictions,
        without_blas,
    )


def _try_predictions(options, prices, with_blender):
    """Predictions beside times, through Blender and by a contraction in NumPy alone; (None, None) if quick."""
    if not options.full:
        return None, None
    predictions = prediction.try_model(prices, None, with_blender)
    where = "through Blender" if with_blender else "without Blender"
    _print(f"Predictions, {where}, by {fastest_contraction()}", report.prediction_lines(predictions))
    contraction = options.contraction or "einsum"
    cases = numpy_cases(contraction)
    alone = SteadyPrices(lambda: CostModel(measured_prices(cases)), contraction)
    without_blas = prediction.try_model(alone, contraction, False)
    _print(f"Predictions without Blender, by {contraction}", report.prediction_lines(without_blas))
    return predictions, without_blas


def _print(title, lines):
    print(f"\n{title}", *lines, sep="\n", flush=True)


def _save(output, results):
    save_json(output, results.as_mapping())
    table = io.StringIO()
    csv.writer(table).writerows([report.CSV_HEADER, *report.csv_rows(results.ladders)])
    save_text(output.with_suffix(".csv"), table.getvalue())
