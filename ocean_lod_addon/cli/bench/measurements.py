# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured side by side, and the results."""

import contextlib
import dataclasses
from dataclasses import dataclass

import numpy as np

from ...core.lod import Grid
from ...core.ocean import Ocean, Surface
from ...core.parameters import parameters_of
from ...core.ripple_settings import Ripples
from ...core.sea import Sea, WaveSystem
from ..swim import SHOT_GRID
from . import in_blender, shading, workloads
from .shading import EnginePlan
from .timing import Contestant, Ratio, Timing, measure, ratio

UPDATE, FRAME, EINSUM = "update", "frame in Blender", "frame in Blender, einsum"
PRODUCTS = "products"
DIRECT = {np.float32: "direct sum, float32", np.float64: "direct sum, float64"}
GENERATE, DISPLACE = "ocean modifier, generate", "ocean modifier, displace"

TARGET_CASES = ((512, 128), (1024, 256))
"""(Cells along a side of a square, waves) that the targets speak of: 263 k and 1.05 M vertices."""

FAR_TIME = 1e6
"""s; where phases that were kept in float32 would have lost the waves."""


VIEW_GRID = Grid(cell_size=0.03, cells=520, levels=12)
"""2.5 million cells, for what leaving out the cells out of view saves."""


@dataclass(frozen=True)
class Plan:
    """How much is measured.

    `scaling_...` are cells along a side and waves, each twice the one before, with 512 and 128 among them: one
    number changes while the other is that.
    """

    groups: tuple[tuple[int, tuple[int, ...]], ...]  # cells along a side, and the numbers of waves
    scaling_cells: tuple[int, ...]
    scaling_waves: tuple[int, ...]
    largest_direct_sum: float  # vertices times waves
    square_sizes: tuple[int, ...]  # of the products whose fastest counts as the machine's best rate
    view_grid: Grid
    swim_grid: Grid
    swim_frames: int
    shading: tuple[EnginePlan, ...]
    rounds: int


QUICK = Plan(
    groups=((128, (128,)), (256, (128,)), (512, (16, 64, 128, 256, 512)), (1024, (128, 256))),
    scaling_cells=(256, 512, 1024),
    scaling_waves=(64, 128, 256),
    largest_direct_sum=4e7,
    square_sizes=(384, 512, 1024, 2048),
    view_grid=VIEW_GRID,
    swim_grid=SHOT_GRID,
    swim_frames=200,
    shading=shading.QUICK,
    rounds=7,
)
FULL = Plan(
    groups=tuple((cells, (16, 32, 64, 128, 256, 512)) for cells in (128, 256, 512, 1024, 2048)),
    scaling_cells=(256, 512, 1024, 2048),
    scaling_waves=(32, 64, 128, 256, 512),
    largest_direct_sum=3e8,
    square_sizes=(384, 512, 1024, 2048),
    view_grid=VIEW_GRID,
    swim_grid=SHOT_GRID,
    swim_frames=200,
    shading=shading.FULL,
    rounds=9,
)


@dataclass(frozen=True, eq=False)
class Row:
    """One plane and number of waves, and everything measured beside it; timings by the names above."""

    kind: str  # workloads.SQUARE or HORIZON
    cells: int  # of the group's square
    vertices: int
    waves: int
    flops: float
    timings: dict[str, Timing]
    allocated: int  # bytes, while one frame is made
    kernel_bytes: int  # kept from frame to frame
    mesh_bytes: int | None  # in Blender

    @property
    def share_of_best_rate(self) -> Ratio:
        """Rate of the products over the best rate of square ones, by medians and by fastest runs."""
        products = self.timings[PRODUCTS]
        of_medians, of_minima = workloads.best_rate(self.timings)
        return Ratio(self.flops / products.median() / of_medians, self.flops / products.minimum() / of_minima)

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "plane": self.kind,
            "vertices": self.vertices,
            "waves": self.waves,
            "timings": {name: timing.as_mapping() for name, timing in self.timings.items()},
            "products_gflops": self.flops / self.timings[PRODUCTS].median() / 1e9,
            "best_square_gflops": workloads.best_rate(self.timings)[0] / 1e9,
            "allocated_per_frame_bytes": self.allocated,
            "kernel_bytes_per_vertex": self.kernel_bytes / self.vertices,
            "mesh_bytes_per_vertex": None if self.mesh_bytes is None else self.mesh_bytes / self.vertices,
        }


