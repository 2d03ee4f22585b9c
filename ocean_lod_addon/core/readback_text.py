# SPDX-License-Identifier: GPL-3.0-or-later
"""A sea report in words, for the panel and the terminal alike."""

import math
from dataclasses import dataclass

from .readback import LoopDistortion, SeaReport
from .sea import WaveSystem
from .spectra.table import SPECTRA
from .spreading.table import SPREADINGS
from .wind import COX_MUNK_HEIGHT, wind_at_height

CONSPICUOUS_SHIFT = 0.1
"""From this relative change of a wave's frequency on, a loop is worth a warning: its waves run visibly wrong."""

_MOST_DECIMALS = 5


@dataclass(frozen=True)
class Line:
    """One quantity: what it is, and its values as texts."""

    name: str
    values: tuple[str, ...]


def statistics_lines(report: SeaReport) -> list[Line]:
    """Each statistic of the spectra (first value) and of the waves that were made of them (second value)."""
    rows = (
        ("Height Hs", "significant_wave_height", "m"),
        ("Peak period Tp", "peak_period", "s"),
        ("Mean period Tz", "zero_crossing_period", "s"),
        ("Mean wavelength", "mean_wavelength", "m"),
        ("Slope var. along", "slope_variance_along", ""),
        ("Slope var. across", "slope_variance_across", ""),
    )
    both = (report.theoretical, report.sampled)
    return [
        Line(name, tuple(quantity(getattr(statistics, field), unit) for statistics in both))
        for name, field, unit in rows
    ]


def fact_lines(report: SeaReport) -> list[Line]:
    """What there is to say of a sea besides its statistics."""
    return [
        Line("Wind", (quantity(report.wind_speed, "m/s"),)),
        Line("Beaufort", (_beaufort(report),)),
        Line("Number of waves", (f"{report.wave_count}",)),
        Line("Shortest wave", (quantity(report.shortest_wavelength, "m"),)),
        Line("Energy carried", (_share(report.energy_share),)),
        Line("Slopes carried", (_share(report.slope_variance_share),)),
    ]


def loop_lines(loop: LoopDistortion) -> list[Line]:
    """What a perfect loop does to the waves: how far it changes their frequencies, and their slope variance."""
    return [
        Line("Loop shift, rms", (f"{loop.rms_frequency_shift:.1%}",)),
        Line("Loop shift, largest", (f"{loop.largest_frequency_shift:.1%}",)),
        Line("Loop slope variance", (f"{loop.slope_variance_ratio:.1%}",)),
    ]


def formula_wind_lines(system: WaveSystem) -> list[Line]:
    """The height that each formula is written for, and the wind there; nothing for a system without wind."""
    if system.sized_by != "wind":
        return []
    spectrum, spreading = SPECTRA[system.spectrum], SPREADINGS[system.spreading]
    heights = [(spectrum.option.label, spectrum.wind_height)]
    if spreading.wind_height is not None and spreading.option.label != spectrum.option.label:
        heights.append((spreading.option.label, spreading.wind_height))
    heights.append(("Cox-Munk glitter", COX_MUNK_HEIGHT))
    return [
        Line(label, (f"at {height:g} m", quantity(wind_at_height(system.wind_speed, height), "m/s")))
        for label, height in heights
    ]


def quantity(value: float | None, unit: str = "") -> str:
    """A value with three digits and its unit; a dash where there is none."""
    if value is None:
        return "-"
    decimals = 2 - math.floor(math.log10(abs(value))) if value else 0
    return f"{value:,.{min(max(decimals, 0), _MOST_DECIMALS)}f} {unit}".rstrip()


def plain_number(value: float) -> str:
    """A number with three digits where that takes no exponent, and no zeros behind them: 15, 2.25, 1,709."""
    return f"{value:.3g}" if abs(value) < 999.5 else f"{value:,.0f}"


def _beaufort(report):
    return "-" if report.beaufort_number is None else f"{report.beaufort_number}, {report.beaufort_name.lower()}"


def _share(share):
    return "-" if share is None else f"{share:.1%}"
