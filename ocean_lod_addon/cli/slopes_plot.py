# SPDX-License-Identifier: GPL-3.0-or-later
"""The plot of `slopes --plot`: the levels stacked over distance, with the sea's slope variance as a line.

Drawn with matplotlib, which Blender does not bring along; nothing else needs it.
"""

from pathlib import Path

from ..core.errors import OceanError

_ENDINGS = (".png", ".svg", ".pdf")
_COLORS = {"geometry": "#1f4e79", "bump": "#4f9fcf", "brdf": "#cfe3f1"}
_LABELS = {"geometry": "geometry", "bump": "bump", "brdf": "BRDF"}


def save_plot(looks, path: Path) -> None:
    """Draw the budgets: a row a view, up and across the wind side by side. Raises OceanError."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise OceanError("--plot needs the Python package matplotlib, which is not installed here") from None
    if path.suffix.lower() not in _ENDINGS:
        raise OceanError(f"--plot {path.name!r} ends in {path.suffix!r}, allowed is {', '.join(_ENDINGS)}")
    figure = Figure(figsize=(11.0, 2.6 * len(looks)), layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.subplots(len(looks), 2, squeeze=False, sharex=True)
    for row, look in zip(grid, looks, strict=True):
        for axis, axes in enumerate(row):
            _draw(axes, look, axis)
    grid[0][0].legend(loc="lower right")
    for axes in grid[-1]:
        axes.set_xlabel("distance (m)")
    try:
        figure.savefig(path, dpi=110)
    except OSError as error:
        raise OceanError(f"--plot {path}: can not be written: {error.strerror}") from None


def _draw(axes, look, axis):
    budget = look.budget
    levels = [getattr(budget, name)[:, axis] for name in _COLORS]
    axes.stackplot(budget.distance, *levels, colors=_COLORS.values(), labels=_LABELS.values())
    axes.axhline(budget.total[axis], color="#e07b39", linewidth=1.5, label="the sea")
    axes.set_xscale("log")
    axes.set_xlim(budget.distance[0], budget.distance[-1])
    slopes = ("along", "across")[axis]
    axes.set_title(f"wind {look.wind_speed:g} m/s, looking {look.view}: slopes {slopes} the wind", fontsize=9)
    axes.set_ylabel("slope variance")
