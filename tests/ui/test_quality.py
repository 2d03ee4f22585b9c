# SPDX-License-Identifier: GPL-3.0-or-later
"""Quality in the panel: the same sea with more or less effort, by name or by budget, undoable.

Times themselves are not asserted, only what is made of them.
"""

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.cost.model import STAGES, CostModel
from ocean_lod_addon.core.cost.quality import QUALITIES
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.scene import costing, frame_times, ocean_object, properties
from ocean_lod_addon.ui.quality import time_lines


@pytest.fixture
def prices(monkeypatch):
    """A machine on which every vertex of a frame costs a microsecond and nothing else costs anything."""
    prices = {name: tuple(0.0 for _ in STAGES[name].counts(_Any())) for name in STAGES}
    prices["blender"] = (0.0, 1e-6, 0.0, 0.0)
    monkeypatch.setattr(costing._machine, "model", CostModel(prices))


class _Any:
    """Work with any count."""

    def __getattr__(self, name):
        return 1.0


def grid_of(ocean):
    return properties.sized_plane(ocean.ocean_lod)


def positions(ocean):
    values = np.empty(3 * len(ocean.data.vertices), np.float32)
    ocean.data.attributes["position"].data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def test_every_quality_can_be_set_and_standard_is_the_way_back(ocean):
    sized = Grid(cell_size=0.25, cells=32, levels=4)
    before = positions(ocean).copy()
    for name in (*QUALITIES, "draft", "standard"):
        assert bpy.ops.object.ocean_lod_set_quality(quality=name) == {"FINISHED"}
        assert grid_of(ocean) == (sized, name)
        assert len(ocean.data.vertices) == ocean_object.read_ocean(ocean, bpy.context.scene).grid.vertex_count
    np.testing.assert_array_equal(positions(ocean), before)
    assert ocean.ocean_lod.effects.ripples == "auto"


def test_waves_stay_where_they_are(ocean):
    # The middle vertex stands at the origin in every quality; the waves that reach it are the same. Cell sizes are
    # kept as float32, which moves the shortest wave by 6e-8 of its length.
    heights = []
    for name in ("draft", "film"):
        bpy.ops.object.ocean_lod_set_quality(quality=name)
        surface = positions(ocean)
        rest = np.abs(surface[:, :2]).sum(axis=1)
        middle = np.argsort(rest)[:40]
        grid = ocean_object.read_ocean(ocean, bpy.context.scene).grid
        vertex = _middle_vertex(grid)
        assert vertex in middle
        heights.append(surface[vertex])
    np.testing.assert_allclose(heights[0], heights[1], atol=1e-4)


def _middle_vertex(grid):
    from ocean_lod_addon.core.lod import undisturbed_positions

    flat = undisturbed_positions(grid, np.zeros((grid.levels, 2)))
    return int(np.argmin(np.abs(flat).sum(axis=1)))


def test_a_plane_that_was_changed_by_hand_is_the_new_standard(ocean):
    bpy.ops.object.ocean_lod_set_quality(quality="film")
    ocean.ocean_lod.grid.levels = 3
    changed, name = grid_of(ocean)
    assert name == ""
    assert changed.levels == 3
    assert changed.samples_per_wavelength == QUALITIES["film"].samples


def test_draft_leaves_ripples_out_and_the_plan_says_so(ocean):
    bpy.ops.object.ocean_lod_set_quality(quality="draft")
    plan = ocean_object.plan(ocean, bpy.context.scene)
    assert not plan.on("ripples")


def test_a_budget_is_met_and_explained(ocean, prices):
    ocean.ocean_lod.quality.budget = 10.0  # ms: 10 000 vertices
    assert bpy.ops.object.ocean_lod_meet_budget() == {"FINISHED"}
    assert len(ocean.data.vertices) <= 10_000
    choice = costing.meet_budget(ocean, bpy.context.scene, 10e-3, final=False)
    assert choice.fits
    assert choice.seconds == pytest.approx(1e-6 * len(ocean.data.vertices))
    assert choice.above[1] > 10e-3


def test_a_budget_that_nothing_fits_is_a_warning_not_a_silence(ocean, prices):
    choice = costing.meet_budget(ocean, bpy.context.scene, 1e-6, final=False)
    assert not choice.fits
    assert choice.rung.name == "draft"


def test_a_frame_keeps_its_times_by_stage(ocean):
    scene = bpy.context.scene
    scene.frame_set(5)
    measured = frame_times.of_last_frame(ocean)
    assert {"setup", "products", "write"} <= set(measured)
    assert min(measured.values()) >= 0.0
    names = [line.name for line in time_lines({}, measured)]
    assert names[0] == "ms a frame"
    assert names[-1] == "Together"


def test_measured_times_change_no_frame(ocean):
    scene = bpy.context.scene
    scene.frame_set(7)
    first = positions(ocean).copy()
    frame_times._last.clear()
    scene.frame_set(3)
    scene.frame_set(7)
    np.testing.assert_array_equal(positions(ocean), first)


def test_the_machine_can_be_measured_and_leaves_nothing_behind(ocean, monkeypatch):
    monkeypatch.setattr(costing._machine, "model", None)
    assert costing.predict(ocean, bpy.context.scene) == {}
    kinds = ("objects", "meshes", "materials", "images", "scenes")
    before = {kind: len(getattr(bpy.data, kind)) for kind in kinds}
    assert bpy.ops.object.ocean_lod_measure_machine() == {"FINISHED"}
    assert {kind: len(getattr(bpy.data, kind)) for kind in kinds} == before
    predicted = costing.predict(ocean, bpy.context.scene)
    assert set(predicted) == set(STAGES)
    assert all(seconds >= 0.0 for seconds in predicted.values())
