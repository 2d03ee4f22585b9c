# SPDX-License-Identifier: GPL-3.0-or-later
"""`cost`: what accuracy costs in time on this machine, and what a budget buys."""

import contextlib
import csv
import io
import math
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
from .frames import BlenderOcean
from .knobs.misprints import MISPRINTS
from .knobs.registry import KNOBS
from .ladders import Ladder
from .pictures import Pictures
from .prediction import Prediction

NAME = "cost"
HELP = "Measure what accuracy costs in time on this machine, and what a budget buys."

_SCHEMA_VERSION = 1

_LONGEST_IF_QUICK = 0.5
"""s; the quick measurement only predicts what takes longer: the Reference, which also takes long to build."""


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument(
        "--quick", action="store_true", help="knobs, configurations and budgets, about a minute (default)"
    )
    extent.add_argument(
        "--full", action="store_true", help="also predictions tried out and pictures; about ten minutes"
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
        with _beside_an_ocean(with_blender):
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


@contextlib.contextmanager
def _beside_an_ocean(with_blender):
    """Within this context Blender has an ocean, as a user's has: its nodes are not made while prices are found."""
    if not with_blender:
        yield
        return
    with in_blender.fresh_data():
        BlenderOcean.of(budgets.SIZED)
        yield


def _measured_model(with_blender):
    """The prices of this machine."""
    return _costing().measure_machine() if with_blender else probe()


def _costing():
    """What measures in Blender, with the extension registered."""
    import bpy

    from ... import register
    from ...scene import costing

    if not hasattr(bpy.types.Object, "ocean_lod"):
        register()
    return costing


@contextlib.contextmanager
def _price_finder(with_blender, contraction=None):
    """A function that finds prices anew, by cases that are built once."""
    with _costing().price_cases() if with_blender else contextlib.nullcontext(numpy_cases(contraction)) as cases:
        yield lambda: CostModel(measured_prices(cases))


def _measure(options, output, with_blender):
    started = time.perf_counter()
    machine = this_machine(with_blender)
    rounds, attempts, longest = (5, 5, math.inf) if options.full else (3, 1, _LONGEST_IF_QUICK)
    print(f"{machine}; matrix products by {fastest_contraction()}", flush=True)
    with _beside_an_ocean(with_blender):
        probe_started = time.perf_counter()
        model = _measured_model(with_blender)
        probe_seconds = time.perf_counter() - probe_started
        _print(f"Prices, found in {probe_seconds:.1f} s", report.price_lines(model.prices))
        with _price_finder(with_blender) as find:
            find_again = find if options.full else lambda: model
            whole = configurations.measure_configurations(find_again, longest, with_blender)
            tried = [budgets.try_budget(find, budget, attempts, with_blender) for budget in budgets.BUDGETS]
            _print("Budgets, the ocean of the Add menu", report.budget_lines(tried))
            predictions = _try_predictions(find, None, with_blender) if options.full else None
    without_blas = _try_without_blas(options.contraction or "einsum") if options.full else None

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


def _try_predictions(find, contraction, with_blender):
    """Predictions beside times, through Blender or by NumPy alone."""
    predictions = prediction.try_model(find, contraction, with_blender)
    where = "through Blender" if with_blender else "without Blender"
    by = contraction or fastest_contraction()
    _print(f"Predictions {where}, by {by}", report.prediction_lines(predictions))
    return predictions


def _try_without_blas(contraction):
    with _price_finder(False, contraction) as find:
        return _try_predictions(find, contraction, False)


def _print(title, lines):
    print(f"\n{title}", *lines, sep="\n", flush=True)


def _save(output, results):
    save_json(output, results.as_mapping())
    table = io.StringIO()
    csv.writer(table).writerows([report.CSV_HEADER, *report.csv_rows(results.ladders)])
    save_text(output.with_suffix(".csv"), table.getvalue())
