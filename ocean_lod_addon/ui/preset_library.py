# SPDX-License-Identifier: GPL-3.0-or-later
"""Sea presets that can be chosen: those that come with the extension, and the artist's own."""

import functools
from pathlib import Path

import bpy

from ..core import presets
from ..core.errors import OceanError

FIRST_CHOICE = "moderate"
_BEAUFORT = "beaufort_"
_EXTENSION_DEPTH = 3
"""bl_ext.REPOSITORY.EXTENSION: how an installed extension's package is called."""

_texts_kept: dict[str, list[tuple]] = {}
"""Blender does not keep the texts of a dynamic enum alive: Python must."""


def user_folder() -> Path:
    """Where the artist's presets are: the folder that Blender gives an extension for files of its own.

    Blender removes it when the extension is uninstalled, not when it is updated. A package that is not installed
    as an extension, but imported from a checkout, has a folder among Blender's data files.
    """
    parts = __package__.split(".")
    if parts[0] == "bl_ext":
        return Path(bpy.utils.extension_path_user(".".join(parts[:_EXTENSION_DEPTH]), path="presets"))
    return Path(bpy.utils.user_resource("DATAFILES", path="ocean_lod/presets"))


def built_in_names() -> list[str]:
    """Names of the presets that come with the extension: looks, then the Beaufort scale."""
    return sorted(presets.names(), key=lambda name: (name.startswith(_BEAUFORT), name))


def user_names() -> list[str]:
    """Names of the artist's presets; a file called like a built-in preset is not one of them."""
    taken = set(built_in_names())
    return [name for name in presets.names(user_folder()) if name not in taken]


def path_of(name: str) -> Path:
    """The file of a preset, whether it exists or not; built-in ones come first."""
    folder = presets.FOLDER if name in built_in_names() else user_folder()
    return folder / f"{name}.json"


def load(name: str) -> presets.Preset:
    """The preset called `name`. Raises OceanError."""
    path = path_of(name)
    if not path.is_file():
        allowed = ", ".join(built_in_names() + user_names())
        raise OceanError(f"unknown preset {name!r}, allowed is one of {allowed}")
    return presets.read(path)


def save(name: str, preset: presets.Preset) -> Path:
    """Write the artist's preset `name`, over one that exists. Raises OceanError; returns the file."""
    check_new_name(name)
    path = path_of(name)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OceanError(f"{path.parent}: can not be made: {error.strerror}") from None
    presets.write(preset, path)
    return path


def check_new_name(name: str) -> None:
    """Raise OceanError unless a preset of the artist's can be called `name`."""
    presets.check_name(name)
    if name in built_in_names():
        raise OceanError(f"preset {name!r} comes with the extension, give yours another name")


def remove(name: str) -> None:
    """Delete the artist's preset `name`. Raises OceanError."""
    if name not in user_names():
        raise OceanError(f"preset {name!r} is none of yours")
    try:
        path_of(name).unlink()
    except OSError as error:
        raise OceanError(f"{path_of(name)}: can not be removed: {error.strerror}") from None


def items(_operator, _context) -> list[tuple]:
    """Enum items of all presets, in columns."""
    groups = {"Looks": [], "Beaufort Scale": [], "Yours": user_names()}
    for name in built_in_names():
        groups["Beaufort Scale" if name.startswith(_BEAUFORT) else "Looks"].append(name)
    numbers = {name: number for number, name in enumerate(built_in_names() + groups["Yours"])}
    listed = []
    for heading, names in groups.items():
        if names:
            listed.append(("", heading, ""))
            listed.extend((name, *_label(path_of(name)), "NONE", numbers[name]) for name in names)
    return _keep("all", listed)


def user_items(_operator, _context) -> list[tuple]:
    """Enum items of the artist's presets."""
    return _keep("user", [(name, *_label(path_of(name))) for name in user_names()])


def first_choice() -> int:
    """Number of the item that a new ocean begins with."""
    return built_in_names().index(FIRST_CHOICE)


def _keep(key, listed):
    _texts_kept[key] = listed
    return listed


def _label(path):
    try:
        changed = path.stat().st_mtime_ns
    except OSError:  # removed meanwhile
        changed = 0
    return _label_of_version(path, changed)


@functools.lru_cache(maxsize=256)
def _label_of_version(path, _changed):
    """Title and description; a file with an error says so where its description would be."""
    try:
        preset = presets.read(path)
    except OceanError as error:
        return path.stem, str(error)
    return preset.title or path.stem.replace("_", " ").capitalize(), preset.description
