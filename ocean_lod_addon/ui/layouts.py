# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of panels: settings by name, lines of text and numbers that fit the sidebar's width."""

import textwrap

_PIXELS_PER_LETTER = 6.5
"""Mean width of a letter of the interface's font at scale 1, a little too wide rather than too narrow."""

_MARGIN = 60.0
"""Pixels beside the text: icon, frame, scroll bar."""


def draw_settings(layout, group, names) -> None:
    """The settings `names` of a property group, one below the other."""
    column = layout.column()
    for name in names:
        column.prop(group, name)


def draw_lines(layout, lines, name_share=0.55) -> None:
    """Lines of `core.readback_text`: name, and its values in columns."""
    column = layout.column(align=True)
    for line in lines:
        row = column.split(factor=name_share)
        row.label(text=line.name)
        values = row.split()
        for value in line.values:
            cell = values.row()
            cell.alignment = "RIGHT"
            cell.label(text=value)


def draw_text(context, layout, text, icon="NONE") -> None:
    """A text of any length, broken into lines of the sidebar's width."""
    pixels = context.region.width - _MARGIN * context.preferences.system.ui_scale
    letters = max(20, int(pixels / (_PIXELS_PER_LETTER * context.preferences.system.ui_scale)))
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, letters)):
        column.label(text=line, icon=icon if number == 0 else "BLANK1" if icon != "NONE" else "NONE")
