# SPDX-License-Identifier: GPL-3.0-or-later
"""A first shot of a sea: where the camera and the sun stand. For the command line and for demonstration."""

import math
from dataclasses import dataclass

import numpy as np

from .camera_view import CameraView
from .parameters import number, validate

_SENSOR_WIDTH = 36.0  # mm


@dataclass(frozen=True)
class Shot:
    """Camera above the origin looking along +x, and a sky with the sun in it."""

    camera_height: float = number(
        "Camera Height", "Height of the lens above the mean water level", 3.0, 0.2, 20e3, "m", soft_maximum=100.0
    )
    camera_pitch: float = number(
        "Camera Pitch",
        "Angle of the view below the horizon; negative looks up",
        math.radians(4.0),
        -math.pi / 2,
        math.pi / 2,
        "rad",
    )
    focal_length: float = number(
        "Focal Length", "Focal length of the lens on a 36 mm wide sensor", 35.0, 1.0, 5000.0, "mm", 200.0
    )
    sun_elevation: float = number(
        "Sun Elevation", "Height of the sun above the horizon", math.radians(20.0), 0.0, math.pi / 2, "rad"
    )
    sun_azimuth: float = number(
        "Sun Azimuth",
        "Direction to the sun, counter-clockwise from +X, where the camera looks to",
        math.radians(-8.0),
        -math.pi,
        math.pi,
        "rad",
    )
    exposure: float = number(
        "Exposure", "Exposure of the picture in stops, over what suits a daylight sky", 0.0, -20.0, 20.0
    )

    def __post_init__(self):
        validate(self)

    def view(self, width: int, height: int) -> CameraView:
        """What the camera sees in a picture of width x height pixels; the wider side shows the whole sensor."""
        half = 0.5 * _SENSOR_WIDTH / self.focal_length / max(width, height)
        cos, sin = math.cos(self.camera_pitch), math.sin(self.camera_pitch)
        axes = np.array([[0.0, -1.0, 0.0], [sin, 0.0, cos], [cos, 0.0, -sin]])
        extent = (-half * width, half * width, -half * height, half * height)
        return CameraView(np.array([0.0, 0.0, self.camera_height]), axes, extent)
