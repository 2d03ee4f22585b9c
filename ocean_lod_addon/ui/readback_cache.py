# SPDX-License-Identifier: GPL-3.0-or-later
"""Sea reports for the panel, computed between redraws: drawing a panel must never take time."""

import time

import bpy

from ..core.discretise import discretise
from ..core.ocean import Ocean
from ..core.readback import SeaReport, sea_report

_PAUSE = 0.3
"""s without another change of the settings before a report is computed: not while a slider is dragged."""

_MOST_REPORTS = 8


class _Reports:
    """The reports of the oceans that were shown last, and the one that is wanted next."""

    def __init__(self):
        self.done: dict[tuple, SeaReport] = {}
        self.latest: SeaReport | None = None
        self.wanted = None
        self.wanted_since = 0.0


_reports = _Reports()


def report_for(ocean: Ocean) -> tuple[SeaReport | None, bool]:
    """The report to show for an ocean, and whether it is of these settings.

    If not, it is the latest there is (None at first), and the right one follows with a redraw of its own.
    """
    key = (ocean.sea, ocean.grid.shortest_wavelength)
    report = _reports.done.get(key)
    if report is not None:
        return report, True
    if _reports.wanted != key:
        _reports.wanted, _reports.wanted_since = key, time.monotonic()
    if not bpy.app.timers.is_registered(compute_wanted):
        bpy.app.timers.register(compute_wanted, first_interval=_PAUSE)
    return _reports.latest, False


def compute_wanted() -> float | None:
    """Blender's timer: compute the report that is wanted, once its settings have rested for a moment."""
    if _reports.wanted is None:
        return None
    left = _reports.wanted_since + _PAUSE - time.monotonic()
    if left > 0.0:
        return left
    sea, shortest_wavelength = _reports.wanted
    report = sea_report(sea, discretise(sea, shortest_wavelength), shortest_wavelength)
    while len(_reports.done) >= _MOST_REPORTS:
        del _reports.done[next(iter(_reports.done))]
    _reports.done[_reports.wanted] = _reports.latest = report
    _reports.wanted = None
    _redraw_sidebars()
    return None


def unregister():
    """Stop computing."""
    _reports.wanted = None
    if bpy.app.timers.is_registered(compute_wanted):
        bpy.app.timers.unregister(compute_wanted)


def _redraw_sidebars():
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
