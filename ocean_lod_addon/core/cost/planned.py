# SPDX-License-Identifier: GPL-3.0-or-later
"""The work of a frame as the plan decides it: from a scene's facts and an artist's settings to counts."""

import functools

import numpy as np

from ..camera_view import CameraView
from ..contraction import fastest_contraction
from ..discretise import discretise
from ..lod import tile_sizes
from ..ocean import Ocean
from ..placement import place
from ..plan import Facts, Settings, decide, effective
from .work import Work, work_of

_waves = functools.lru_cache(maxsize=8)(discretise)


def planned_work(
    facts: Facts, settings: Settings, view: CameraView | None, contraction: str | None = None
) -> Work:
    """The work of a frame with these settings, seen by a camera in the ocean's coordinates (None without one).

    `contraction` is one of contraction.CONTRACTIONS, or None for the one that suits this NumPy.
    """
    shortest = settings.grid.shortest_wavelength
    plan = decide(facts, settings, _waves(settings.sea, shortest))
    used = effective(settings, plan)
    placement = place(used.grid, used.framing, _waves(used.sea, shortest), view, facts.final)
    ocean = Ocean(used.sea, used.grid, used.framing, used.ripples, used.foam)
    visible = None if placement.visible is None else placement.visible.tobytes()
    return _work(ocean, plan.blocks, contraction or fastest_contraction(), visible, placement.wave_limit)


@functools.lru_cache(maxsize=256)
def _work(ocean, blocks, contraction, visible, wave_limit):
    """Kept, since a panel asks for the same at every redraw."""
    grid, flags = ocean.grid, None
    if visible is not None:
        flags = np.frombuffer(visible, bool).reshape(tile_sizes(grid.cells, grid.levels).shape)
    waves = _waves(ocean.sea, grid.shortest_wavelength)
    return work_of(ocean, waves, blocks, contraction, flags, wave_limit)
