# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/hard-cases.md is what its generator makes of the tests."""

from tests.hard_cases.catalogue import CAUSES, FOLDER, TABLE, table, without_errors


def test_the_committed_table_is_up_to_date():
    """All but the measured digits, which each test checks against its bound anyway."""
    assert without_errors(TABLE.read_text(encoding="utf-8")) == table(measured=False), "run: make hard-cases"


def test_every_file_of_hard_cases_is_in_the_catalogue():
    files = {path.stem.removeprefix("test_hard_") for path in FOLDER.glob("test_hard_*.py")}
    assert files == {cause for cause, _ in CAUSES}
