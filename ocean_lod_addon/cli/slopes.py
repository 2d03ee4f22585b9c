# SPDX-License-Identifier: GPL-3.0-or-later
"""`slopes`: how much slope variance geometry, bump and BRDF show at every distance, and whether they add up."""

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.lod import Grid
from ..core.ocean import Ocean, Surface
from ..core.ripples.budget import BudgetOf, SlopeBudget
from ..core.sea import Sea, WaveSystem
from .arguments import real_number, whole_number

NAME = "slopes"
HELP = "Show the slope variance of geometry, bump and BRDF against distance, looking up and across the wind."

_GRID = Grid(cell_size=0.1, cells=128, levels=13)
_NEAREST, _FURTHEST = 0.5, 20e3  # m
_SENSOR_OVER_LENS = 36.0 / 35.0
_HEADINGS = {"upwind": math.pi, "crosswind": 0.5 * math.pi}  # the wind blows along x


@dataclass(frozen=True, eq=False)
class Look:
    """A budget looking one way, at one wind."""

    wind_speed: float
    view: str
    budget: SlopeBudget

    @property
    def deviation(self) -> np.ndarray:
        """Sum of the levels over the sea's total, less 1: (distances, 2), up and across the wind."""
        budget = self.budget
        return (budget.geometry + budget.bump + budget.brdf)[:, :2] / budget.total[:2] - 1.0


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "--wind",
        type=real_number(0.1, 60.0),
        nargs="+",
        default=[3.0, 10.0, 20.0],
        metavar="M/S",
        help="winds at 10 m (3 10 20)",
    )
    parser.add_argument(
        "--height", type=real_number(0.1, 1e4), default=3.0, metavar="M", help="of the lens, m (%(default)s)"
    )
    parser.add_argument(
        "--width", type=whole_number(16, 65_536), default=1920, help="pixels of a 35 mm lens (%(default)s)"
    )
    parser.add_argument("--distances", type=whole_number(2, 1000), default=24, metavar="N", help="(%(default)s)")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--plot", metavar="PATH", help="also draw it: .png, .svg or .pdf")


def run(options) -> None:
    """Measure, print and draw. Raises OceanError for a plot that can not be drawn."""
    looks = looks_at(options.wind, options.height, options.width, options.distances)
    if options.plot:
        from .slopes_plot import save_plot

        save_plot(looks, Path(options.plot))
    print(json.dumps(as_json(looks), indent=2) if options.json else as_text(looks))


def looks_at(winds, height: float, width: int, count: int) -> list[Look]:
    """The budgets of a sea at each wind in m/s, looking up and across it."""
    distances = np.geomspace(_NEAREST, _FURTHEST, count)
    looks = []
    for wind in winds:
        sea = Sea(systems=(WaveSystem(wind_speed=wind),))
        budget = BudgetOf(Surface(Ocean(sea, _GRID)))
        for view, heading in _HEADINGS.items():
            seen = budget.seen(heading, distances, height, _SENSOR_OVER_LENS / width)
            looks.append(Look(wind, view, seen))
    return looks


def as_json(looks: list[Look]) -> list[dict]:
    """Variances as [along the wind, across the wind] for each distance in m."""
    return [
        {
            "wind_speed": look.wind_speed,
            "view": look.view,
            "distance": look.budget.distance.tolist(),
            "total": look.budget.total[:2].tolist(),
            **{level: getattr(look.budget, level)[:, :2].tolist() for level in ("geometry", "bump", "brdf")},
            "largest_deviation": float(np.abs(look.deviation).max()),
        }
        for look in looks
    ]


def as_text(looks: list[Look]) -> str:
    """Tables: variances in thousandths, along the wind and across it."""
    lines = []
    for look in looks:
        budget = look.budget
        lines += [
            f"wind {look.wind_speed:g} m/s, looking {look.view}: slope variance in thousandths",
            "               along the wind                     across the wind",
            "distance (m)   geometry    bump    BRDF     sum    geometry    bump    BRDF     sum",
        ]
        for row, distance in enumerate(budget.distance):
            numbers = f"{distance:12.4g}"
            for axis in (0, 1):
                levels = [1e3 * level[row, axis] for level in (budget.geometry, budget.bump, budget.brdf)]
                numbers += f"   {levels[0]:8.2f}" + "".join(f"{x:8.2f}" for x in (*levels[1:], sum(levels)))
            lines.append(numbers)
        along, across = 1e3 * budget.total[:2]
        lines += [
            f"{'the sea':<12}{along:35.2f}{across:35.2f}",
            f"largest deviation of the sum: {np.abs(look.deviation).max():.2%}",
            "",
        ]
    return "\n".join(lines).rstrip()
