# SPDX-License-Identifier: GPL-3.0-or-later
"""`sea`: what a sea is, in numbers and pictures: of its spectra, and of the waves that are made of them."""

import dataclasses
import json
from pathlib import Path

from ..core import presets
from ..core.discretise import check_wave_height, discretise
from ..core.errors import OceanError
from ..core.lod import Grid
from ..core.ocean_time import OceanTime, loop_period
from ..core.readback import sea_report
from ..core.readback_text import Line, fact_lines, formula_wind_lines, loop_lines, statistics_lines
from ..core.relevant_settings import relevant_settings
from ..core.sea import Sea, WaveSystem
from .arguments import real_number
from .setting_options import add_setting_options, given_settings, option_name

NAME = "sea"
HELP = "Read a sea back: heights, periods, slopes, of its spectra and of its waves."

_NOT_OF_A_SYSTEM = ("name", "enabled", "wave_share", "seed")
_NOT_OF_THE_CLOCK = ("source", "time", "offset")
_DEPTH = "depth"


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("--preset", help="start from this preset, or preset .json file; options change it")
    parser.add_argument("--list", action="store_true", help="list the presets instead")
    parser.add_argument("--json", action="store_true", help="print JSON; keys end in their units")
    parser.add_argument("--plot", metavar="FILE.png", help="also draw the spectra and the waves; needs matplotlib")
    parser.add_argument(
        "--shortest-wavelength",
        type=real_number(1e-3, 1e4),
        default=Grid().shortest_wavelength,
        metavar="M",
        help="shortest wave that is made, in m (%(default)g)",
    )
    parser.add_argument(
        "--frames-per-second",
        type=real_number(0.01, 1e4),
        default=24.0,
        metavar="FPS",
        help="frame rate, for --loop-frames (%(default)g)",
    )
    system = parser.add_argument_group("the first wave system")
    add_setting_options(system, WaveSystem, _NOT_OF_A_SYSTEM)
    add_setting_options(parser.add_argument_group("the sea"), Sea)
    add_setting_options(parser.add_argument_group("the clock"), OceanTime, _NOT_OF_THE_CLOCK)


def run(options) -> None:
    """Print the read-back, and draw the plot. Raises OceanError for what can be mended."""
    if options.list:
        _list(options.json)
        return
    sea = sea_of(options)
    waves = discretise(sea, options.shortest_wavelength)
    check_wave_height(sea, waves)
    report = sea_report(sea, waves, options.shortest_wavelength)
    if options.plot:
        from .sea_plot import save_plot

        save_plot(sea, waves, report, Path(options.plot))
    if options.json:
        print(json.dumps(report.to_json(), indent=2, allow_nan=False))
    else:
        _print_report(sea, report)


def sea_of(options) -> Sea:
    """The sea that the options describe. Raises OceanError for an option that would have no effect."""
    sea = presets.load(options.preset).sea if options.preset else Sea()
    changes = given_settings(options, WaveSystem, _NOT_OF_A_SYSTEM)
    system = dataclasses.replace(sea.systems[0], **changes)
    _check_effect(changes, relevant_settings(system), f"{system.spectrum} sized by {system.sized_by}")
    sea_changes = given_settings(options, Sea)
    clock = OceanTime(**given_settings(options, OceanTime, _NOT_OF_THE_CLOCK))
    sea = dataclasses.replace(
        sea,
        systems=(system, *sea.systems[1:]),
        loop_period=loop_period(clock, options.frames_per_second),
        **sea_changes,
    )
    if _DEPTH in sea_changes and not sea.finite_depth:
        raise OceanError("--depth has no effect without --finite-depth")
    return sea


def _check_effect(names, relevant, what):
    for name in names:
        if name not in relevant:
            allowed = ", ".join(option_name(other) for other in relevant if other not in _NOT_OF_A_SYSTEM)
            raise OceanError(f"{option_name(name)} has no effect on {what}, which takes {allowed}")


def _list(as_json):
    found = {name: presets.load(name) for name in presets.names()}
    if as_json:
        listed = {name: {"title": p.title, "description": p.description} for name, p in found.items()}
        print(json.dumps(listed, indent=2, ensure_ascii=False))
        return
    width = max(map(len, found))
    for name, preset in found.items():
        print(f"{name:{width}}  {preset.description}")


def _print_report(sea, report):
    _print_lines([Line("", ("spectrum", "waves")), *statistics_lines(report)])
    print()
    _print_lines(fact_lines(report) + (loop_lines(report.loop) if report.loop else []))
    for system in sea.systems:
        lines = formula_wind_lines(system) if system.enabled else []
        if lines:
            print(f"\nThe wind of {system.name!r} in the formulas:")
            _print_lines(lines)


def _print_lines(lines):
    for line in lines:
        print(f"{line.name:28}", *(f"{value:>12}" for value in line.values))
