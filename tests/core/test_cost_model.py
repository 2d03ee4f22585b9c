# SPDX-License-Identifier: GPL-3.0-or-later
"""Work counted, time predicted, quality chosen. No test here asserts how long anything takes."""

import dataclasses
import itertools

import numpy as np
import pytest

from ocean_lod_addon.core.column_blocks import POSITION, TANGENTS
from ocean_lod_addon.core.contraction import CONTRACTIONS
from ocean_lod_addon.core.cost import model, probe
from ocean_lod_addon.core.cost.budget import choose
from ocean_lod_addon.core.cost.model import STAGES, CostModel, fit_prices
from ocean_lod_addon.core.cost.planned import planned_work
from ocean_lod_addon.core.cost.quality import QUALITIES, apply, ladder
from ocean_lod_addon.core.cost.work import Work, work_of
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.effects import Effects
from ocean_lod_addon.core.foam.whitecaps import Whitecaps
from ocean_lod_addon.core.foam_settings import Foam
from ocean_lod_addon.core.framing import Framing
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.lod import Grid, tile_sizes
from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.ocean import Ocean
from ocean_lod_addon.core.plan import Facts, Settings
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea

from .plane_tiles import no_tile

NOTHING = Work(*[0.0] * len(dataclasses.fields(Work)))


def settings(**grid):
    return Settings(Sea(), Grid(**grid), Framing(), MaterialSettings(), Ripples(), Foam(), Effects())


# ------------------------------------------------------------------------------------------------- work


@pytest.mark.parametrize("grid", [Grid(cells=64, levels=6), Grid(cells=256, levels=11), Grid(cells=128, levels=1)])
@pytest.mark.parametrize("waves", [8, 128])
@pytest.mark.parametrize("contraction", CONTRACTIONS)
@pytest.mark.parametrize("share_in_view", [None, 0.0, 0.3])
def test_counted_work_is_what_the_kernel_does(grid, waves, contraction, share_in_view):
    ocean = Ocean(Sea(wave_count=waves), grid, foam=Foam(memory_steps=4))
    components = discretise(ocean.sea, grid.shortest_wavelength)
    sizes = tile_sizes(grid.cells, grid.levels)
    rows = np.arange(sizes.shape[1])[:, None] + 0 * sizes
    visible = None if share_in_view is None else (rows < share_in_view * sizes.shape[1]) & (sizes > 0)
    kernel = FrameKernel(grid, components, contraction)
    past = Whitecaps(ocean.foam, ocean.sea, grid, components).block
    blocks = (POSITION, TANGENTS, past)
    kernel.fill_factors(0.0, np.zeros((grid.levels, 2)), blocks)
    products = {
        block: kernel.products(np.empty((kernel.vertex_count, block.columns), np.float32), visible, block=block)
        for block in blocks
    }
    counted = work_of(ocean, components, (POSITION, TANGENTS), contraction, visible)
    of_waves, of_foam = products[POSITION] + products[TANGENTS], products[past]
    assert counted.multiplications == pytest.approx(sum(0.5 * p.operations for p in of_waves), rel=1e-12)
    assert counted.foam_multiplications == pytest.approx(sum(0.5 * p.operations for p in of_foam), rel=1e-12)
    cut = contraction == "einsum"
    assert counted.products == sum(len(p.pieces) if cut else 1 for p in of_waves)
    assert counted.foam_products == sum(len(p.pieces) if cut else 1 for p in of_foam)
    written = [p.out for p in of_waves] + [getattr(p, "mirrored", None) for p in of_waves]
    assert counted.floats == sum(array.size for array in written if array is not None)
    assert counted.foam_floats == sum(p.out.size for p in of_foam)
    assert counted.vertices == counted.normals == grid.vertex_count


def test_work_of_what_is_in_view_and_of_a_share_of_the_waves():
    ocean = Ocean(grid=Grid(cells=64, levels=3))
    waves = discretise(ocean.sea, ocean.grid.shortest_wavelength)
    whole = work_of(ocean, waves, (POSITION,), "matmul")
    none = work_of(ocean, waves, (POSITION,), "matmul", visible=no_tile(ocean.grid))
    half = work_of(ocean, waves, (POSITION,), "matmul", wave_limit=64)
    assert none.multiplications == none.floats == none.factor_terms == 0.0  # still water is written once
    assert none.multiplications < half.multiplications < whole.multiplications