def measure_group(plan: Plan, cells: int, wave_counts, contraction: str, with_blender: bool) -> list[Row]:
    """Rows for about (cells + 1)^2 vertices, everything in turns; the Ocean modifier is the same for all."""
    planes = [workloads.square(cells, count) for count in wave_counts]
    planes += [workloads.horizon(cells, count) for count in wave_counts if (cells, count) in TARGET_CASES]
    with in_blender.fresh_data() if with_blender else contextlib.nullcontext():
        homes = {}
        for workload in planes:
            if workload.kind not in homes:
                homes[workload.kind] = _Home(workload.grid, with_blender)
        cases = [_Case(plan, cells, workload, contraction, homes[workload.kind]) for workload in planes]
        shared = workloads.square_products(contraction, plan.square_sizes)
        if with_blender:
            shared.append(in_blender.ocean_modifier(GENERATE, "GENERATE", cells))
            if cells == in_blender.DISPLACE_CELLS:
                shared.append(in_blender.ocean_modifier(DISPLACE, "DISPLACE", cells))
        timings = measure([*(c for case in cases for c in case.named_contestants()), *shared], plan.rounds)
        common = {contestant.name: timings[contestant.name] for contestant in shared}
        return [case.row(timings, common) for case in cases]


class _Home:
    """Where the positions of a grid go: memory, and with Blender an object."""

    def __init__(self, grid, with_blender):
        self.positions = workloads.position_buffer(grid)
        self.ours = in_blender.OurObject(grid) if with_blender else None

    def frame_parts(self, frame):
        """The parts of a frame, as far as there are any after the surface."""
        return {"surface": frame.evaluate} if self.ours is None else self.ours.frame_parts(frame)


class _Case:
    """One plane and number of waves in a group."""

    def __init__(self, plan, cells, workload, contraction, home):
        self._cells, self._workload, self._home = cells, workload, home
        frame = workloads.Frame(workload, contraction, home.positions)
        products = frame.products()
        self._flops = workloads.product_flops(products)
        in_frame = home.frame_parts(frame)
        self._update_parts = {name: part for name, part in in_frame.items() if name != in_blender.DEPSGRAPH}
        self._contestants = [
            Contestant(UPDATE, self._update_parts),
            workloads.products_contestant(PRODUCTS, products, contraction),
            Contestant(FRAME, in_frame),
        ]
        count = len(workload.waves)
        if contraction != "einsum" and (cells, count) in TARGET_CASES:
            by_einsum = workloads.Frame(workload, "einsum", home.positions)
            self._contestants.append(Contestant(EINSUM, home.frame_parts(by_einsum)))
        if workload.kind == workloads.SQUARE and (cells + 1) ** 2 * count <= plan.largest_direct_sum:
            for dtype, name in DIRECT.items():
                direct = workloads.DirectSum(workload, dtype)
                self._contestants.append(Contestant(name, {"sum": direct.evaluate}))
        self._kernel_bytes = workloads.kept_by_building(
            lambda: workloads.Frame(workload, contraction, home.positions)
        )

    def named_contestants(self):
        """The contestants, with names that tell the cases of a group apart."""
        return [dataclasses.replace(c, name=self._name(c)) for c in self._contestants]

    def _name(self, contestant):
        return f"{self._workload.kind}, {len(self._workload.waves)} waves: {contestant.name}"

    def row(self, timings, common):
        """The case's results out of those of its group."""
        ours = self._home.ours
        return Row(
            self._workload.kind,
            self._cells,
            len(self._home.positions),
            len(self._workload.waves),
            self._flops,
            {contestant.name: timings[self._name(contestant)] for contestant in self._contestants} | common,
            workloads.allocated_while_running(self._update_parts.values()),
            self._kernel_bytes,
            None if ours is None else ours.mesh_bytes(),
        )


@dataclass(frozen=True)
class Step:
    """What a surface costs over another with fewer vertices or waves, `factor` times."""

    text: str
    factor: int
    ratio: Ratio

    @property
    def exponent(self) -> float:
        """Power of the number of vertices or waves that the time grows with."""
        return float(np.log(self.ratio.of_medians) / np.log(self.factor))


@dataclass(frozen=True)
class Scaling:
    """How the time of a surface grows, and what a late time costs over an early one."""

    vertex_steps: tuple[Step, ...]
    wave_steps: tuple[Step, ...]
    late_over_early: Ratio

    @property
    def steps(self) -> tuple[Step, ...]:
        """All of them."""
        return (*self.vertex_steps, *self.wave_steps)

    def as_mapping(self) -> dict:
        """For the saved file."""
        steps = {step.text: {"ratio": step.ratio.of_medians, "exponent": step.exponent} for step in self.steps}
        return {"steps": steps, "late_over_early": self.late_over_early.of_medians}


_SCALING_WAVES, _SCALING_CELLS = 128, 512


