# SPDX-License-Identifier: GPL-3.0-or-later
"""`bench`: the time that a frame takes, beside what it is made of and what there is to compare it with."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

from ...core.contraction import CONTRACTIONS, fastest_contraction
from ...core.errors import OceanError
from ..results import json_output, save_json
from . import in_blender, measurements, plot, suite

NAME = "bench"
HELP = "Measure the time of a frame, beside its bare matrix products and Blender's Ocean modifier."


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "--full", action="store_true", help="the whole table, 16 k to 4 M vertices times 16 to 512 waves; minutes"
    )
    parser.add_argument(
        "--contraction", choices=tuple(CONTRACTIONS), help="how matrices are multiplied (what suits this NumPy)"
    )
    parser.add_argument(
        "--numpy-without-blas", metavar="PYTHON", help="measure too with this interpreter, whose NumPy has no BLAS"
    )
    parser.add_argument("--output", default="out/bench.json", metavar="FILE", help="results as JSON (%(default)s)")


def run(options) -> None:
    """Measure, print and save. Raises OceanError for bad arguments, before anything is measured."""
    if options.numpy_without_blas:
        _check_without_blas(options.numpy_without_blas)
    output = json_output(options.output)
    plan = measurements.FULL if options.full else measurements.QUICK
    contraction = options.contraction or fastest_contraction()
    results = suite.measure_and_print(plan, contraction, in_blender.is_available())
    saved = results.as_mapping()
    if options.numpy_without_blas:
        saved["numpy_without_blas"] = _measure_without_blas(options)
    save_json(output, saved)
    if plot.save_plot(results.rows, str(results.machine), output.with_suffix(".png")):
        print(f"saved {output.with_suffix('.png')}", flush=True)
    else:
        print("no plot: the Python package matplotlib is not installed here", flush=True)


_PACKAGE = __package__.split(".")[-3]
_FOLDER = Path(__file__).resolve().parents[3]


def _run_with(python, arguments, **settings):
    environment = os.environ | {"PYTHONPATH": str(_FOLDER)}
    return subprocess.run([python, *arguments], env=environment, text=True, check=False, **settings)


def _check_without_blas(python):
    probe = f"from {_PACKAGE}.core.contraction import blas_library; print(blas_library())"
    try:
        done = _run_with(python, ["-c", probe], capture_output=True)
    except OSError as error:
        raise OceanError(f"--numpy-without-blas {python}: can not be run: {error.strerror}") from None
    if done.returncode:
        reason = done.stderr.strip().splitlines()[-1:] or ["it fails"]
        raise OceanError(f"--numpy-without-blas {python}: can not be used: {reason[0]}")
    if done.stdout.strip():
        raise OceanError(f"--numpy-without-blas {python}: its NumPy has a BLAS, {done.stdout.strip()}")


def _measure_without_blas(options):
    """The same measurement by another interpreter; what it prints appears here."""
    print(f"\nThe same with {options.numpy_without_blas}, whose NumPy has no BLAS\n", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "bench.json"
        arguments = ["-m", _PACKAGE, NAME, "--output", str(output), *(["--full"] if options.full else [])]
        done = _run_with(options.numpy_without_blas, arguments)
        if done.returncode:
            raise RuntimeError(f"{options.numpy_without_blas} ended with exit code {done.returncode}")
        return json.loads(output.read_text(encoding="utf-8"))
