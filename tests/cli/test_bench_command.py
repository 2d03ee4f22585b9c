# SPDX-License-Identifier: GPL-3.0-or-later
"""The bench command: that what it measures is the right thing, that its sums are right, and its bad input.

No test here asserts how long anything takes.
"""

import contextlib
import dataclasses
import io
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ocean_lod_addon.cli import bench
from ocean_lod_addon.cli.bench import (
    correctness,
    in_blender,
    measurements,
    plot,
    report,
    shading,
    suite,
    workloads,
)
from ocean_lod_addon.cli.bench.shading import GLOSSY, MATERIALS, RIPPLES, WATER, EnginePlan, ShadingResult
from ocean_lod_addon.cli.bench.targets import MISS, NOT_MEASURED, PASS, Target
from ocean_lod_addon.cli.bench.timing import Contestant, Ratio, Timing, measure, ratio
from ocean_lod_addon.core.contraction import CONTRACTIONS, Product
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.lod import Grid, Topology, topology
from ocean_lod_addon.nodes.material import NODE_NAME
from ocean_lod_addon.nodes.ripples_material import RIPPLES_NODE_NAME

REPOSITORY = Path(__file__).parents[2]
BAD_INPUT = 2

TINY = measurements.Plan(
    groups=((128, (16, 32)),),
    scaling_cells=(256, 512),
    scaling_waves=(64, 128),
    largest_direct_sum=3e5,  # 16 waves on 129^2 vertices, not 32
    square_sizes=(64, 128),
    view_grid=Grid(cells=32, levels=3),
    swim_grid=Grid(cells=64, levels=6),
    swim_frames=3,
    shading=(EnginePlan("CYCLES", (16, 9), 2, rounds=1),),
    rounds=1,
)


# ---------------------------------------------------------------------------------- what is measured


def test_every_way_to_make_the_square_gives_the_same_sea():
    # Truth: the corrected Eq. 2 in float64. With all windows 1 the frame is that sum up to float32 rounding of
    # 2 x 16 terms; the direct sums are it in the precision that their name says.
    workload = workloads.square(128, 16)
    lines = workload.grid.lines(0)
    x, y = np.meshgrid(lines, lines, indexing="ij")
    truth = surface_points(workload.waves, x, y, 3.0).position
    height = np.sqrt(8.0 * np.sum(workload.waves.amplitude**2))  # significant, 4 sqrt(m0)

    for dtype, tolerance in ((np.float64, 1e-12), (np.float32, 1e-5)):
        direct = workloads.DirectSum(workload, dtype)
        direct.evaluate(3.0)
        assert direct.positions.dtype == dtype
        np.testing.assert_allclose(direct.positions, truth, rtol=0.0, atol=tolerance * height)


def test_no_wave_is_spared_in_the_square():
    # Windows of the square's waves reach past its edge but begin to fall inside it, so the positions are not the
    # full sum there; the work is: every product takes all waves, 2 W + 2 columns of the left factor.
    workload = workloads.square(128, 16)
    frame = workloads.Frame(workload, "matmul", workloads.position_buffer(workload.grid))
    products = frame.products()
    assert sum(product.out.size for product in products) == 3 * 129**2
    assert {product.left.shape[1] for product in products} == {2 * 16 + 2}
    assert workloads.product_flops(products) == 2 * 3 * 129**2 * (2 * 16 + 2)


def test_without_a_blas_the_square_is_mirrored():
    # The middle line has no image. U and V take a row for each wave, one more for each that fades, and 2.
    workload = workloads.square(128, 16)
    frame = workloads.Frame(workload, "einsum", workloads.position_buffer(workload.grid))
    products = frame.products()
    assert sum(product.out.size for product in products) == 3 * 129 * 65
    assert sum(product.mirrored.size for product in products) == 3 * 129 * 64
    (inner,) = {left.shape[1] for product in products for left in product.left}
    assert 16 + 2 <= inner < 2 * 16 + 2
    assert workloads.product_flops(products) == 2 * 2 * 3 * 129 * 65 * inner


def test_the_products_alone_write_what_the_frame_writes():
    workload = workloads.horizon(256, 32)
    frame = workloads.Frame(workload, "matmul", workloads.position_buffer(workload.grid))
    frame.evaluate(0.0)
    expected = frame.positions.copy()
    contestant = workloads.products_contestant("products", frame.products(), "matmul")
    frame.positions[:] = np.nan
    contestant.parts["products"](0.0)
    np.testing.assert_array_equal(frame.positions, expected)


