# SPDX-License-Identifier: GPL-3.0-or-later
"""The Beaufort scale of the World Meteorological Organization, by the mean wind 10 m above the sea."""

from bisect import bisect_right
from dataclasses import dataclass


@dataclass(frozen=True)
class BeaufortForce:
    """One force: its name and the lowest wind in m/s that counts as it."""

    number: int
    name: str
    lowest_wind: float


_NAMES_AND_WINDS = (
    ("Calm", 0.0),
    ("Light air", 0.3),
    ("Light breeze", 1.6),
    ("Gentle breeze", 3.4),
    ("Moderate breeze", 5.5),
    ("Fresh breeze", 8.0),
    ("Strong breeze", 10.8),
    ("Near gale", 13.9),
    ("Gale", 17.2),
    ("Strong gale", 20.8),
    ("Storm", 24.5),
    ("Violent storm", 28.5),
    ("Hurricane", 32.7),
)

BEAUFORT_SCALE = tuple(BeaufortForce(n, name, wind) for n, (name, wind) in enumerate(_NAMES_AND_WINDS))


def beaufort_force(wind_speed: float) -> BeaufortForce:
    """The force of the wind U10 >= 0 in m/s."""
    return BEAUFORT_SCALE[bisect_right([force.lowest_wind for force in BEAUFORT_SCALE], wind_speed) - 1]


def typical_wind(number: int) -> float:
    """The wind U10 in m/s in the middle of force `number`: v = 0.836 B^1.5."""
    return 0.836 * number**1.5
