# SPDX-License-Identifier: GPL-3.0-or-later
"""The plot of `bench`: time against vertices and against waves.

Drawn with matplotlib, which Blender does not bring along; nothing else needs it.
"""

from pathlib import Path

import numpy as np

from ...core.errors import OceanError
from . import workloads
from .measurements import DIRECT, DISPLACE, FRAME, GENERATE, PRODUCTS, UPDATE, Row

_STYLES = {
    DIRECT[np.float64]: ("NumPy sum over waves, float64", "#b8b8b8", "v"),
    DIRECT[np.float32]: ("NumPy sum over waves, float32", "#8a8a8a", "^"),
    GENERATE: ("Ocean modifier, generate", "#c0392b", "s"),
    DISPLACE: ("Ocean modifier, displace", "#e07b39", "D"),
    FRAME: ("Ocean LOD, frame in Blender", "#1f4e79", "o"),
    UPDATE: ("Ocean LOD, update", "#4a90c2", "o"),
    PRODUCTS: ("its matrix products alone", "#9cc7e4", "."),
}

_WAVES, _CELLS = 128, 512


def save_plot(rows: list[Row], caption: str, path: Path) -> bool:
    """Write the plot of some rows; False without matplotlib. Raises OceanError if the file can not be written."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return False
    figure = Figure(figsize=(12.0, 5.2), layout="constrained")
    FigureCanvasAgg(figure)
    by_vertices, by_waves = figure.subplots(1, 2, sharey=True)
    squares = [row for row in rows if row.kind == workloads.SQUARE]
    _draw(by_vertices, [row for row in squares if row.waves == _WAVES], lambda row: row.vertices)
    _draw(by_waves, [row for row in squares if row.cells == _CELLS], lambda row: row.waves)
    by_vertices.set(xlabel=f"vertices, with {_WAVES} waves", ylabel="milliseconds a frame")
    by_waves.set_xlabel(f"waves, with {(_CELLS + 1) ** 2} vertices")
    by_waves.set_xscale("log", base=2)
    by_waves.xaxis.set_major_formatter("{x:.0f}")
    handles, labels = by_vertices.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)
    figure.suptitle(caption, fontsize=9, color="#555555")
    try:
        figure.savefig(path, dpi=90)
    except OSError as error:
        raise OceanError(f"{path}: can not be written: {error.strerror}") from None
    return True


def _draw(axes, rows, position):
    for name, (label, color, marker) in _STYLES.items():
        points = [(position(row), 1e3 * row.timings[name].median()) for row in rows if name in row.timings]
        if points:
            axes.plot(*zip(*sorted(points), strict=True), color=color, marker=marker, label=label)
    axes.set(xscale="log", yscale="log")
    axes.grid(which="major", color="#e6e6e6")
    axes.spines[["top", "right"]].set_visible(False)