@pytest.mark.parametrize("cells", [512, 1024])
def test_the_horizon_has_about_as_many_vertices_as_the_square(cells):
    # The grid's cells come in multiples of 8, which moves the count by 1 % at most.
    vertices = workloads.horizon(cells, 8).grid.vertex_count
    assert vertices == pytest.approx((cells + 1) ** 2, rel=0.01)
    assert vertices > (cells + 1) ** 2, "a comparison with as many vertices must not favour us"


def test_pieces_of_a_product_make_the_whole():
    # The sum over waves is not cut, so each element is summed in the same order: equal bits, whatever the pieces.
    generator = np.random.Generator(np.random.PCG64(1))
    left, right = generator.random((300, 70), np.float32), generator.random((70, 900), np.float32)
    out = np.empty((300, 900), np.float32)
    CONTRACTIONS["einsum"].multiply([Product(left, right, out)])
    np.testing.assert_array_equal(out, np.einsum("ij,jk->ik", left, right))


def test_allocation_counts_what_is_held_at_once():
    def part(_time):
        first = np.ones(100_000)  # 800 kB
        del first
        return np.ones(50_000)

    allocated = workloads.allocated_while_running([part])
    assert 800_000 <= allocated < 850_000


def test_memory_counts_what_is_kept():
    assert 800_000 <= workloads.kept_by_building(lambda: np.ones(100_000)) < 850_000


def test_the_camera_looks_along_x_at_eye_height():
    # 36 mm wide sensor, 35 mm lens: half the frame's width is 18/35 of the distance.
    view = workloads.level_camera(5.0)
    np.testing.assert_array_equal(view.position, [5.0, 0.0, 1.7])
    assert view.extent[1] == 18.0 / 35.0
    np.testing.assert_array_equal(np.cross(view.axes[0], view.axes[1]), -view.axes[2])


# ---------------------------------------------------------------------------------- in Blender


def test_the_ocean_modifier_has_as_many_vertices_and_moves():
    with in_blender.fresh_data():
        contestant = in_blender.ocean_modifier("peer", "GENERATE", 128)  # raises if the count differs
        contestant.parts["modifier"](1.0)


def test_our_object_ends_up_where_the_frame_says():
    import bpy

    workload = workloads.square(128, 16)
    with in_blender.fresh_data():
        before = set(bpy.data.objects)
        ours = in_blender.OurObject(workload.grid)
        frame = workloads.Frame(workload, "matmul", workloads.position_buffer(workload.grid))
        for part in ours.frame_parts(frame).values():
            part(2.0)
        (ob,) = set(bpy.data.objects) - before
        depsgraph = ob.users_scene[0].view_layers[0].depsgraph
        found = np.empty(3 * 129**2, np.float32)
        ob.evaluated_get(depsgraph).data.attributes["position"].data.foreach_get("vector", found)
        np.testing.assert_array_equal(found.reshape(-1, 3), frame.positions)
        # 12 positions, and at least 8 for each of 2 edges and 16 + 16 for 4 corners of a quad per vertex
        assert ours.mesh_bytes() > 60 * 129**2


def test_nothing_is_left_in_the_file():
    import bpy

    kinds = ("objects", "meshes", "scenes", "materials", "node_groups", "images", "cameras", "worlds")
    before = {kind: set(getattr(bpy.data, kind)) for kind in kinds}
    with in_blender.fresh_data():
        in_blender.menu_ocean().parts["handler"](1.0)
        shading.build()
    assert {kind: set(getattr(bpy.data, kind)) for kind in kinds} == before


def test_the_materials_share_a_mesh_and_keep_their_places():
    import bpy

    with in_blender.fresh_data():
        scene, materials = shading.build()
        (ob,) = [ob for ob in scene.objects if ob.type == "MESH"]
        worn = []
        for put_on in materials.values():
            put_on(0.0)
            bpy.ops.render.render(scene=scene.name)  # the frame's handlers must not change what is worn
            worn.append(ob.data.materials[0])
        kinds = [{node.bl_idname for node in material.node_tree.nodes} for material in worn]
        assert kinds[0] == {"ShaderNodeBsdfAnisotropic", "ShaderNodeOutputMaterial"}  # Glossy
        names = [{node.name for node in material.node_tree.nodes} for material in worn]
        assert all(NODE_NAME in found for found in names[1:])
        assert [RIPPLES_NODE_NAME in found for found in names] == [name == RIPPLES for name in materials]
        assert list(materials) == list(MATERIALS)[: len(materials)]


