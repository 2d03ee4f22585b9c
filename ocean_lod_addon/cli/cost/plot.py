# SPDX-License-Identifier: GPL-3.0-or-later
"""The plots of `cost`: error against time for each knob, and whole configurations.

Drawn with matplotlib, which Blender does not bring along; nothing else needs it.
"""

import math
from pathlib import Path

from ...core.errors import OceanError

_KEPT, _LEFT_OUT, _MEASURED = "#1f4e79", "#b8b8b8", "#e07b39"
_COLUMNS = 3
_WIDE = 8.0
"""Times that differ by more than this factor are shown on a logarithmic scale."""

_TIME_FLOOR = 1e-3  # ms; what costs nothing stands at the edge of the plot


def save_plots(results, knobs_path: Path, front_path: Path) -> bool:
    """Write both plots; False without matplotlib. Raises OceanError if a file can not be written."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return False
    rows = math.ceil(len(results.ladders) / _COLUMNS)
    figure = Figure(figsize=(13.0, 2.9 * rows), layout="constrained")
    FigureCanvasAgg(figure)
    for number, ladder in enumerate(results.ladders):
        _draw_ladder(figure.add_subplot(rows, _COLUMNS, number + 1), ladder)
    figure.suptitle(str(results.machine), fontsize=9, color="#555555")
    _save(figure, knobs_path)

    figure = Figure(figsize=(9.0, 5.2), layout="constrained")
    FigureCanvasAgg(figure)
    _draw_front(figure.add_subplot(), results)
    figure.suptitle(str(results.machine), fontsize=9, color="#555555")
    _save(figure, front_path)
    return True


def _save(figure, path):
    try:
        figure.savefig(path, dpi=80)
    except OSError as error:
        raise OceanError(f"{path}: can not be written: {error.strerror}") from None


def _draw_ladder(axes, ladder):
    kept = [(max(s.milliseconds, _TIME_FLOOR), s.error, s.value) for s in ladder.steps if s.worth_having]
    left_out = [(max(s.milliseconds, _TIME_FLOOR), s.error, s.value) for s in ladder.steps if not s.worth_having]
    axes.plot([x for x, _, _ in sorted(kept)], [y for _, y, _ in sorted(kept)], color=_KEPT, marker="o")
    axes.plot([x for x, _, _ in left_out], [y for _, y, _ in left_out], "x", color=_LEFT_OUT)
    for x, y, name in (*kept, *left_out):
        axes.annotate(name, (x, y), textcoords="offset points", xytext=(5, 4), fontsize=6.5, color="#333333")
    times = [x for x, _, _ in (*kept, *left_out)]
    if max(times) > _WIDE * min(times):
        axes.set_xscale("log")
        axes.xaxis.minorticks_off()
    positive = [step.error for step in ladder.steps if step.error > 1e-9]
    if positive and max(positive) > 30.0 * min(positive):
        axes.set_yscale("symlog", linthresh=min(positive))
    axes.set_title(ladder.knob.label, fontsize=9)
    axes.set_ylabel(ladder.knob.unit, fontsize=8)
    axes.set_xlabel("ms", fontsize=8)
    axes.margins(x=0.25, y=0.15)
    axes.tick_params(labelsize=7)
    axes.grid(which="major", color="#ececec")
    axes.spines[["top", "right"]].set_visible(False)


def _draw_front(axes, results):
    points = results.front
    axes.plot(
        [point.predicted for point in points],
        [point.samples for point in points],
        color=_KEPT,
        marker=".",
        markersize=3,
        label="the ladder, predicted",
    )
    for configuration in results.configurations:
        measured = configuration.measured
        if measured is not None:
            axes.plot(measured, configuration.samples, "o", color=_MEASURED)
        axes.annotate(
            f"{configuration.label}: {configuration.height:.3g} mm, "
            f"{configuration.ripples:.3g} % of ripples wrong",
            (configuration.predicted if measured is None else measured, configuration.samples),
            textcoords="offset points",
            xytext=(8, -10),
            fontsize=8,
        )
    axes.plot([], [], "o", color=_MEASURED, label="measured")
    axes.set(xscale="log", xlabel="ms a frame", ylabel="vertices per wavelength of the shortest wave")
    axes.margins(x=0.3, y=0.12)
    axes.legend(frameon=False)
    axes.grid(which="major", color="#ececec")
    axes.spines[["top", "right"]].set_visible(False)
