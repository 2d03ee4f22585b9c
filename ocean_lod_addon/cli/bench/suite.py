# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole measurement, printed as it goes on."""

import time
from dataclasses import dataclass

from ...core.lod import Grid
from ...core.sea import Sea
from . import measurements, report, shading, targets
from .correctness import Correctness, measure_correctness
from .machine import Machine, disturbance, load_average, this_machine
from .measurements import Plan, RippleImages, Row, Scaling, ViewResult
from .shading import ShadingResult
from .targets import Target
from .timing import Timing

_SCHEMA_VERSION = 1


@dataclass(frozen=True, eq=False)
class Results:
    """Everything that was measured; `menu_ocean` and `shading` only with Blender."""

    machine: Machine
    contraction: str
    load_average: float | None
    rows: list[Row]
    scaling: Scaling
    views: list[ViewResult]
    correctness: Correctness
    ripples: list[RippleImages]
    menu_ocean: Timing | None
    shading: ShadingResult | None
    targets: list[Target]

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "schema_version": _SCHEMA_VERSION,
            "machine": self.machine.as_mapping(),
            "contraction": self.contraction,
            "load_average_at_end": self.load_average,
            "rows": [row.as_mapping() for row in self.rows],
            "scaling": self.scaling.as_mapping(),
            "views": [view.as_mapping() for view in self.views],
            "correctness": self.correctness.as_mapping(),
            "ripples": [images.as_mapping() for images in self.ripples],
            "menu_ocean": self.menu_ocean and self.menu_ocean.as_mapping(),
            "shading": self.shading and self.shading.as_mapping(),
            "targets": [target.as_mapping() for target in self.targets],
        }


def measure_and_print(plan: Plan, contraction: str, with_blender: bool) -> Results:
    """Measure a plan; the table's rows and the other results are printed as soon as they are known."""
    started = time.perf_counter()
    machine = this_machine(with_blender)
    print(f"{machine}; matrix products by {contraction}\n\n{report.LEGEND}\n\n{report.header()}", flush=True)
    rows = []
    for cells, wave_counts in plan.groups:
        group = measurements.measure_group(plan, cells, wave_counts, contraction, with_blender)
        print("\n".join(report.line(row) for row in group), flush=True)
        rows += group
    _print_section("Memory", report.memory_lines(rows))

    scaling = measurements.measure_scaling(plan, contraction)
    _print_section("Time of a surface", report.scaling_lines(scaling))

    views = measurements.measure_views(plan, contraction)
    view_lines = [line for view in views for line in report.view_lines(view)]
    _print_section("A plane to the horizon under a 35 mm lens at 1.7 m", view_lines)

    correctness = measure_correctness(plan.swim_frames, plan.swim_grid, contraction)
    _print_section("What must be right", report.correctness_lines(correctness))

    ripples = measurements.measure_ripples(plan, with_blender)
    _print_section("The ripple images of a frame", report.ripple_lines(ripples))

    menu_ocean = measurements.measure_menu_ocean(plan) if with_blender else None
    if menu_ocean is not None:
        title = f"The ocean of the Add menu ({Grid().vertex_count} vertices, {Sea().wave_count} waves)"
        _print_section(title, [report.menu_ocean_line(menu_ocean)])

    in_renders = shading.measure_shading(plan.shading) if with_blender else None
    if in_renders is not None:
        _print_section("Milliseconds per sample of a million pixels", report.shading_lines(in_renders))

    reached = [
        *targets.frame_targets(rows, contraction),
        *targets.scaling_targets(scaling),
        *targets.culling_targets(views),
        *targets.correctness_targets(correctness),
    ]
    _print_section("Targets", report.target_lines(reached))
    if disturbance():
        print(f"\n{disturbance()}")
    print(f"\nmeasured in {time.perf_counter() - started:.0f} s", flush=True)
    return Results(
        machine,
        contraction,
        load_average(),
        rows,
        scaling,
        views,
        correctness,
        ripples,
        menu_ocean,
        in_renders,
        reached,
    )


def _print_section(title, lines):
    print(f"\n{title}", *lines, sep="\n", flush=True)
