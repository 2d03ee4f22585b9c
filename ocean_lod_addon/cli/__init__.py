# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: `python -m ocean_lod_addon SUB` and `blender --command ocean_lod SUB` are the same program."""

import argparse
import sys

from ..core.errors import OceanError
from . import bench, cost, effects, explain, render, sea, slopes, swim

EXIT_OK = 0
EXIT_FAILED = 1  # the machine or Blender failed
EXIT_BAD_INPUT = 2  # something to mend in the command or its files; argparse uses the same
EXIT_INTERRUPTED = 130

_COMMANDS = (render, sea, explain, slopes, swim, bench, cost, effects)


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, without the usage."""

    def error(self, message):
        self.exit(EXIT_BAD_INPUT, f"{self.prog}: {message}\n")


def parser() -> argparse.ArgumentParser:
    """The parser of the whole program."""
    top = _Parser(prog="ocean_lod", description="A physically calibrated ocean for film shots.")
    commands = top.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in _COMMANDS:
        sub = commands.add_parser(command.NAME, help=command.HELP, description=command.HELP)
        command.add_arguments(sub)
        sub.set_defaults(run=command.run)
    return top


def main(arguments) -> int:
    """Run one command; returns the exit code. Errors an artist can mend are one line on the error stream."""
    try:
        options = parser().parse_args(arguments)
    except SystemExit as stop:  # argparse has said why
        return stop.code or EXIT_OK
    try:
        options.run(options)
    except OceanError as error:
        print(f"ocean_lod: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except RuntimeError as error:  # how bpy reports what went wrong inside Blender
        print(f"ocean_lod: {str(error).strip()}", file=sys.stderr)
        return EXIT_FAILED
    except KeyboardInterrupt:
        print("ocean_lod: interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED
    return EXIT_OK