# ---------------------------------------------------------------------------------- times and verdicts


def timing(**parts):
    return Timing(tuple(parts), np.array(list(zip(*parts.values(), strict=True)), dtype=float))


def test_medians_and_minima_are_of_whole_runs():
    # Sums of the runs are 11, 7, 6: median 7, fastest 6; without b they are 1, 5, 3.
    measured = timing(a=[1, 5, 3], b=[10, 2, 3])
    assert (measured.median(), measured.minimum()) == (7.0, 6.0)
    assert (measured.median("b"), measured.minimum("b")) == (3.0, 1.0)
    assert measured.part("b") == 3.0
    assert ratio(measured, timing(c=[2, 2, 1]), above_without=("b",)) == Ratio(1.5, 1.0)
    assert measured.as_mapping()["median_ms"] == 7000.0


def test_contestants_take_turns_with_a_new_moment_each_time():
    calls = []

    def part(name):
        return {name: lambda time: calls.append((name, time))}

    contestants = [Contestant("one", part("a") | part("b")), Contestant("two", part("c"))]
    with contextlib.redirect_stdout(io.StringIO()):
        measured = measure(contestants, rounds=2)
    order = [name for name, _ in calls if name != "b"]
    assert order == ["a"] * 10 + ["c"] * 10 + ["a"] * 10 + ["c"] * 10  # one untimed run, then nine
    moments = [time for name, time in calls if name != "b"]
    assert len(set(moments)) == len(moments), "the same moment twice"
    assert measured["one"].samples.shape == (18, 2)
    assert measured["two"].samples.shape == (18, 1)


@pytest.mark.parametrize(
    ("at_most", "measured", "verdict"),
    [
        (True, Ratio(1.2, 9.0), PASS),
        (True, Ratio(1.3, 0.1), MISS),
        (False, Ratio(1.3, 0.1), PASS),
        (False, Ratio(1.2, 9.0), MISS),
        (True, None, NOT_MEASURED),
    ],
)
def test_verdicts_go_by_the_medians(at_most, measured, verdict):
    assert Target("text", 1.25, at_most, measured).verdict == verdict


def test_the_share_of_the_best_rate_compares_operations_per_second():
    # 8e9 operations in 2 s are 4e9/s; 1000^3 x 2 operations in 0.25 s are 8e9/s and in 1 s 2e9/s: half the best.
    row = measurements.Row(
        workloads.SQUARE,
        512,
        513**2,
        128,
        8e9,
        {
            measurements.PRODUCTS: timing(products=[2.0]),
            "square product 1000": timing(products=[0.25]),
            "square product 100": timing(products=[1.0]),
        },
        0,
        0,
        None,
    )
    assert row.share_of_best_rate == Ratio(0.5, 0.5)


def test_a_sample_costs_what_more_samples_add():
    # 17 samples take 2.0 s, one 0.4 s: a sample is a tenth of a second, whatever comes before the first.
    measured = timing(**{"put on": [9.0], "few": [0.4], "many": [2.0]})
    assert shading.sample_seconds(measured, 17) == pytest.approx(0.1)
    result = ShadingResult({"CYCLES": {GLOSSY: 2e-7, WATER: 5e-7}})
    assert result.over_glossy("CYCLES", WATER) == pytest.approx(2.5)
    assert report.shading_lines(result) == ["  CYCLES: glossy 200, water 500 (2.50 times)"]


# ---------------------------------------------------------------------------------- the command