def test_foam_of_the_past_needs_other_factors_than_mirrored_waves():
    ocean = Ocean(grid=Grid(cells=64, levels=3), foam=Foam(memory_steps=4))
    waves = discretise(ocean.sea, ocean.grid.shortest_wavelength)
    terms = {name: work_of(ocean, waves, (POSITION,), name).factor_terms for name in CONTRACTIONS}
    assert terms["einsum"] == 2.0 * terms["matmul"] > 0.0


def test_work_of_ripples():
    # Texels times bands.
    spectral = work_of(Ocean(ripples=Ripples(resolution="256")), discretise(Sea(), 0.4), (), "matmul")
    assert spectral.texels % 256**2 == 0
    assert spectral.shared_texels == 0.0
    large = work_of(Ocean(ripples=Ripples(resolution="1024")), discretise(Sea(), 0.4), (), "matmul")
    assert large.texels == 0.0
    assert large.shared_texels % 1024**2 == 0.0 < large.shared_texels
    assert work_of(Ocean(ripples=Ripples(kind="off")), discretise(Sea(), 0.4), (), "matmul").images == 0.0


# ------------------------------------------------------------------------------------------------- model


def test_prices_that_made_the_times_are_found():
    random = np.random.Generator(np.random.PCG64(1))
    works = [
        dataclasses.replace(NOTHING, multiplications=m, passes=r, floats=f, products=p)
        for m, r, f, p in random.uniform(1.0, 100.0, (12, 4))
    ]
    true = (3e-3, 0.0, 2e-2, 5e-1)
    seconds = [np.dot(true, STAGES["products"].counts(work)) for work in works]
    np.testing.assert_allclose(fit_prices("products", works, seconds), true, rtol=1e-9, atol=1e-12)


def test_no_price_is_negative():
    # Times that fall with the work: the best fit without negative prices is a constant.
    works = [dataclasses.replace(NOTHING, levels=1.0, factor_terms=float(terms)) for terms in (1, 2, 3)]
    constant, each = fit_prices("factors", works, [3.0, 2.0, 1.0])
    assert each == 0.0
    assert constant > 0.0


def test_work_that_never_occurs_has_no_price():
    works = [dataclasses.replace(NOTHING, images=1.0, texels=float(n)) for n in (10, 20)]
    assert fit_prices("ripples", works, [1.0, 2.0]) == pytest.approx((0.0, 0.1, 0.0))


def test_a_prediction_is_the_sum_of_its_stages():
    prices = CostModel({"normals": (0.5, 0.25, 0.125), "write": (1.0, 2.0)})
    work = dataclasses.replace(NOTHING, normals=8.0, vertices=8.0, vectors=2.0)
    assert prices.predict(work) == {"normals": 0.5 + 2.0, "write": 2.0 + 32.0}
    assert prices.total(work) == 36.5
    assert prices.total(dataclasses.replace(work, normals_shared=1.0)) == 35.5
    assert CostModel({"normals": (0.5, 0.25, 0.125)}).total(NOTHING) == 0.0


def test_a_probe_prices_every_stage_without_blender():
    prices = probe.probe("einsum").prices
    assert set(prices) == {"factors", "products", "normals", "foam_products", "foam", "ripples"}
    for stage, values in prices.items():
        assert len(values) == len(STAGES[stage].counts(NOTHING))
        assert min(values) >= 0.0 < max(values)


def test_runs_in_turns_are_called_alike():
    calls = []
    seconds = probe.typical_seconds([lambda t: calls.append(("a", t)), lambda t: calls.append(("b", t))])
    assert len(seconds) == 2
    assert [name for name, _ in calls[:4]] == ["a", "b", "a", "b"]
    assert len({t for name, t in calls if name == "a"}) == len(calls) // 2, "no moment is measured twice"


# ------------------------------------------------------------------------------------------------- quality


@pytest.mark.parametrize("sized", [Grid(), Grid(cell_size=0.03, cells=528, levels=9), Grid(cells=64, levels=3)])
def test_every_quality_draws_the_same_waves(sized):
    waves = discretise(Sea(), sized.shortest_wavelength)
    for quality in QUALITIES.values():
        grid = apply(quality, settings()).grid if sized == Grid() else None
        grid = grid or apply(quality, dataclasses.replace(settings(), grid=sized)).grid
        own = discretise(Sea(), grid.shortest_wavelength)
        np.testing.assert_allclose(own.wavenumber, waves.wavenumber, rtol=1e-12)
        np.testing.assert_array_equal(own.phase, waves.phase)
        assert grid.samples_per_wavelength == quality.samples
        assert grid.half_extent >= 0.97 * sized.half_extent or grid.levels == 20


