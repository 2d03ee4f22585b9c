# SPDX-License-Identifier: GPL-3.0-or-later
"""The plot of `sea --plot`: target against sampled spectrum, and where the waves go.

Drawn with matplotlib, which Blender does not bring along; nothing else needs it.
"""

from pathlib import Path

import numpy as np

from ..core.errors import OceanError
from ..core.readback import SeaReport
from ..core.readback_text import quantity
from ..core.sea import Sea
from ..core.spectrum_curves import (
    directional_density,
    energy_by_direction,
    sampled_density,
    target_density,
)
from ..core.waves import TWO_PI, WaveSet

_ENDINGS = (".png", ".svg", ".pdf")
_SHOWN_PEAKS = 4.5
"""The frequency axes end at this many times the peak frequency of the whole sea."""

_SECTORS = 36
_TARGET, _SAMPLED = "#1f4e79", "#e07b39"


def save_plot(sea: Sea, waves: WaveSet, report: SeaReport, path: Path) -> None:
    """Write the plot of a sea to a file. Raises OceanError without matplotlib, waves, or a place to write to."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise OceanError("--plot needs the Python package matplotlib, which is not installed here") from None
    if path.suffix.lower() not in _ENDINGS:
        raise OceanError(f"--plot {path.name!r} ends in {path.suffix!r}, allowed is {', '.join(_ENDINGS)}")
    if not len(waves):
        raise OceanError("--plot: this sea has no waves to draw")
    figure = Figure(figsize=(13.0, 4.8), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.15)
    FigureCanvasAgg(figure)
    highest = _SHOWN_PEAKS * TWO_PI / report.theoretical.peak_period
    _draw_spectrum(figure.add_subplot(1, 3, 1), sea, waves, report, highest)
    _draw_fan(figure.add_subplot(1, 3, 2, projection="polar"), sea, waves)
    _draw_map(figure.add_subplot(1, 3, 3, projection="polar"), sea, waves, highest)
    try:
        figure.savefig(path, dpi=110)
    except OSError as error:
        raise OceanError(f"--plot {path}: can not be written: {error.strerror}") from None


def _draw_spectrum(axes, sea, waves, report, highest):
    omega = np.linspace(0.0, highest, 2000)[1:]
    sampled = sampled_density(sea, waves, report.shortest_wavelength, omega)
    axes.fill_between(omega, sampled, color=_SAMPLED, alpha=0.35, linewidth=0, label=f"{len(waves)} waves")
    axes.plot(omega, target_density(sea, omega), color=_TARGET, label="spectrum")
    axes.set_xlabel("angular frequency (rad/s)")
    axes.set_ylabel("S (m² s/rad)")
    axes.set_xlim(0.0, omega[-1])
    axes.set_ylim(bottom=0.0)
    theory = report.theoretical
    height, period = quantity(theory.significant_wave_height, "m"), quantity(theory.peak_period, "s")
    axes.set_title(f"Energy by frequency: Hs {height}, Tp {period}")
    axes.legend()


def _draw_fan(axes, sea, waves):
    direction = np.linspace(-np.pi, np.pi, 361)
    edges = np.linspace(-np.pi, np.pi, _SECTORS + 1)
    wrapped = np.mod(waves.direction + np.pi, TWO_PI) - np.pi
    energy, _ = np.histogram(wrapped, edges, weights=0.5 * waves.amplitude**2)
    width = TWO_PI / _SECTORS
    axes.bar(edges[:-1] + 0.5 * width, energy / width, width=width, color=_SAMPLED, alpha=0.35, label="waves")
    axes.plot(direction, energy_by_direction(sea, direction), color=_TARGET, label="spectrum")
    axes.set_yticklabels([])
    axes.set_title("Energy by direction of travel", pad=12.0)
    axes.legend(loc="lower left", bbox_to_anchor=(-0.12, -0.1))


def _draw_map(axes, sea, waves, highest):
    direction, omega = np.meshgrid(np.linspace(-np.pi, np.pi, 241), np.linspace(0.0, highest, 161)[1:])
    density = directional_density(sea, omega, direction)
    axes.pcolormesh(direction, omega, np.sqrt(density), cmap="Blues", shading="gouraud", rasterized=True)
    shown = waves.angular_frequency < highest
    size = 60.0 * waves.amplitude[shown] / waves.amplitude.max() + 1.0
    axes.scatter(waves.direction[shown], waves.angular_frequency[shown], s=size, color=_SAMPLED, alpha=0.7)
    axes.set_rmax(highest)
    axes.set_rlabel_position(-60.0)
    axes.set_title("Waves over the spectrum, radius in rad/s", pad=12.0)