@pytest.fixture(scope="module")
def tiny():
    """Results of a tiny plan and what was printed meanwhile, on the contraction that this NumPy does not use."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        results = suite.measure_and_print(TINY, "einsum", with_blender=True)
    return results, printed.getvalue()


def test_the_table_has_a_row_for_every_case(tiny):
    results, printed = tiny
    assert [(row.vertices, row.waves) for row in results.rows] == [(129**2, 16), (129**2, 32)]
    assert results.rows[0].timings.keys() - results.rows[1].timings.keys() == set(measurements.DIRECT.values())
    assert measurements.GENERATE in results.rows[1].timings
    table = [line.split() for line in printed.splitlines() if line.split()[:2] == ["square", "16641"]]
    assert [row[2] for row in table] == ["16", "32"]


def test_the_saved_results_are_plain_json(tiny):
    results, _ = tiny
    saved = json.loads(json.dumps(results.as_mapping()))
    assert saved["schema_version"] == 1
    assert saved["shading"]["CYCLES"][GLOSSY]["over_glossy"] == 1.0
    assert saved["rows"][0]["timings"]["products"]["median_ms"] > 0.0
    assert {target["verdict"] for target in saved["targets"]} <= {PASS, MISS}
    assert saved["correctness"]["swim"]["frames"] == 3
    assert [images["pixels"] for images in saved["ripples"]] == [256, 512, 1024, 2048]
    assert all(set(images["timing"]["parts_median_ms"]) == {"images", "write"} for images in saved["ripples"])
    assert [view["vertices"] for view in saved["views"]] == [Grid(cells=32, levels=3).vertex_count] * 2
    assert all(f"{target['target']}" in tiny[1] for target in saved["targets"])


def test_a_plane_with_a_hole_has_a_gap_and_a_folded_one_an_overlap(monkeypatch):
    """The measure sees what it is to rule out."""
    whole = correctness.measure_seams(16, 3)
    assert (whole.levels, whole.offsets, whole.gap, whole.overlap) == (3, 16, 0.0, 0.0)
    faces = topology(16, 3)
    area = (2.0 * Grid(1.0, 16, 3).half_extent) ** 2
    torn = Topology(faces.vertex_count, faces.triangles, faces.quads[1:])
    monkeypatch.setattr(correctness, "topology", lambda *_: torn)
    assert correctness.measure_seams(16, 3).gap == 1.0 / area
    turned = Topology(faces.vertex_count, faces.triangles, np.vstack([faces.quads[:1, ::-1], faces.quads[1:]]))
    monkeypatch.setattr(correctness, "topology", lambda *_: turned)
    assert correctness.measure_seams(16, 3).overlap == 1.0 / area


def test_heights_are_as_exact_far_and_late():
    found = correctness.measure_precision("matmul")
    assert 0.0 < found.at_origin < 2e-6
    assert 0.0 < found.far_and_late < 2e-6


def test_the_plot_shows_the_rows(tiny, tmp_path):
    results, _ = tiny
    rows = [dataclasses.replace(row, cells=512, waves=128) for row in results.rows]
    assert plot.save_plot(rows, "caption", tmp_path / "bench.png")
    assert (tmp_path / "bench.png").read_bytes().startswith(b"\x89PNG")


def run(*arguments, cwd):
    return subprocess.run(
        [sys.executable, "-m", "ocean_lod_addon", "bench", *map(str, arguments)],
        cwd=cwd,
        env=os.environ | {"PYTHONPATH": str(REPOSITORY)},
        capture_output=True,
        text=True,
        timeout=120,
    )


BAD_ARGUMENTS = [
    (["--output", "bench.txt"], "ends in '.txt', allowed is .json"),
    (["--output", "/proc/nowhere/bench.json"], "can not be written"),
    (["--contraction", "guess"], "invalid choice: 'guess'"),
    (["--numpy-without-blas", "nowhere/python"], "nowhere/python: can not be run"),
    (["--numpy-without-blas", sys.executable], "its NumPy has a BLAS"),
]


@pytest.mark.parametrize(("arguments", "line"), BAD_ARGUMENTS, ids=[case[1] for case in BAD_ARGUMENTS])
def test_bad_arguments_give_one_clear_line_before_anything_is_measured(arguments, line, tmp_path):
    done = run(*arguments, cwd=tmp_path)
    assert done.returncode == BAD_INPUT
    assert line in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1, done.stderr
    assert done.stdout == ""
    assert list(tmp_path.iterdir()) == []


def test_an_interpreter_without_numpy_is_refused(tmp_path):
    bare = tmp_path / "bare"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", bare], check=True, timeout=120)
    done = run("--numpy-without-blas", bare / "bin" / "python", cwd=tmp_path)
    assert done.returncode == BAD_INPUT
    assert "can not be used: ModuleNotFoundError: No module named 'numpy'" in done.stderr


def test_the_default_output_is_where_make_bench_says():
    import argparse

    parser = argparse.ArgumentParser()
    bench.add_arguments(parser)
    assert parser.parse_args([]).output == "out/bench.json"
