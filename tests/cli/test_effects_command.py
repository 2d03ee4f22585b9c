# SPDX-License-Identifier: GPL-3.0-or-later
"""The effects command: what it compares is the right thing, its sums are right, and its bad input.

No test here asserts how long anything takes: that what is off costs nothing is shown by what is called and kept.
"""

import collections
import json
import sys
from statistics import NormalDist

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.cli import EXIT_BAD_INPUT, main
from ocean_lod_addon.cli.bench.in_blender import fresh_data
from ocean_lod_addon.cli.bench.timing import Timing, paired_ratio
from ocean_lod_addon.cli.effects import Extent, Row, measure_effects, report
from ocean_lod_addon.cli.effects.builds import NAMES, EffectOcean, Picture
from ocean_lod_addon.core.effects import OFF, ON
from ocean_lod_addon.core.lod import Grid
from tools import effects_document

TINY = Grid(cells=16, levels=2)


@pytest.fixture(autouse=True)
def _unregistered():
    yield
    if hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.unregister()


def calls_of_a_frame(ocean):
    """How often each function of the package is called in a frame."""
    frame = ocean.frame("").parts["handler"]
    for number in range(3):
        frame(number / 24.0)  # settings are read once
    calls = collections.Counter()

    def count(python_frame, event, _argument):
        if event == "call" and "ocean_lod_addon" in python_frame.f_code.co_filename:
            calls[python_frame.f_code.co_filename, python_frame.f_code.co_qualname] += 1

    sys.setprofile(count)
    try:
        frame(4.0 / 24.0)
    finally:
        sys.setprofile(None)
    return calls


def test_what_is_off_calls_and_keeps_what_an_ocean_without_it_does():
    """Function by function, and byte by byte but for what Python allocates now and then. On, effects are more:

    velocity has three columns of float32 in an array and as an attribute, ripples have images of 512 x 512 pixels.
    """
    with fresh_data():
        without, ocean = EffectOcean(TINY), EffectOcean(TINY)
        calls, kept = calls_of_a_frame(without), {}
        assert sum(calls.values()) > 50
        changing = set()
        for effect in NAMES:
            if calls_of_a_frame(ocean.set(effect, ON)) != calls:
                changing.add(effect)
            if effect in ("velocity", "ripples"):
                kept[effect] = ocean.memory()
            assert calls_of_a_frame(ocean.set(effect, OFF)) == calls, effect
        assert {"analytic_normals", "velocity", "foam", "ripples", "gusts"} <= changing
        bare = without.memory()
        assert ocean.memory() == pytest.approx(bare, rel=0.01)
        assert kept["velocity"] - bare > 2 * 3 * 4 * TINY.vertex_count
        assert kept["ripples"] - bare > 4 * 4 * 512**2


def test_a_small_measurement_becomes_text_json_and_a_page(capsys):
    extent = Extent(TINY, 1, (Picture("CYCLES", (4, 4), 1, renders=1),))
    results = measure_effects(extent, ["foam"])
    saved = results.as_mapping()
    assert json.loads(json.dumps(saved)) == saved
    (row,) = saved["effects"]
    assert row["memory_bytes"]["on"] > row["memory_bytes"]["off"]
    assert set(row["render_ms"]["CYCLES"]) == {"on", "off", "absent"}
    printed = capsys.readouterr().out
    assert any(line.startswith("Foam ") for line in printed.splitlines())
    assert "| Foam |" in effects_document.table_of(saved)


def row_of(on, off, absent):
    frame = {
        state: Timing(("handler",), np.broadcast_to(seconds, (3, 1)))
        for state, seconds in (("on", on), ("off", off), ("absent", absent))
    }
    return Row("foam", frame, {"on": 200, "off": 100, "absent": 100}, {})


def test_three_per_cent_decide():
    assert "+2.9% at most (Foam): PASS" in report.verdicts([row_of(5.0, 1.029, 1.0)])[0]
    two = [row_of(5.0, 1.029, 1.0), row_of(5.0, 1.031, 1.0)]
    assert "+3.1% at most (Foam): MISS" in report.verdicts(two)[0]
    noisy = row_of(5.0, np.array([[1.0], [1.05], [1.1]]), 1.0)
    assert "+5.0% at most (Foam): UNDECIDED" in report.verdicts([noisy])[0]


def test_a_ratio_of_turns_does_not_see_the_pace_of_the_machine():
    """Half as fast in every other turn, both of them: the ratio is 1.02, with no error. And 101 ratios of a normal
    distribution of 10 %: a standard error of 1.2533 * 10 % / sqrt(101), which the sample knows to some 10 %."""
    pace = np.array([1.0, 2.0, 1.0, 2.0, 1.0])[:, None]
    steady = paired_ratio(Timing(("a",), 1.02 * pace), Timing(("a",), pace))
    assert (steady.value, steady.error) == (pytest.approx(1.02), pytest.approx(0.0, abs=1e-12))
    shares = (np.arange(101) + 0.5) / 101
    normal = np.array([NormalDist(1.0, 0.1).inv_cdf(share) for share in shares])[:, None]
    assert paired_ratio(Timing(("a",), normal), Timing(("a",), np.ones((101, 1)))).error == pytest.approx(
        1.2533 * 0.1 / 101**0.5, rel=0.1
    )


@pytest.mark.parametrize("arguments", [["--only", "rain"], ["--output", "/proc/nowhere/effects.json"]])
def test_bad_input_is_one_line(capsys, arguments):
    assert main(["effects", *arguments]) == EXIT_BAD_INPUT
    assert len(capsys.readouterr().err.strip().splitlines()) == 1
