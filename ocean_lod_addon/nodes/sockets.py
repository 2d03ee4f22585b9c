# SPDX-License-Identifier: GPL-3.0-or-later
"""The sockets that several node groups share, described once."""

import math

from ..core.sun import DISC_ANGLE
from .groups import Socket

SLOPE_VARIANCE = Socket(
    "Slope Variance",
    "VECTOR",
    "Variance of the slopes that the mesh does not show, as (xx, yy, xy) in the object's axes, from the "
    "mesh attribute ocean_slope_variance. Dimensionless",
    hide_value=True,
)
ROUGHNESS = Socket(
    "Roughness",
    "FLOAT",
    "Factor on the root mean square slope of the unresolved waves. 1 is physical",
    1.0,
    0.0,
    4.0,
)
MAJOR_VARIANCE = Socket(
    "Major Variance",
    "FLOAT",
    "Slope variance along the rougher axis. Dimensionless",
    0.02,
    0.0,
    1.0,
)
MINOR_VARIANCE = Socket(
    "Minor Variance",
    "FLOAT",
    "Slope variance along the smoother axis. Dimensionless",
    0.02,
    0.0,
    1.0,
)
TANGENT = Socket(
    "Tangent", "VECTOR", "Unit vector along the rougher axis, in world space", hide_value=True
)
MEAN_FRESNEL = Socket(
    "Mean Fresnel",
    "FLOAT",
    "Share of the light that the visible facets reflect, averaged over their slopes",
    0.02,
    0.0,
    1.0,
    "FACTOR",
)
WATER_COLOR = Socket(
    "Water Color",
    "COLOR",
    "Reflectance of the water itself: light that went in, was scattered and came out again, over light that "
    "fell on the sea. Linear RGB",
    (0.002, 0.012, 0.03, 1.0),
)
BSDF = Socket("BSDF", "SHADER")
SUN_DIRECTION = Socket(
    "Sun Direction", "VECTOR", "Unit vector from the ground to the sun, in world space", (0.0, 0.0, 1.0)
)
SUN_IRRADIANCE = Socket(
    "Sun Irradiance",
    "COLOR",
    "Light of the sun on a plane that faces it, linear RGB in the units of a Sun light's strength (W/m²). Black "
    "for no sun",
    (0.0, 0.0, 0.0, 1.0),
)
SUN_ANGLE = Socket(
    "Sun Angle", "FLOAT", "Angular diameter of the sun", DISC_ANGLE, 0.0, math.pi / 2, "ANGLE"
)
GLITTER_STRENGTH = Socket(
    "Glitter Strength", "FLOAT", "Factor on the brightness of the sun's reflection. 1 is physical", 1.0, 0.0, 4.0
)
