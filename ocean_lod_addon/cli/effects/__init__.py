# SPDX-License-Identifier: GPL-3.0-or-later
"""`effects`: what each effect takes where it is on, and that it takes nothing where it is off."""

import contextlib
import json
import sys
import time
from dataclasses import asdict, dataclass

from ...core.effects import OFF, ON, Effects
from ...core.errors import OceanError
from ...core.lod import Grid
from ...core.parameters import parameters_of
from ..bench.in_blender import fresh_data, is_available
from ..bench.machine import Machine, disturbance, this_machine
from ..bench.timing import Timing, alternate
from ..results import json_output, save_json
from . import report
from .builds import ABSENT, NAMES, Picture, states_of

NAME = "effects"
HELP = "Measure what each effect takes where it is on, and that it takes nothing where it is off."

_SCHEMA_VERSION = 2


@dataclass(frozen=True)
class Extent:
    """How much is measured: the plane, the frames of each ocean, and pictures."""

    grid: Grid
    frames: int
    pictures: tuple[Picture, ...]


_GRID = Grid(cells=64, levels=8)
"""Small: what an effect that is off still took would show beside it."""

QUICK = Extent(_GRID, 80, (Picture("CYCLES", (96, 54), 4, renders=5),))
FULL = Extent(_GRID, 240, (Picture("CYCLES", (96, 54), 4, renders=30), Picture("EEVEE", (96, 54), 1, renders=30)))


@dataclass(frozen=True, eq=False)
class Row:
    """One effect. Times by state (on, off, absent): of frames, and of pictures by engine; bytes by state."""

    effect: str
    frame: dict[str, Timing]
    memory: dict[str, int]
    pictures: dict[str, dict[str, Timing]]

    @property
    def label(self) -> str:
        """As the panel calls it."""
        return parameters_of(Effects)[self.effect].label

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "effect": self.effect,
            "label": self.label,
            "frame_ms": _milliseconds(self.frame),
            "frame_off_over_absent": asdict(report.off_over_absent(self.frame)),
            "memory_bytes": self.memory,
            "render_ms": {engine: _milliseconds(states) for engine, states in self.pictures.items()},
            "render_off_over_absent": {
                engine: asdict(report.off_over_absent(states)) for engine, states in self.pictures.items()
            },
        }


def _milliseconds(states):
    return {state: 1e3 * timing.median() for state, timing in states.items()}


@dataclass(frozen=True, eq=False)
class Results:
    """Everything that was measured."""

    machine: Machine
    disturbance: str
    vertices: int
    rows: list[Row]

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "schema_version": _SCHEMA_VERSION,
            "machine": self.machine.as_mapping(),
            "disturbance": self.disturbance,
            "vertices": self.vertices,
            "effects": [row.as_mapping() for row in self.rows],
        }


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "--full",
        action="store_true",
        help="more of each, and pictures in EEVEE: a quarter of an hour (default: two minutes)",
    )
    parser.add_argument(
        "--only", choices=NAMES, nargs="+", default=NAMES, metavar="EFFECT", help=f"of {', '.join(NAMES)} (all)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON; progress goes to the error stream")
    parser.add_argument("--output", metavar="FILE", help="also save the results, as JSON")


def run(options) -> None:
    """Measure, print and save. Raises OceanError for bad arguments, before anything is measured."""
    if not is_available():
        raise OceanError("effects are measured in Blender: this Python has no module bpy")
    output = json_output(options.output) if options.output else None
    with contextlib.redirect_stdout(sys.stderr) if options.json else contextlib.nullcontext():
        results = measure_effects(FULL if options.full else QUICK, options.only).as_mapping()
        if output is not None:
            save_json(output, results)
    if options.json:
        print(json.dumps(results, indent=2))


def measure_effects(extent: Extent, names=NAMES) -> Results:
    """Measure effects one after the other; rows are printed as soon as they are known."""
    started = time.perf_counter()
    machine = this_machine(True)
    engines = [picture.engine for picture in extent.pictures]
    print(f"{machine}; {extent.grid.vertex_count} vertices\n\n{report.LEGEND}\n", flush=True)
    print("\n".join(report.header(engines)), flush=True)
    rows = []
    for name in names:
        rows.append(_measure(name, extent))
        print(report.line(rows[-1]), flush=True)
    print("\n" + "\n".join(report.verdicts(rows)), flush=True)
    disturbed = disturbance()
    if disturbed:
        print(f"\n{disturbed}")
    print(f"\nmeasured in {time.perf_counter() - started:.0f} s", flush=True)
    return Results(machine, disturbed, extent.grid.vertex_count, rows)


def _measure(effect, extent):
    with fresh_data():
        oceans = states_of(effect, extent.grid)
        frames = alternate([ocean.frame(state) for state, ocean in oceans.items()], extent.frames)
        pictures = {}
        for picture in extent.pictures:
            contestants = [ocean.picture(state, picture) for state, ocean in oceans.items()]
            pictures[picture.engine] = alternate(contestants, picture.renders)
        memory = {state: oceans[state].memory() for state in (ON, OFF, ABSENT)}
    return Row(effect, frames, memory, pictures)
