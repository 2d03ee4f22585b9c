# SPDX-License-Identifier: GPL-3.0-or-later
"""`explain`: which effects a shot calls for, and why."""

import json
from dataclasses import replace
from pathlib import Path

from ..core import presets
from ..core.effects import Effects
from ..core.foam_settings import Foam
from ..core.framing import Framing
from ..core.plan import Facts, Plan, Settings, decide
from ..core.shot_fit import first_fit, frame_needs
from .arguments import real_number, resolution, whole_number
from .setting_options import add_setting_options, given_settings

NAME = "explain"
HELP = "Say which effects a shot calls for, and why."


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--preset", default="moderate", help="preset, or preset .json file (%(default)s)")
    source.add_argument("--blend", metavar="FILE", help="explain the first ocean of this .blend file, as it is")
    parser.add_argument("--engine", choices=("CYCLES", "EEVEE"), default="CYCLES", help="engine (%(default)s)")
    parser.add_argument(
        "--resolution", type=resolution, default=(960, 540), metavar="WxH", help="pixels (960x540)"
    )
    parser.add_argument(
        "--shutter",
        type=real_number(0.0, 10.0),
        default=0.0,
        metavar="S",
        help="seconds that the shutter is open, with motion blur (%(default)g: none)",
    )
    parser.add_argument(
        "--samples", type=whole_number(1, 1 << 20), default=64, metavar="N", help="samples per pixel (%(default)d)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON")
    add_setting_options(parser.add_argument_group("effects"), Effects)
    add_setting_options(parser.add_argument_group("foam"), Foam)


def run(options) -> None:
    """Print the plan of a preset's shot, or of a file's scene at its current frame."""
    plan = _blend_plan(options) if options.blend else preset_plan(options)
    if options.json:
        print(json.dumps(plan.to_json(), indent=2))
    else:
        print_plan(plan)


def preset_plan(options) -> Plan:
    """The plan for a preset's first shot, on the plane that `render` would make for it."""
    preset = presets.load(options.preset)
    needs = frame_needs(preset.shot.view(*options.resolution), options.resolution[0])
    grid, ripples, waves = first_fit(preset.sea, needs)
    settings = Settings(
        preset.sea,
        grid,
        Framing(),
        preset.material,
        ripples,
        replace(preset.foam, **given_settings(options, Foam)),
        Effects(**given_settings(options, Effects)),
    )
    facts = Facts(engine=options.engine, shutter=options.shutter, samples=options.samples, camera=needs)
    return decide(facts, settings, waves)


def _blend_plan(options):
    from ..scene import ocean_object
    from .render import open_blend

    scene = open_blend(Path(options.blend))
    ocean = next(ob for ob in scene.objects if ocean_object.is_ocean(ob))
    return ocean_object.plan(ocean, scene)


def print_plan(plan: Plan) -> None:
    """One line for each effect, then what is computed."""
    width = max(len(decision.label) for decision in plan.decisions)
    for decision in plan.decisions:
        print(f"{decision.label:{width}}  {'on ' if decision.on else 'off'}  {decision.why}")
    print()
    print(f"Tiles that move: {plan.tiles}. {plan.why_tiles}")
    print(f"Waves: {plan.waves}; {plan.columns} numbers for each vertex of these tiles")
    print(f"Attributes that come and go: {', '.join(plan.attributes) or 'none'}")
    print(f"Images: {plan.images}; group nodes: {', '.join(plan.nodes)}")
