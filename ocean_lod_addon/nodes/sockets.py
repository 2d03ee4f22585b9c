# SPDX-License-Identifier: GPL-3.0-or-later
"""The sockets that several node groups share, described once."""

import math

from ..core.sun import DISC_ANGLE
from .groups import Socket

_SUN = "Sun (follows the scene)"
_WIND = "Wind (follows the sea)"

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
REFLECTED_SHARE = Socket(
    "Reflected Share",
    "FLOAT",
    "Share of a uniform sky's light that the surface reflects to the viewer, averaged over the visible slopes",
    0.02,
    0.0,
    1.0,
    "FACTOR",
)
VIEW_COSINE = Socket(
    "View Cosine", "FLOAT", "Cosine of the angle between the normal and the direction to the viewer", 1.0, 0.0, 1.0
)
VIEW_SPREAD = Socket(
    "View Spread",
    "FLOAT",
    "Standard deviation of the slopes along the view, times the sine of the view angle. Dimensionless",
    0.1,
    0.0,
    1.0,
)
WATER_COLOR = Socket(
    "Water Color",
    "COLOR",
    "Reflectance of the water itself: light that went in, was scattered and came out again, over light that "
    "fell on the sea. Linear RGB",
    (0.002, 0.012, 0.03, 1.0),
)
NORMAL = Socket(
    "Normal",
    "VECTOR",
    "Normal of what mesh and bump show of the surface, in world space. Where nothing is linked to the material's "
    "own group it is the mesh's",
    hide_value=True,
)
BSDF = Socket("BSDF", "SHADER")
SUN_DIRECTION = Socket(
    "Sun Direction",
    "VECTOR",
    "Unit vector from the ground to the sun, in world space",
    (0.0, 0.0, 1.0),
    panel=_SUN,
)
SUN_IRRADIANCE = Socket(
    "Sun Irradiance",
    "COLOR",
    "Light of the sun on a plane that faces it, linear RGB in the units of a Sun light's strength (W/m²). Black "
    "for no sun",
    (0.0, 0.0, 0.0, 1.0),
    panel=_SUN,
)
SUN_ANGLE = Socket(
    "Sun Angle", "FLOAT", "Angular diameter of the sun", DISC_ANGLE, 0.0, math.pi / 2, "ANGLE", panel=_SUN
)
GLITTER_STRENGTH = Socket(
    "Glitter Strength", "FLOAT", "Factor on the brightness of the sun's reflection. 1 is physical", 1.0, 0.0, 4.0
)
TINT = Socket(
    "Tint",
    "COLOR",
    "Factor on the color of the water, per channel. White is physical",
    (1.0, 1.0, 1.0, 1.0),
)
FORMULA_SUN = Socket(
    "Formula Sun in Cycles",
    "FLOAT",
    "1 to reflect the sun in Cycles by the formula that EEVEE uses instead of by the closure. The Sun light must "
    "then be invisible to glossy rays",
    0.0,
    0.0,
    1.0,
    "FACTOR",
    panel=_SUN,
)
WIND_SPEED = Socket(
    "Wind Speed",
    "FLOAT",
    "Speed of the wind 12.5 m above the water, m/s: how skewed and peaked the slopes are",
    10.0,
    0.0,
    80.0,
    panel=_WIND,
)
WIND_DIRECTION = Socket(
    "Wind Direction",
    "FLOAT",
    "Where the wind blows to, counter-clockwise from the object's x axis",
    0.0,
    -2.0 * math.pi,
    2.0 * math.pi,
    "ANGLE",
    panel=_WIND,
)
MISSING_SUN = Socket(
    "Missing Sun in EEVEE",
    "FLOAT",
    "1 where EEVEE does not light the sea with this sun, as with the disc of a Sky Texture; 0 for a Sun light",
    0.0,
    0.0,
    1.0,
    "FACTOR",
    panel=_SUN,
)
CYCLES = Socket("Cycles", "SHADER", "Surface for Cycles")
EEVEE = Socket("EEVEE", "SHADER", "Surface for EEVEE")
VOLUME = Socket("Volume", "SHADER", "The water's inside, for Cycles")
ABSORPTION = Socket(
    "Absorption",
    "VECTOR",
    "Absorption of light in the water, per channel of linear RGB, 1/m",
    (0.33, 0.064, 0.034),
)
BACKSCATTERING = Socket(
    "Backscattering",
    "VECTOR",
    "Light that the water throws back, per channel of linear RGB, 1/m",
    (0.0018, 0.0024, 0.0039),
)
EEVEE_DEPTH = Socket(
    "Depth in EEVEE", "FLOAT", "Depth of the bottom that EEVEE reckons with", 10.0, 0.0, 1000.0, "DISTANCE"
)
