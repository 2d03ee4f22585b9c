# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras to look at the sea with, and what they see, by projecting it."""

import math

import numpy as np

from ocean_lod_addon.core.camera_view import CameraView


def camera(height=1.7, pitch=0.0, heading=0.0, lens=35.0, aspect=16 / 9, kind="PERSP", at=(0.0, 0.0)):
    """A level camera, `pitch` rad below the horizon, 36 mm wide sensor; an orthographic one is `lens` m wide."""
    cos, sin = math.cos(pitch), math.sin(pitch)
    forward = np.array([cos * math.cos(heading), cos * math.sin(heading), -sin])
    right = np.array([math.sin(heading), -math.cos(heading), 0.0])
    half = 18.0 / lens if kind == "PERSP" else 0.5 * lens
    return CameraView(
        np.array([*at, height]),
        np.stack([right, np.cross(right, forward), forward]),
        (-half, half, -half / aspect, half / aspect),
        kind,
    )


def projected_inside(view, points):
    """Whether points are in frame, by projecting them: independent of the planes."""
    x, y, depth = view.axes @ (points - view.position).T
    left, right, bottom, top = view.extent
    scale = depth if view.kind == "PERSP" else 1.0
    inside = (x >= left * scale) & (x <= right * scale) & (y >= bottom * scale) & (y <= top * scale)
    return inside & (depth > 0) if view.kind == "PERSP" else inside
