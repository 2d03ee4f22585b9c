# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure all hard cases and write docs/hard-cases.md. Run by `make hard-cases`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.hard_cases.catalogue import TABLE, table

TABLE.parent.mkdir(exist_ok=True)
TABLE.write_text(table(), encoding="utf-8")
print(f"wrote {TABLE.name}")
