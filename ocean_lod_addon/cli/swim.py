# SPDX-License-Identifier: GPL-3.0-or-later
"""`swim`: how much the surface moves at fixed points only because the camera does."""

import dataclasses
import json

import numpy as np

from ..core import presets
from ..core.lod import Grid
from ..core.ocean import Ocean, Surface
from ..core.swim import SwimReport, dolly_and_pan, measure
from .arguments import whole_number

NAME = "swim"
HELP = "Measure how much the mesh makes the sea move when only the camera does (a dolly with a 90 degree pan)."

_NEAREST, _FURTHEST = 2.0, 1500.0  # m
_DOLLY = 10.0  # m, what 200 frames travel

SHOT_GRID = Grid(cell_size=0.03, cells=512, levels=9)
"""The plane of the shot."""


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("--preset", default="moderate", help="sea preset, or a preset .json file (%(default)s)")
    parser.add_argument("--frames", type=whole_number(2, 10_000), default=200, metavar="N", help="(%(default)s)")
    parser.add_argument("--points", type=whole_number(1, 100_000), default=500, metavar="N", help="(%(default)s)")
    parser.add_argument("--json", action="store_true", help="print JSON")


def measure_shot(surface: Surface, frames: int, points: int) -> SwimReport:
    """The swim of a surface in the shot, at random points around it, at one sea time."""
    random = np.random.Generator(np.random.PCG64(0))
    distance = np.exp(random.uniform(np.log(_NEAREST), np.log(_FURTHEST), points))
    bearing = random.uniform(-np.pi, np.pi, points)
    x, y = distance * np.cos(bearing) + _DOLLY / 2, distance * np.sin(bearing)
    return measure(surface, dolly_and_pan(frames, speed=_DOLLY / frames), x, y, time=7.0)


def run(options) -> None:
    """Measure and print. Raises OceanError for an unknown preset."""
    surface = Surface(Ocean(presets.load(options.preset).sea, SHOT_GRID))
    report = measure_shot(surface, options.frames, options.points)
    if options.json:
        print(json.dumps(dataclasses.asdict(report), indent=2))
        return
    print(f"{report.points} points, {_NEAREST:g} m to {_FURTHEST:g} m away, {report.frames} frames")
    print(f"significant wave height        {report.significant_wave_height:.2f} m")
    print(f"interpolation between vertices {report.interpolation_rms:.3%} of it (rms, constant in time)")
    print(f"swim                           {report.swim_rms:.4%} (rms), {report.swim_max:.3%} (largest)")
