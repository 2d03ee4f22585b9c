# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the plane stands in one frame, which of its tiles move and with how many waves."""

import math
from dataclasses import dataclass

import numpy as np

from .camera_view import CameraView, frame_planes, plane_centre, visible_tiles
from .carried import carried, carried_at_any_time
from .constants import EARTH_RADIUS
from .framing import Framing
from .lod import Grid, level_anchors
from .waves import WaveSet


@dataclass(frozen=True, eq=False)
class Placement:
    """`anchors` (levels, 2) m; `visible` a bool for each tile, or None where every tile moves; `wave_limit` how
    many waves, the longest, at most."""

    anchors: np.ndarray
    visible: np.ndarray | None = None
    wave_limit: int | None = None

    @property
    def sees_water(self) -> bool:
        """Whether any part of the plane is worth moving."""
        return self.visible is None or bool(self.visible.any())


def place(
    grid: Grid,
    framing: Framing,
    waves: WaveSet,
    view: CameraView | None,
    final: bool,
    moment: float | None = None,
) -> Placement:
    """The placement of a plane for a camera (None if the scene has none); a function of its arguments alone.

    `final` says that a picture is rendered: tiles outside the frame and its margin stay flat, if the settings ask
    for it, and all waves move. Otherwise the viewport shows the whole plane, with the share of waves set for it.
    A picture of one `moment` (s) needs fewer tiles than one that may show any, or several while a shutter is open.
    """
    centre = plane_centre(grid, view) if view is not None and framing.centre == "CAMERA" else (0.0, 0.0)
    anchors = level_anchors(grid, centre)
    if not final:
        share = framing.viewport_share
        return Placement(anchors, wave_limit=None if share == 1.0 else math.ceil(share * len(waves)))
    if view is None or not framing.only_in_view:
        return Placement(anchors)
    tiles = carried_at_any_time(grid, waves) if moment is None else carried(grid, anchors, waves, moment)
    radius = EARTH_RADIUS if framing.curved_earth else np.inf
    planes = frame_planes(view, framing.view_margin)
    return Placement(anchors, visible_tiles(grid, anchors, planes, tiles, radius))
