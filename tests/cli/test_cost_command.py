# SPDX-License-Identifier: GPL-3.0-or-later
"""The cost command: that what it measures is the right thing, that its sums are right, and its bad input.

No test here asserts how long anything takes.
"""

import csv
import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ocean_lod_addon.cli import cost
from ocean_lod_addon.cli.bench.machine import Machine
from ocean_lod_addon.cli.cost import budgets, configurations, frames, ladders, pictures, plot, prediction, report
from ocean_lod_addon.cli.cost.knobs.knob import Knob, Step
from ocean_lod_addon.cli.cost.knobs.misprints import MISPRINTS
from ocean_lod_addon.core.cost.budget import choose
from ocean_lod_addon.core.cost.model import STAGES, CostModel
from ocean_lod_addon.core.cost.quality import QUALITIES, apply, ladder
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.lod import Grid, undisturbed_positions
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea
from tools import accuracy_document

REPOSITORY = Path(__file__).parents[2]
BAD_INPUT = 2

PRICES = CostModel({"factors": (1e-4, 2e-9), "products": (1e-11, 0.0, 3e-10, 6e-6), "normals": (0.0, 3e-8, 2e-8)})


def knob(*steps):
    return Knob("test", "Test", "Nothing", "How wrong it is", "mm", "The truth", "a call", steps)


# ---------------------------------------------------------------------------------- what is measured


def test_a_ladder_has_errors_times_and_what_is_left_out():
    calls = []

    def slow(time):
        calls.append(time)
        np.linalg.svd(np.ones((80, 80)))

    result = ladders.measure_ladder(
        knob(
            Step("worst", lambda: 9.0, None),
            Step("slow and bad", lambda: 5.0, lambda: slow),
            Step("good", lambda: 1.0, lambda: lambda _time: None, scale=0.5),
        ),
        rounds=2,
    )
    assert [step.error for step in result.steps] == [9.0, 5.0, 1.0]
    assert result.steps[0].milliseconds == 0.0
    assert [step.worth_having for step in result.steps] == [True, False, True]
    assert len(calls) == len(set(calls)) >= 2  # no moment is measured twice
    assert json.loads(json.dumps(result.as_mapping()))["steps"][1]["worth_having"] is False


def test_noise_removes_no_step():
    assert ladders._even_out([1.0, 1.02, 2.0, 1.99]) == [1.0, 1.0, 1.99, 1.99]


def test_the_numpy_frame_is_the_sea():
    # Truth: the direct sum in float64, where all windows are 1: a sea whose shortest wave reaches past the edge.
    grid = Grid(cell_size=0.1, cells=16, levels=1)
    settings = frames.settings_of(Sea(wave_count=16), grid, Ripples(kind="off"))
    frame = frames.NumpyFrame(settings, "einsum")
    for part in frame.contestant("frame").parts.values():
        part(3.0)
    normals = frame._positions  # the normals end up where the positions were
    waves = discretise(Sea(wave_count=16), grid.shortest_wavelength)
    middle = int(np.argmin(np.abs(undisturbed_positions(grid, np.zeros((1, 2)))).sum(axis=1)))
    truth = surface_points(waves, 0.0, 0.0, 3.0).normal
    np.testing.assert_allclose(normals[middle], truth, atol=1e-4)


def test_twenty_configurations_that_no_probe_has_seen():
    from ocean_lod_addon.core.cost import probe

    assert len(prediction.CASES) == 20
    assert len(set(prediction.CASES)) == 20
    probed = {(cells, levels, waves) for cells, levels, waves, _, _ in probe._PLANES}
    assert not probed & {(grid.cells, grid.levels, waves) for grid, waves, _, _ in prediction.CASES}


def test_a_prediction_is_judged_by_the_measured_time():
    right, wrong = prediction.Prediction("a", 1.19, 1.0), prediction.Prediction("b", 0.7, 1.0)
    assert right.off_by == pytest.approx(0.19)
    assert wrong.off_by == pytest.approx(-0.3)
    assert report.prediction_lines([right])[-1].endswith("PASS")
    assert report.prediction_lines([right, wrong])[-1].endswith("MISS")


def test_the_turn_in_the_middle_counts_and_disturbed_ones_are_noticed():
    off = (("a", 1.5), ("b", 1.0), ("c", 1.1))
    turns = [prediction.Prediction(name, predicted, 1.0) for name, predicted in off]
    assert prediction.middle(turns).name == "c"
    assert not prediction.agree(turns)
    assert prediction.agree([turns[2], prediction.Prediction("d", 1.15, 1.0)])


def test_height_errors_of_the_qualities_fall():
    errors = [configurations.height_error(QUALITIES[name]) for name in ("preview", "standard")]
    assert errors[0] > 1.5 * errors[1] > 0.0  # (4/3)^2 = 1.8


def test_the_front_rises_to_the_reference():
    points = configurations.front(PRICES)
    assert points[0].label == "Draft"
    assert points[-1].label == "Reference"
    assert points[-1].predicted > 10.0 * points[0].predicted > 0.0


