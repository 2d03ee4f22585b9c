# SPDX-License-Identifier: GPL-3.0-or-later
"""Two checks on rendered pictures of the sea that take too long for the tests. What they find: docs/ripples.md.

    python -m tools.sea_checks repetition
    python -m tools.sea_checks flicker --engine CYCLES
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path


def main():
    """Run the check that the command line names."""
    parser = argparse.ArgumentParser(prog="python -m tools.sea_checks", description=__doc__.splitlines()[0])
    parser.add_argument("check", choices=("repetition", "flicker"))
    parser.add_argument("--engine", choices=("CYCLES", "EEVEE"), default="CYCLES")
    parser.add_argument("--samples", type=int, default=16, help="samples per pixel (%(default)s)")
    parser.add_argument("--save", metavar="FOLDER", help="save pictures and numbers there as well")
    aerial = parser.add_argument_group("repetition")
    aerial.add_argument("--pixels", type=int, default=512, help="along each side of the picture (%(default)s)")
    aerial.add_argument("--seeds", type=int, default=1, help="seas of this ocean to look at (%(default)s)")
    dolly = parser.add_argument_group("flicker")
    dolly.add_argument("--width", type=int, default=960, help="of the whole frame, in pixels (%(default)s)")
    dolly.add_argument("--frames", type=int, default=4)
    dolly.add_argument("--rows", type=int, default=12, help="rows of pixels below the horizon (%(default)s)")
    dolly.add_argument("--columns", type=int, default=64, help="columns of pixels (%(default)s)")
    options = parser.parse_args()
    if options.save:
        Path(options.save).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="ocean_lod_checks_") as folder:
        os.environ["BLENDER_USER_RESOURCES"] = folder  # before bpy is imported
        from . import flicker, repetition

        {"repetition": repetition.run, "flicker": flicker.run}[options.check](options)
        sys.stdout.flush()
    os._exit(0)  # Blender 4.5 can hang in its own exit handlers


if __name__ == "__main__":
    main()
