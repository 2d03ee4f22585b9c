# SPDX-License-Identifier: GPL-3.0-or-later
"""What the measurement ran on, and whether it had that to itself."""

import os
import platform
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ...core.contraction import blas_library
from . import in_blender

_BUSY = 1.25
"""Load average per core above which others were at work too; the measurement itself makes 1 at most."""


@dataclass(frozen=True)
class Machine:
    """Hardware and software, as texts and numbers to print."""

    processor: str
    cores: int
    python: str
    numpy: str
    blas: str
    blender: str

    def as_mapping(self) -> dict:
        """For the saved file."""
        return asdict(self)

    def __str__(self):
        return (
            f"{self.processor}, {self.cores} cores; Python {self.python}, NumPy {self.numpy}, BLAS {self.blas}, "
            f"Blender {self.blender}"
        )


def this_machine(with_blender: bool) -> Machine:
    """The machine that this runs on."""
    return Machine(
        _processor(),
        _cores(),
        platform.python_version(),
        np.__version__,
        blas_library() or "none",
        in_blender.version() if with_blender else "none",
    )


def _processor():
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.partition(":")[2].strip() for line in text.splitlines() if line.startswith("model name")]
    return names[0] if names else platform.machine()


def _cores():
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


def load_average() -> float | None:
    """Processes that wanted to run during the last minute, on average, or None where that is not known."""
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else None


def disturbance() -> str:
    """A warning that other programs ran too, or an empty text."""
    load = load_average()
    if load is None or load <= _BUSY * _cores():
        return ""
    return f"The load average is {load:.1f} on {_cores()} cores: other programs disturbed the measurement."
