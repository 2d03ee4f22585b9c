# SPDX-License-Identifier: GPL-3.0-or-later
"""The work of a frame as the plan decides it: from a scene's facts and an artist's settings to counts."""

import functools

from ..camera_view import CameraView
from ..discretise import discretise
from ..ocean import Ocean
from ..placement import place
from ..plan import Facts, Settings, decide, effective
from .work import Work, work_of

_waves = functools.lru_cache(maxsize=8)(discretise)


def planned_work(facts: Facts, settings: Settings, view: CameraView | None) -> Work:
    """The work of a frame with these settings, seen by a camera in the ocean's coordinates (None without one)."""
    shortest = settings.grid.shortest_wavelength
    plan = decide(facts, settings, _waves(settings.sea, shortest))
    used = effective(settings, plan)
    placement = place(used.grid, used.framing, _waves(used.sea, shortest), view, facts.final)
    ocean = Ocean(used.sea, used.grid, used.framing, used.ripples, used.foam)
    visible = None if placement.visible is None else tuple(placement.visible.tolist())
    return _work(ocean, plan.blocks, visible, placement.wave_limit)


@functools.lru_cache(maxsize=256)
def _work(ocean, blocks, visible, wave_limit):
    """Kept, since a panel asks for the same at every redraw."""
    return work_of(ocean, _waves(ocean.sea, ocean.grid.shortest_wavelength), blocks, visible, wave_limit)
