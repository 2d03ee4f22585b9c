# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera of a frame, and what is decided for an ocean in it: the same at all instants of its shutter interval.

A plane that moved its lattice while the shutter is open would smear, and so would one that gained or lost an
effect. So the decision belongs to the frame being rendered: it is taken from the scene at the frame itself, which
Blender evaluates first, and kept for the sub-frames that the motion blur of this frame asks for. Nothing is kept
from one frame to the next.
"""

from dataclasses import dataclass

import numpy as np

from ..core.camera_view import CameraView
from ..core.lod import Grid
from ..core.placement import Placement
from ..core.plan import Plan
from . import clock


@dataclass(frozen=True)
class FrameDecision:
    """How an ocean is made in a frame. `placement` is for this `grid`, and None where nothing is to be moved."""

    plan: Plan
    grid: Grid
    placement: Placement | None


_rendered_frames: dict[str, float] = {}
"""The frame being rendered, by scene name; empty while nothing renders."""

_decided: dict[int, tuple[float, FrameDecision]] = {}
"""The frame and what was decided for it, by the ocean object's session id."""


def begin_rendered_frame(scene) -> None:
    """From now on all frames that Blender evaluates for a scene are instants of its current one."""
    _rendered_frames[scene.name] = clock.current_frame(scene)


def end_rendered_frame(scene) -> None:
    """The frame is done."""
    _rendered_frames.pop(scene.name, None)
    if not _rendered_frames:
        _decided.clear()


def decision_of_open_shutter(ob, scene) -> FrameDecision | None:
    """What was decided for the frame being rendered, if the scene is at another of its instants."""
    now = clock.current_frame(scene)
    frame = _rendered_frames.get(scene.name, now)
    decided_for, decision = _decided.get(ob.session_uid, (None, None))
    return decision if decided_for == frame != now else None


def keep_decision(ob, scene, decision: FrameDecision) -> None:
    """Remember what was decided at the scene's current frame while it is rendered."""
    if scene.name in _rendered_frames:
        _decided[ob.session_uid] = (clock.current_frame(scene), decision)


def camera_of_frame(scene):
    """The camera of the scene's current frame, an object, or None.

    Where markers cut from one camera to another this is the marker's: Blender switches the scene's own camera only
    after the handlers of the frame have run.
    """
    bound = [marker for marker in scene.timeline_markers if marker.camera and not marker.camera.hide_render]
    if not bound:
        return scene.camera
    reached = [marker for marker in bound if marker.frame <= scene.frame_current]
    if reached:
        return max(reached, key=lambda marker: marker.frame).camera
    return min(bound, key=lambda marker: marker.frame).camera


def camera_view(ob, scene, depsgraph=None) -> CameraView | None:
    """The camera of the frame in an ocean's own coordinates, or None without a camera."""
    camera = camera_of_frame(scene)
    if camera is None or camera.type != "CAMERA":
        return None
    if depsgraph is not None:
        camera = camera.evaluated_get(depsgraph)
    return view_of(camera, scene, ob.matrix_world.inverted())


def view_of(camera, scene, to_ocean=None) -> CameraView:
    """A camera in an ocean's coordinates; `to_ocean` is the matrix from the world's to them, if they differ."""
    matrix = camera.matrix_world.normalized()
    matrix = np.array(matrix if to_ocean is None else to_ocean @ matrix)
    corners = np.array([corner[:] for corner in camera.data.view_frame(scene=scene)])
    if camera.data.type == "PERSP":
        corners = corners / -corners[:, 2:]
    else:
        corners = corners * scene.unit_settings.scale_length
    extent = (corners[:, 0].min(), corners[:, 0].max(), corners[:, 1].min(), corners[:, 1].max())
    axes = np.stack([matrix[:3, 0], matrix[:3, 1], -matrix[:3, 2]])
    axes /= np.linalg.norm(axes, axis=1)[:, None]  # an ocean in other units than metres is scaled
    return CameraView(matrix[:3, 3], axes, tuple(map(float, extent)), camera.data.type)
