# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/sea-state.md says what the package does: its tables, its commands, its preset, its pictures."""

import re
import shlex

import pytest

from ocean_lod_addon.cli import parser
from ocean_lod_addon.cli.sea import sea_of
from ocean_lod_addon.core import presets
from tools.sea_state_tables import DOCUMENT, TABLES, with_tables

TEXT = DOCUMENT.read_text(encoding="utf-8")
COMMANDS = re.findall(r"^ +python -m ocean_lod_addon (sea .*)$", TEXT, re.MULTILINE)


def test_tables_are_up_to_date():
    """Truth: writing them anew changes nothing; if this fails, run tools/sea_state_tables.py."""
    assert with_tables(TEXT) == TEXT


def test_every_table_is_in_the_document_and_says_something():
    for name in TABLES:
        (block,) = re.findall(rf"<!-- table: {name} -->\n(.*?)<!-- end of table -->", TEXT, re.DOTALL)
        assert block.count("\n") > 2


def test_a_change_of_a_setting_would_show():
    stale = TEXT.replace("0 to 80 m/s", "0 to 70 m/s")
    assert stale != TEXT
    assert with_tables(stale) == TEXT


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_are_understood(command):
    options = parser().parse_args(shlex.split(command))
    assert options.list or sea_of(options).systems
    if options.plot:
        assert (DOCUMENT.parents[1] / options.plot).is_file()


def test_there_are_commands_and_pictures():
    assert len(COMMANDS) >= 5
    pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", TEXT)
    assert len(pictures) >= 2
    for picture in pictures:
        assert (DOCUMENT.parent / picture).is_file(), picture


def test_the_example_is_a_preset():
    (example,) = re.findall(r"```json\n(.*?)```", TEXT, re.DOTALL)
    preset = presets.parse(example, "example")
    assert preset.title == "Evening swell"
    assert [system.name for system in preset.sea.systems] == ["Breeze", "Swell"]
