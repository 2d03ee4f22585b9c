# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the sea is white at a given wind."""

CALM_BELOW = 4.0
"""Wind at 10 m in m/s below which no waves break."""

_FULL_FROM = 5.0
"""Wind in m/s from which the law holds; between, it sets in smoothly, so that a rising wind does not pop."""

_MOST = 0.8
"""Coverage is held here: far beyond the data that it was fitted to, the law would pass 1 at 39 m/s."""

EFFECTIVE_SHARE = 0.4
"""Reflectance of whitecaps of all ages over that of fresh ones: 22 % over 55 %, Koepke 1984."""


def whitecap_coverage(wind_speed: float) -> float:
    """Share of the sea's area that is white at a wind in m/s at 10 m.

    W = 3.84e-6 U^3.41, Monahan and O'Muircheartaigh 1980.
    """
    onset = min(max((wind_speed - CALM_BELOW) / (_FULL_FROM - CALM_BELOW), 0.0), 1.0)
    return min(onset * onset * (3.0 - 2.0 * onset) * 3.84e-6 * wind_speed**3.41, _MOST) if onset else 0.0
