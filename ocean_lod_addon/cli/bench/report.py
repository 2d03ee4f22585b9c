# SPDX-License-Identifier: GPL-3.0-or-later
"""The results as text for the terminal."""

from . import workloads
from .correctness import Correctness
from .in_blender import DEPSGRAPH, WRITE
from .measurements import (
    DIRECT,
    DISPLACE,
    EINSUM,
    FRAME,
    GENERATE,
    PRODUCTS,
    UPDATE,
    RippleImages,
    Row,
    Scaling,
    ViewResult,
)
from .shading import GLOSSY, ShadingResult
from .targets import NOT_MEASURED, Target
from .timing import Timing
from .workloads import IMAGES

_NOTHING, _WIDTH = "-", 9

_COLUMNS = (
    ("plane", lambda row: row.kind),
    ("vertices", lambda row: str(row.vertices)),
    ("waves", lambda row: str(row.waves)),
    ("surface", lambda row: _part(row, "surface")),
    ("write", lambda row: _part(row, WRITE)),
    ("update", lambda row: _time(row, UPDATE)),
    ("products", lambda row: _time(row, PRODUCTS)),
    ("GFLOP/s", lambda row: f"{row.flops / row.timings[PRODUCTS].median() / 1e9:.0f}"),
    ("of best", lambda row: f"{100 * row.share_of_best_rate.of_medians:.0f} %"),
    ("frame", lambda row: _time(row, FRAME)),
    ("einsum", lambda row: _time(row, EINSUM)),
    *(
        (name.replace("direct sum, float", "sum f"), lambda row, name=name: _time(row, name))
        for name in DIRECT.values()
    ),
    ("generate", lambda row: _time(row, GENERATE)),
    ("displace", lambda row: _time(row, DISPLACE)),
)

LEGEND = """\
Milliseconds, medians.
plane     square: one level with every wave on every vertex; horizon: out to the horizon, as in a shot
update    surface (the positions of all vertices) + write (into the mesh)
products  the matrix products in the surface by themselves; of best: their rate over that of the best square one
frame     the same update in Blender, with Blender's evaluation of the object
einsum    the frame as a NumPy without BLAS makes it
sum       a plain NumPy sum over the waves
generate, displace: Blender's Ocean modifier with as many vertices, with Blender's evaluation of its object"""


def header() -> str:
    """The line above the rows."""
    return "".join(f"{name:>{_WIDTH}}" for name, _ in _COLUMNS)


def line(row: Row) -> str:
    """One row of the table."""
    return "".join(f"{value(row):>{_WIDTH}}" for _, value in _COLUMNS)


def _time(row, name):
    timing = row.timings.get(name)
    return _NOTHING if timing is None else _milliseconds(timing.median())


def _part(row, part):
    timing = row.timings[UPDATE]
    return _milliseconds(timing.part(part)) if part in timing.parts else _NOTHING


def _milliseconds(seconds):
    value = 1e3 * seconds
    return f"{value:.2f}" if value < 10.0 else f"{value:.1f}" if value < 100.0 else f"{value:.0f}"


def scaling_lines(scaling: Scaling) -> list[str]:
    """How a surface's time grows."""
    return [
        *(
            f"  {step.text}: {step.ratio.of_medians:.2f} times, exponent {step.exponent:.2f}"
            for step in scaling.steps
        ),
        f"  at t = 1e6 s instead of 0: {scaling.late_over_early.of_medians:.2f} times",
    ]


def view_lines(view: ViewResult) -> list[str]:
    """The plane under a camera."""
    return [
        f"  {view.sea}; {view.vertices} vertices, {100 * view.share_in_view:.0f} % in view; {view.waves} waves",
        *(
            f"    {name}: {_milliseconds(view.timings[name].median())} ms"
            for name in (workloads.WHOLE, workloads.MOVING, workloads.IN_VIEW)
        ),
    ]


def correctness_lines(correctness: Correctness) -> list[str]:
    """Swim, seams and precision."""
    swim, seams, precision = correctness.swim, correctness.seams, correctness.precision
    return [
        f"  swim of a dolly and 90 degree pan, {swim.frames} frames, {swim.points} points: {swim.swim_max:.3%} of "
        f"{swim.significant_wave_height:.2f} m at most, {swim.swim_rms:.4%} rms",
        f"  {seams.levels} levels at {seams.offsets} offsets: gaps {seams.gap:g}, overlaps {seams.overlap:g}",
        f"  height error over significant height: {precision.at_origin:.1e} at the origin, "
        f"{precision.far_and_late:.1e} at 100 km and 1e6 s",
    ]


def ripple_lines(ripples: list[RippleImages]) -> list[str]:
    """The images at each resolution; ripples that are off have none."""
    lines = []
    for each in ripples:
        made = f"  {each.images} of {each.texels} x {each.texels}: {_milliseconds(each.timing.part(IMAGES))} ms"
        blender = f", then Blender's {_milliseconds(each.timing.part(WRITE))} ms"
        lines.append(made + (blender if WRITE in each.timing.parts else ""))
    return [*lines, "  ripples off: no image, no node, no time"]


def menu_ocean_line(timing: Timing) -> str:
    """The ocean that the menu adds."""
    handler, depsgraph = timing.part("handler"), timing.part(DEPSGRAPH)
    return f"  frame-change handler {_milliseconds(handler)} ms, then Blender {_milliseconds(depsgraph)} ms"


def shading_lines(result: ShadingResult) -> list[str]:
    """A line for each engine: what a sample costs with each material, and over a plain Glossy BSDF."""
    if not result.seconds:
        return ["  no engine renders here"]
    return [f"  {engine}: {', '.join(_materials(result, engine))}" for engine in result.seconds]


def _materials(result, engine):
    for material, seconds in result.seconds[engine].items():
        times = "" if material == GLOSSY else f" ({result.over_glossy(engine, material):.2f} times)"
        yield f"{material} {_milliseconds(1e6 * seconds)}{times}"


def memory_lines(rows: list[Row]) -> list[str]:
    """What a frame allocates and what an ocean keeps: the smallest case and the largest."""
    lines = []
    for row in (rows[0], rows[-1]):
        kept = f"{row.kernel_bytes / row.vertices:.1f} bytes of factors, 12 of positions"
        if row.mesh_bytes is not None:
            kept += f", {row.mesh_bytes / row.vertices:.1f} in Blender's mesh"
        lines.append(f"  {row.kind}, {row.vertices} vertices, {row.waves} waves")
        lines.append(f"    allocated while a frame is made: {row.allocated / 1e3:.0f} kB")
        lines.append(f"    kept per vertex: {kept}")
    return lines


def target_lines(targets: list[Target]) -> list[str]:
    """The closing table."""
    width = max(len(target.text) for target in targets)
    return [f"{'':{width}}        limit  medians  fastest"] + [
        f"{target.text:{width}}  {_limit(target):>10}  {_ratios(target)}  {target.verdict}" for target in targets
    ]


def _limit(target):
    return f"{'<=' if target.at_most else '>='} {target.limit:g}"


def _ratios(target):
    if target.verdict == NOT_MEASURED:
        return f"{_NOTHING:>7}  {_NOTHING:>7}"
    return f"{_number(target.measured.of_medians):>7}  {_number(target.measured.of_minima):>7}"


def _number(value):
    if value == 0.0:
        return "0"
    return f"{value:.1f}" if value >= 10.0 else f"{value:.2f}" if value >= 0.01 else f"{value:.1e}"
