# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an ocean's plane stands in a frame: the same for all instants of the frame's shutter interval.

A plane that moved its lattice while the shutter is open would smear. So the placement belongs to the frame being
rendered: it is taken from the camera at the frame itself, which Blender evaluates first, and kept for the
sub-frames that the motion blur of this frame asks for. Nothing is kept from one frame to the next.
"""

from dataclasses import dataclass

import numpy as np

from ..core.camera_view import CameraView
from ..core.ocean import Surface
from ..core.placement import Placement
from . import clock


@dataclass(frozen=True)
class _Placed:
    """The placement of an ocean at a frame."""

    frame: float
    surface: Surface
    placement: Placement


_rendered_frames: dict[str, float] = {}
"""The frame being rendered, by scene name; empty while nothing renders."""

_placed: dict[int, _Placed] = {}
"""By the ocean object's session id."""


def begin_rendered_frame(scene) -> None:
    """From now on all frames that Blender evaluates for a scene are instants of its current one."""
    _rendered_frames[scene.name] = clock.current_frame(scene)


def end_rendered_frame(scene) -> None:
    """The frame is done."""
    _rendered_frames.pop(scene.name, None)
    if not _rendered_frames:
        _placed.clear()  # surfaces are large


def placement_of_frame(ob, surface: Surface, scene, depsgraph) -> Placement:
    """The placement of an ocean in the frame being evaluated."""
    now = clock.current_frame(scene)
    frame = _rendered_frames.get(scene.name, now)
    kept = _placed.get(ob.session_uid)
    if now != frame and kept is not None and kept.frame == frame and kept.surface is surface:
        return kept.placement
    view = camera_view(ob.evaluated_get(depsgraph), scene, depsgraph)
    placement = surface.placement(view, final=depsgraph.mode == "RENDER")
    if scene.name in _rendered_frames:
        _placed[ob.session_uid] = _Placed(frame, surface, placement)
    return placement


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
