# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the tables of docs/sea-state.md anew from the package, which is where everything in them is said.

    python tools/sea_state_tables.py

A table stands between the lines <!-- table: NAME --> and <!-- end of table -->. Needs NumPy.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from ocean_lod_addon.cli.setting_options import option_name  # noqa: E402  (the checkout is on no path before)
from ocean_lod_addon.core import presets  # noqa: E402
from ocean_lod_addon.core.ocean_time import OceanTime  # noqa: E402
from ocean_lod_addon.core.parameters import (  # noqa: E402
    Choice,
    Integer,
    Number,
    Switch,
    allowed_text,
    file_key,
    parameters_of,
    to_file_value,
)
from ocean_lod_addon.core.readback import theoretical_statistics, wind_axis  # noqa: E402
from ocean_lod_addon.core.readback_text import quantity  # noqa: E402
from ocean_lod_addon.core.sea import Sea, WaveSystem  # noqa: E402
from ocean_lod_addon.core.shot import Shot  # noqa: E402
from ocean_lod_addon.core.spectra.table import SPECTRA  # noqa: E402
from ocean_lod_addon.core.spreading.table import SPREADINGS  # noqa: E402

DOCUMENT = ROOT / "docs" / "sea-state.md"
_BLOCK = re.compile(r"(<!-- table: (\w+) -->\n).*?(<!-- end of table -->)", re.DOTALL)


def table(heading: list[str], rows: list[list[str]]) -> str:
    """A Markdown table."""
    lines = [heading, ["---"] * len(heading), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)


def presets_table() -> str:
    """The presets that come with the extension, with what their spectra say of them."""
    rows = []
    for name in presets.names():
        preset = presets.load(name)
        statistics = theoretical_statistics(preset.sea, wind_axis(preset.sea))
        height = quantity(statistics.significant_wave_height, "m")
        rows.append([f"`{name}`", preset.description, height, quantity(statistics.peak_period, "s")])
    return table(["Preset", "What it is", "Hs", "Tp"], rows)


def spectra_table() -> str:
    """The spectra, and what each depends on."""
    labels = {name: parameter.label for name, parameter in parameters_of(WaveSystem).items()}
    rows = []
    for key, kind in SPECTRA.items():
        by_wind = ", ".join(labels[name] for name in kind.wind_settings)
        by_height = ", ".join(labels[name] for name in kind.height_settings)
        rows.append(
            [kind.option.label, f"`{key}`", kind.option.description, by_wind, by_height,
             f"{kind.wind_height:g} m", kind.source]
        )  # fmt: skip
    heading = ["Spectrum", "Key", "What it is", "Sized by wind", "Sized by height", "Wind at", "Source"]
    return table(heading, rows)


def spreadings_table() -> str:
    """The spreading laws."""
    rows = [
        [kind.option.label, f"`{key}`", kind.option.description,
         "-" if kind.wind_height is None else f"{kind.wind_height:g} m", kind.source]
        for key, kind in SPREADINGS.items()
    ]  # fmt: skip
    return table(["Spreading", "Key", "What it is", "Wind at", "Source"], rows)


def _default(parameter):
    value = to_file_value(parameter.default, parameter)
    match parameter:
        case Switch():
            return "on" if value else "off"
        case Choice():
            return f"`{value}`"
        case Number(unit="rad"):
            return f"{value:g}°"
        case Number() | Integer():
            return f"{value:g} {parameter.unit}".rstrip()
    return str(value)


def _allowed(parameter):
    if isinstance(parameter, Choice):
        return ", ".join(f"`{option.key}`" for option in parameter.options)
    if isinstance(parameter, Switch):
        return "on or off"
    return allowed_text(parameter)


def settings_table(settings_class, with_file_keys=True) -> str:
    """The settings of a class: in the panel, in files, their meaning, default and range."""
    rows = []
    for name, parameter in parameters_of(settings_class).items():
        key = file_key(name, parameter) if with_file_keys else option_name(name)
        rows.append([parameter.label, f"`{key}`", parameter.description, _default(parameter), _allowed(parameter)])
    return table(["Setting", "In files" if with_file_keys else "Option", "Meaning", "Default", "Allowed"], rows)


TABLES = {
    "presets": presets_table,
    "spectra": spectra_table,
    "spreadings": spreadings_table,
    "wave_system": lambda: settings_table(WaveSystem),
    "sea": lambda: settings_table(Sea),
    "shot": lambda: settings_table(Shot),
    "clock": lambda: settings_table(OceanTime, with_file_keys=False),
}


def with_tables(text: str) -> str:
    """The document with all its tables written anew."""
    return _BLOCK.sub(lambda match: f"{match[1]}{TABLES[match[2]]()}\n{match[3]}", text)


if __name__ == "__main__":
    DOCUMENT.write_text(with_tables(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
