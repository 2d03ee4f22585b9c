# SPDX-License-Identifier: GPL-3.0-or-later
"""Every golden value, computed elsewhere in 50 digits, against the public functions of core.

The file is tests/data/golden.json, or the one that the environment variable OCEAN_LOD_GOLDEN names. Each output
must agree within the tolerance that its case states for float64; a case that no function answers for fails.
"""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from tests.core import golden_optics, golden_waves

GOLDEN_FILE = Path(os.environ.get("OCEAN_LOD_GOLDEN") or Path(__file__).parents[1] / "data" / "golden.json")
GOLDEN_CASES = json.loads(GOLDEN_FILE.read_text(encoding="utf-8"))["cases"]

FUNCTIONS = golden_waves.CASES | golden_optics.CASES


def case_id(case):
    inputs = ",".join(f"{name}={value}" for name, value in case["in"].items())
    return f"{case['name']}[{inputs}]"[:100]


def mismatches(actual, expected, rtol, where):
    """Lines that say where `actual` leaves `expected`, a decimal or hexadecimal string or a list of such."""
    if isinstance(expected, list):
        if len(actual) != len(expected):
            return [f"{where}: {len(actual)} values instead of {len(expected)}"]
        pairs = zip(actual, expected, strict=True)
        return [line for i, (a, e) in enumerate(pairs) for line in mismatches(a, e, rtol, f"{where}[{i}]")]
    if expected.lower().startswith("0x"):
        value = int(actual, 16) if isinstance(actual, str) else int(actual)
        return [] if value == int(expected, 16) else [f"{where}: {value:#018x} instead of {expected}"]
    value, exact = float(np.asarray(actual).item()), float(expected)
    if value == exact:
        return []
    scale = abs(exact) if exact != 0.0 else 1.0  # of an exact 0 there is no relative error
    if abs(value - exact) <= rtol * scale:
        return []
    return [f"{where}: {value!r} instead of {expected}, off by {abs(value - exact) / scale:.2g} > {rtol:g}"]


def test_the_two_tables_do_not_claim_the_same_case():
    assert not set(golden_waves.CASES) & set(golden_optics.CASES)


@pytest.mark.parametrize("case", GOLDEN_CASES, ids=case_id)
def test_golden(case):
    assert case["name"] in FUNCTIONS, f"no function answers for {case['name']}"
    actual = FUNCTIONS[case["name"]](case["in"])
    missing = sorted(set(case["out"]) - set(actual))
    assert not missing, f"no value for {', '.join(missing)}"
    lines = [
        line
        for name, expected in case["out"].items()
        for line in mismatches(actual[name], expected, case["rtol_f64"], name)
    ]
    assert not lines, "\n".join(lines)
