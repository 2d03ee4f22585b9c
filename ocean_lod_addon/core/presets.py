# SPDX-License-Identifier: GPL-3.0-or-later
"""Preset files: a sea state, its water, its foam and a first shot, as JSON with units in the key names.

A preset is data. It is parsed and checked key by key, never executed; every error is one line that names the
file, the key, the value and what is allowed.
"""

import dataclasses
import json
import re
from dataclasses import dataclass, field
from pathlib import Path

from .errors import OceanError, OutOfRangeError
from .foam_settings import Foam
from .material_settings import MaterialSettings
from .parameters import mapping_from_settings, settings_from_mapping
from .sea import LARGEST_SEED, Sea, WaveSystem
from .shot import Shot

SCHEMA_VERSION = 1
FOLDER = Path(__file__).parents[2] / "presets"
"""The presets that come with the extension."""

_SECTIONS = ("schema_version", "title", "description", "sea", "material", "foam", "shot")

FOAM_EFFORT = ("memory_steps",)
"""Settings of foam that are no part of a look: how much is spent on it is up to the quality."""

_LONGEST_NAME = 60
_NOT_IN_FILE_NAMES = frozenset('<>:"/\\|?*')
_NAMES_OF_DEVICES = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
"""Windows takes these for devices, with any ending."""


@dataclass(frozen=True)
class Preset:
    """One preset: what the sea is, what the water and the foam are, and a shot that shows it."""

    title: str = ""
    description: str = ""
    sea: Sea = field(default_factory=Sea)
    material: MaterialSettings = field(default_factory=MaterialSettings)
    foam: Foam = field(default_factory=Foam)
    shot: Shot = field(default_factory=Shot)


def names(folder: Path = FOLDER) -> list[str]:
    """Names of the presets in a folder, sorted."""
    return sorted(path.stem for path in folder.glob("*.json"))


def check_name(name: str) -> None:
    """Raise `OutOfRangeError` unless a preset can have this name, which names its file, on every system."""
    bad_sign = any(c in _NOT_IN_FILE_NAMES or not c.isprintable() for c in name)
    bad_length = not 1 <= len(name) <= _LONGEST_NAME
    if bad_sign or bad_length or name != name.strip(" .") or _NAMES_OF_DEVICES.fullmatch(name):
        raise OutOfRangeError(
            "preset name", name, f"1 to {_LONGEST_NAME} letters, digits, blanks and signs that file names can have"
        )


def load(name: str, folder: Path = FOLDER) -> Preset:
    """The preset called `name` in `folder`, or read from `name` itself if it ends in .json. Raises OceanError."""
    if name.endswith(".json"):
        return read(Path(name))
    if name not in names(folder):
        raise OceanError(f"unknown preset {name!r}, allowed is one of {', '.join(names(folder))}, or a .json file")
    return read(folder / f"{name}.json")


def read(path: Path) -> Preset:
    """The preset in a file. Raises OceanError naming the file and what is wrong with it."""
    try:
        text = path.read_text(encoding="utf-8-sig")  # some editors begin a file with a byte order mark
    except (OSError, UnicodeDecodeError) as error:
        raise OceanError(f"{path.name}: can not be read: {error}") from None
    return parse(text, path.name)


def parse(text: str, where: str) -> Preset:
    """The preset in a text; `where` names it in errors. Raises OceanError."""
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise OceanError(f"{where}: not JSON: {error}") from None
    if not isinstance(content, dict):
        raise OceanError(f"{where}: expected a table of sections, found {type(content).__name__}")
    version = content.get("schema_version")
    if version != SCHEMA_VERSION:
        raise OceanError(f"{where}: schema_version is {version!r}, allowed is {SCHEMA_VERSION}")
    unknown = [key for key in content if key not in _SECTIONS]
    if unknown:
        raise OceanError(f"{where}: unknown key {unknown[0]!r}, allowed is {', '.join(_SECTIONS)}")
    for key in ("title", "description"):
        if not isinstance(content.get(key, ""), str):
            raise OceanError(f"{where}: {key} is {content[key]!r}, allowed is text")
    return Preset(
        content.get("title", ""),
        content.get("description", ""),
        _sea(content.get("sea", {}), f"{where}: sea"),
        settings_from_mapping(MaterialSettings, content.get("material", {}), f"{where}: material"),
        settings_from_mapping(Foam, content.get("foam", {}), f"{where}: foam", left_out=FOAM_EFFORT),
        settings_from_mapping(Shot, content.get("shot", {}), f"{where}: shot"),
    )


def _sea(mapping, where):
    if not isinstance(mapping, dict):
        raise OceanError(f"{where}: expected a table of settings, found {type(mapping).__name__}")
    listed = mapping.get("systems", [{}])
    if not isinstance(listed, list) or not listed:
        raise OceanError(f"{where}: systems is {listed!r}, allowed is a list of one or more wave systems")
    systems = tuple(
        settings_from_mapping(WaveSystem, item, f"{where}: systems[{index}]") for index, item in enumerate(listed)
    )
    own = {key: value for key, value in mapping.items() if key != "systems"}
    return settings_from_mapping(Sea, own, where, systems=systems)


def to_text(preset: Preset) -> str:
    """The preset as the text of a file; `parse` gives an equal preset back."""
    sea = mapping_from_settings(preset.sea)
    sea["systems"] = [mapping_from_settings(system) for system in preset.sea.systems]
    content = {
        "schema_version": SCHEMA_VERSION,
        "title": preset.title,
        "description": preset.description,
        "sea": sea,
        "material": mapping_from_settings(preset.material),
        "foam": mapping_from_settings(preset.foam, left_out=FOAM_EFFORT),
        "shot": mapping_from_settings(preset.shot),
    }
    return json.dumps(content, indent=2) + "\n"


def write(preset: Preset, path: Path) -> None:
    """Write a preset file, whole or not at all. Raises OceanError if the place can not be written."""
    partial = path.with_name(path.name + ".part")
    try:
        partial.write_text(to_text(preset), encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        raise OceanError(f"{path}: can not be written: {error.strerror}") from None


def with_seed(sea: Sea, seed: int) -> Sea:
    """The same sea state with other waves: its seed shifted by `seed`."""
    return dataclasses.replace(sea, seed=(sea.seed + seed) % (LARGEST_SEED + 1))