def measure_scaling(plan: Plan, contraction: str) -> Scaling:
    """Surfaces of different sizes, in turns."""
    cases = [(cells, _SCALING_WAVES) for cells in plan.scaling_cells]
    cases += [(_SCALING_CELLS, waves) for waves in plan.scaling_waves if waves != _SCALING_WAVES]
    frames = {}
    for case in cases:
        workload = workloads.square(*case)
        frames[case] = workloads.Frame(workload, contraction, workloads.position_buffer(workload.grid))
    contestants = [Contestant(str(case), {"surface": frame.evaluate}) for case, frame in frames.items()]
    middle = frames[_SCALING_CELLS, _SCALING_WAVES]
    contestants.append(Contestant("late", {"surface": lambda time: middle.evaluate(FAR_TIME + time)}))
    timings = measure(contestants, plan.rounds)

    def over(above, below):
        return ratio(timings[str(above)], timings[str(below)])

    return Scaling(
        tuple(
            Step(
                f"{(small + 1) ** 2} to {(large + 1) ** 2} vertices, {_SCALING_WAVES} waves",
                4,
                over((large, _SCALING_WAVES), (small, _SCALING_WAVES)),
            )
            for small, large in zip(plan.scaling_cells[:-1], plan.scaling_cells[1:], strict=True)
        ),
        tuple(
            Step(
                f"{few} to {many} waves, {(_SCALING_CELLS + 1) ** 2} vertices",
                2,
                over((_SCALING_CELLS, many), (_SCALING_CELLS, few)),
            )
            for few, many in zip(plan.scaling_waves[:-1], plan.scaling_waves[1:], strict=True)
        ),
        over("late", (_SCALING_CELLS, _SCALING_WAVES)),
    )


@dataclass(frozen=True, eq=False)
class ViewResult:
    """A plane to the horizon under a camera; timings by the names of workloads.view_case."""

    sea: str
    vertices: int
    waves: int
    share_in_view: float
    timings: dict[str, Timing]

    @property
    def saved(self) -> Ratio:
        """Time of the whole plane over that of what is in view."""
        return ratio(self.timings[workloads.WHOLE], self.timings[workloads.IN_VIEW])

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "sea": self.sea,
            "vertices": self.vertices,
            "waves": self.waves,
            "share_of_vertices_in_view": self.share_in_view,
            "timings": {name: timing.as_mapping() for name, timing in self.timings.items()},
        }


_VIEW_WAVES = 256

_VIEW_SEAS = {"wind 5 m/s, crests below the lens": 5.0, "wind 10 m/s, crests above the lens": 10.0}
"""Waves carry what is near a low camera into its view, so that the less can be left out the higher they are."""


def measure_views(plan: Plan, contraction: str) -> list[ViewResult]:
    """A plane to the horizon: whole, with a moving camera, and only what is in view; in a low and a high sea."""
    results = []
    for name, wind in _VIEW_SEAS.items():
        sea = Sea(systems=(WaveSystem(wind_speed=wind),), wave_count=_VIEW_WAVES)
        case = workloads.view_case(plan.view_grid, sea, contraction)
        timings = measure(case.contestants, plan.rounds)
        results.append(
            ViewResult(name, case.surface.vertex_count, len(case.surface.waves), case.share_in_view, timings)
        )
    return results


@dataclass(frozen=True, eq=False)
class RippleImages:
    """The ripple images of one frame: how many, of how many pixels a side, and what they take."""

    texels: int
    images: int
    timing: Timing

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {"pixels": self.texels, "images": self.images, "timing": self.timing.as_mapping()}


def measure_ripples(plan: Plan, with_blender: bool) -> list[RippleImages]:
    """The images at each resolution that the ripples have, written into Blender's if there is one."""
    bumps = {
        option.key: Surface(Ocean(ripples=Ripples(resolution=option.key))).bump
        for option in parameters_of(Ripples)["resolution"].options
    }
    contestants = []
    with in_blender.fresh_data() if with_blender else contextlib.nullcontext():
        for name, bump in bumps.items():
            pixels = [np.empty((tile.texels, tile.texels, 4), np.float32) for tile in bump.layout.tiles]
            contestant = workloads.ripple_images(name, pixels, bump)
            contestants.append(in_blender.writing_images(contestant, pixels) if with_blender else contestant)
        timings = measure(contestants, plan.rounds)
    return [
        RippleImages(bump.layout.tiles[0].texels, len(bump.layout.tiles), timings[name])
        for name, bump in bumps.items()
    ]


def measure_menu_ocean(plan: Plan) -> Timing:
    """The ocean that the menu adds, in Blender."""
    with in_blender.fresh_data():
        contestant = in_blender.menu_ocean()
        return measure([contestant], plan.rounds)[contestant.name]