def test_a_budget_is_judged_by_the_median():
    rungs = ladder(Grid())
    choice = choose(rungs, lambda _rung: {"products": 0.004}, 0.005)
    assert report.budget_lines([budgets.BudgetResult(choice, 0.0054)])[-1].endswith("PASS")
    assert report.budget_lines([budgets.BudgetResult(choice, 0.0056)])[-1].endswith("MISS")


# ------------------------------------------------------------------------------------------- pictures


def test_pictures_are_compared_as_a_screen_shows_them():
    # sRGB: half the light is 188 of 255 steps; what is brighter than white is white.
    assert pictures.shown(np.array([0.0, 0.5, 1.0, 7.0]), 1.0) == pytest.approx(
        [0.0, 187.5, 255.0, 255.0], abs=0.1
    )
    same = np.full((4, 4, 3), 0.3)
    assert pictures.difference(same, same, 1.0) == pictures.PictureDifference(0.0, 0.0, 0.0)
    one = same.copy()
    one[0, 0] = 1.0
    assert pictures.difference(one, same, 1.0).mean == pytest.approx((255.0 - 148.9) / 16.0, rel=0.01)


def test_twice_of_everything_draws_the_same_waves():
    settings = apply(QUALITIES["reference"], budgets.SIZED)
    doubled = pictures.twice(settings)
    assert doubled.grid.shortest_wavelength == settings.grid.shortest_wavelength
    assert doubled.grid.samples_per_wavelength == 2 * settings.grid.samples_per_wavelength
    assert doubled.grid.half_extent == 2 * settings.grid.half_extent


# ------------------------------------------------------------------------------------------- results


def results():
    ladder_ = ladders.Ladder(
        knob(Step("a", lambda: 1.0, None), Step("b", lambda: 0.5, None)),
        (ladders.StepResult("a", 1.0, 2.0, True), ladders.StepResult("b", 0.5, 3.0, True)),
    )
    difference = pictures.PictureDifference(0.2, 0.9, 3.0)
    whole = configurations.ConfigurationResult(
        "draft", "Draft", 100, 128, 2.0, 0.5, "off", 1, 20.0, 100.0, 3.0, 3.1, difference
    )
    choice = choose(ladder(Grid()), lambda _rung: {"products": 0.004}, 0.005)
    return cost.Results(
        Machine("processor", 2, "3", "2", "openblas", "5.2"),
        PRICES,
        1.0,
        [ladder_],
        [1.0] * len(MISPRINTS),
        configurations.front(PRICES),
        [whole],
        [budgets.BudgetResult(choice, 0.0049)],
        pictures.Pictures({"draft": difference}, difference),
        [prediction.Prediction("a", 1.1, 1.0)],
        [prediction.Prediction("a", 1.3, 1.0)],
    )


def test_results_are_saved_as_json_csv_and_plots(tmp_path):
    pytest.importorskip("matplotlib")
    saved = results()
    cost._save(tmp_path / "cost.json", saved)
    loaded = json.loads((tmp_path / "cost.json").read_text(encoding="utf-8"))
    assert loaded["knobs"][0]["steps"][1] == {"value": "b", "error": 0.5, "ms": 3.0, "worth_having": True}
    assert loaded["pictures"]["converged"] is True
    with (tmp_path / "cost.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert rows[0] == {
        "knob": "test", "value": "a", "error": "1.0", "unit": "mm", "ms": "2.0", "worth_having": "True"
    }  # fmt: skip
    assert plot.save_plots(saved, tmp_path / "knobs.png", tmp_path / "front.png")
    assert min((tmp_path / name).stat().st_size for name in ("knobs.png", "front.png")) > 5000


def test_the_document_has_a_place_for_everything():
    text = accuracy_document.DOCUMENT.read_text(encoding="utf-8")
    saved = json.loads(json.dumps(results().as_mapping()))
    filled = accuracy_document.made_from(saved, text)
    assert "processor, 2 cores" in filled
    assert "| b | 0.5 | 3 |  |" in filled
    assert "1 of 1 with BLAS" in filled
    assert "0 of 1 without" in filled
    assert accuracy_document.made_from(saved, filled) == filled


# ------------------------------------------------------------------------------------------- bad input


def run_cost(*arguments):
    command = [sys.executable, "-m", "ocean_lod_addon", "cost", *arguments]
    environment = os.environ | {"PYTHONPATH": str(REPOSITORY)}
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False, cwd=REPOSITORY)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--output", "cost.txt"), "allowed is .json"),
        (("--budget-ms", "-3"), "give a number from 0.01 to 1e+06"),
        (("--quick", "--full"), "not allowed with argument"),
    ],
)
def test_bad_input_is_one_line(arguments, said):
    done = run_cost(*arguments)
    assert done.returncode == BAD_INPUT
    assert said in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_a_budget_is_explained_without_doing_anything():
    done = run_cost("--budget-ms", "0.02")
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip().splitlines()[-1].startswith("Even Draft")


def test_stages_of_a_model_without_blender_are_those_of_numpy():
    assert set(PRICES.prices) < set(STAGES)
    assert dataclasses.is_dataclass(PRICES)
