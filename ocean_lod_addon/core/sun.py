# SPDX-License-Identifier: GPL-3.0-or-later
"""The sun of a scene, as shading needs it."""

import math
from dataclasses import dataclass

import numpy as np

DISC_ANGLE = math.radians(0.53)
"""Angular diameter of the sun seen from the Earth, rad."""


@dataclass(frozen=True)
class Sun:
    """A distant disc of light.

    direction          unit vector from the ground to the sun, world axes
    irradiance         linear RGB on a plane that faces the sun, in the units of Blender's Sun light (W/m^2)
    angular_diameter   rad
    shines_in_eevee    whether EEVEE lights objects with it: with a Sun light, not with a Sky Texture's disc
    """

    direction: tuple[float, float, float]
    irradiance: tuple[float, float, float]
    angular_diameter: float = DISC_ANGLE
    shines_in_eevee: bool = True

    @property
    def strength(self) -> float:
        """Mean of the three channels, to compare suns by."""
        return float(np.mean(self.irradiance))


def disc_slope_variance(angular_diameter):
    """The slope variance that a sun disc of this diameter (rad) adds to a glitter path, per axis.

    A uniform disc of angular radius r has the variance r^2/4 per axis, and light turns by twice the angle that
    a facet turns: r^2/16 (THEORY section 5).
    """
    return angular_diameter * angular_diameter / 64.0
