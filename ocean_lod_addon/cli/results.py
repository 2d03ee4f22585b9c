# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that measurements are saved to."""

import json
import os
from pathlib import Path

from ..core.errors import OceanError


def json_output(text: str) -> Path:
    """The file that --output names, whose folder now exists. Raises OceanError, before anything is measured."""
    output = Path(text).absolute()
    if output.suffix != ".json":
        raise OceanError(f"--output {output.name!r} ends in {output.suffix!r}, allowed is .json")
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _not_written(output, error.strerror) from None
    if output.is_dir() or not os.access(output.parent, os.W_OK):
        raise OceanError(f"--output {output} can not be written")
    return output


def save_json(output: Path, results: dict) -> None:
    """Write results as JSON, all of them or nothing. Raises OceanError."""
    save_text(output, json.dumps(results, indent=2) + "\n")


def save_text(output: Path, text: str) -> None:
    """Write a file, all of it or nothing. Raises OceanError."""
    try:
        partial = output.with_suffix(".part")
        partial.write_text(text, encoding="utf-8", newline="")
        partial.replace(output)
    except OSError as error:
        raise _not_written(output, error.strerror) from None
    print(f"saved {output}", flush=True)


def _not_written(output, reason):
    return OceanError(f"--output {output} can not be written: {reason}")