def test_standard_is_the_plane_as_it_was_sized():
    assert apply(QUALITIES["standard"], settings()).grid == Grid()


def test_qualities_are_a_ladder():
    costs = [q.samples * q.reach for q in QUALITIES.values()]
    assert costs == sorted(costs)
    assert list(QUALITIES) == ["draft", "preview", "standard", "film", "reference"]


def test_rungs_never_lose_accuracy():
    rungs = ladder(Grid())
    named = [rung.name for rung in rungs if not rung.name.endswith("+")]
    assert named == list(QUALITIES)
    for lower, higher in itertools.pairwise(rungs):
        a, b = lower.quality, higher.quality
        assert a.samples <= b.samples
        assert a.reach <= b.reach
        assert (0 if a.ripples == "off" else int(a.ripples)) <= (0 if b.ripples == "off" else int(b.ripples))
    cells = [apply(rung.quality, settings()).grid.cells for rung in rungs]
    assert max(np.diff(cells)) <= 8 * 2, "rungs are so close that a budget is used"


def test_ripples_that_are_off_stay_off():
    off = dataclasses.replace(settings(), ripples=Ripples(kind="off"))
    assert all(apply(quality, off).ripples.kind == "off" for quality in QUALITIES.values())


# ------------------------------------------------------------------------------------------------- budget


def test_a_budget_buys_the_best_that_fits():
    rungs = ladder(Grid())
    taken = {rung: 0.010 + 0.001 * number for number, rung in enumerate(rungs)}
    choice = choose(rungs, lambda rung: {"products": taken[rung]}, 0.0165)
    assert choice.rung is rungs[5], "15 ms is within 16.5 ms less 8 %, 16 ms is not"
    assert choice.fits
    assert choice.above == (rungs[6], taken[rungs[6]])
    assert "15 ms of the 16.5 ms" in choice.explain()


def test_a_budget_that_nothing_fits_says_so():
    rungs = ladder(Grid())
    choice = choose(rungs, lambda _rung: {"products": 0.010}, 0.005)
    assert choice.rung is rungs[0]
    assert not choice.fits
    assert choice.explain().startswith("Even Draft")
    assert "more than the budget of 5 ms" in choice.explain()


def test_a_budget_with_more_than_enough():
    rungs = ladder(Grid())
    choice = choose(rungs, lambda _rung: {"products": 0.010}, 1.0)
    assert choice.rung is rungs[-1]
    assert "nothing more accurate" in choice.explain()


def test_a_more_accurate_configuration_that_is_cheaper_is_taken():
    rungs = ladder(Grid())
    taken = dict.fromkeys(rungs, 0.010) | {rungs[3]: 0.1}
    assert choose(rungs, lambda rung: {"products": taken[rung]}, 0.02).rung is rungs[-1]


# ------------------------------------------------------------------------------------------------- planned


def test_planned_work_is_that_of_the_plan():
    facts = Facts(engine="CYCLES", final=False)
    work = planned_work(facts, settings(cells=64, levels=3), None)
    assert work.normals > 0.0  # the plan shades with wave normals
    assert work.vectors == 2.0 + 1 / 3, "positions, normals and foam, which is one number instead of three"
    assert work.foam_floats == Foam().memory_steps * work.vertices
    without = dataclasses.replace(settings(cells=64, levels=3), effects=Effects(analytic_normals="off"))
    assert planned_work(facts, without, None).normals == 0.0
    assert planned_work(facts, without, None).floats == 3 * Grid(cells=64, levels=3).vertex_count
    foamless = dataclasses.replace(settings(cells=64, levels=3), effects=Effects(foam="off"))
    bare = planned_work(facts, foamless, None)
    assert (bare.foam_multiplications, bare.foam_floats, bare.foam_instants, bare.vectors) == (0.0, 0.0, 0.0, 2.0)


def test_stages_have_names_for_people():
    assert all(stage.label for stage in model.STAGES.values())
