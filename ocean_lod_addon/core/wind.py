# SPDX-License-Identifier: GPL-3.0-or-later
"""Wind speed at the height that each formula was measured at."""

import math

REFERENCE_HEIGHT = 10.0
"""Where meteorologists, and this extension's settings, give the wind, m."""

PIERSON_MOSKOWITZ_HEIGHT = 19.5
COX_MUNK_HEIGHT = 12.5
JONSWAP_HEIGHT = 10.0
ELFOUHAILY_HEIGHT = 10.0
NEUMANN_HEIGHT = 7.5
SWOP_HEIGHT = 5.0

DRAG_COEFFICIENT = 1.3e-3
"""Drag coefficient of the sea surface at 10 m, of THEORY section 3."""

VON_KARMAN = 0.4


def wind_at_height(wind_speed: float, height: float, drag_coefficient: float = DRAG_COEFFICIENT) -> float:
    """Wind in m/s at `height` in m for the wind `wind_speed` at 10 m: U(z) = U10 (1 + sqrt(Cd)/kappa ln(z/10)).

    The logarithmic profile over a rough surface, THEORY section 3.
    """
    return wind_speed * wind_ratio(height, drag_coefficient)


def wind_ratio(height: float, drag_coefficient: float = DRAG_COEFFICIENT) -> float:
    """U(z) / U10 of the logarithmic profile; `height` in m."""
    return 1.0 + math.sqrt(drag_coefficient) / VON_KARMAN * math.log(height / REFERENCE_HEIGHT)
