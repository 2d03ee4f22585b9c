# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a sea: one or more wave systems over one depth of water."""

import math
from dataclasses import dataclass

import numpy as np

from .constants import SURFACE_TENSION_OVER_DENSITY
from .dispersion import Water
from .errors import OutOfRangeError
from .parameters import Option, choice, integer, number, switch, text, validate
from .spectra.table import SPECTRA
from .spreading.table import SPREADINGS

LARGEST_SEED = 2**31 - 1
"""What an integer property of Blender can hold."""

_SIZED_BY = (
    Option("wind", "Wind", "The wind speed, and for some spectra the fetch, make the waves high and long"),
    Option("height", "Wave Height", "You give the significant wave height and, for most spectra, the period"),
)

_PERIODS = (
    Option("peak", "Peak (Tp)", "Period of the most energetic waves"),
    Option("mean", "Mean (T1)", "Average period, m0 / m1 of the spectrum"),
    Option(
        "zero_crossing", "Zero-Crossing (Tz)", "Mean time between two crossings of the still-water level upwards"
    ),
)


@dataclass(frozen=True)
class WaveSystem:
    """Waves with one origin: the local wind sea, or a swell from a distant storm. Energies of systems add."""

    name: str = text("Name", "What you call this wave system", "Wind sea")
    enabled: bool = switch("Enabled", "Whether this wave system takes part", True)
    spectrum: str = choice(
        "Spectrum",
        "How the energy of the waves is shared out over their lengths",
        "pierson_moskowitz",
        [kind.option for kind in SPECTRA.values()],
    )
    sized_by: str = choice("Sized By", "What decides the size of the waves", "wind", _SIZED_BY)
    wind_speed: float = number(
        "Wind",
        "Speed of the wind 10 m above the water, averaged over ten minutes. Formulas for another height get"
        " the wind at that height",
        10.0,
        0.0,
        80.0,
        "m/s",
        soft_maximum=30.0,
    )
    fetch: float = number(
        "Fetch",
        "Distance over which the wind has blown on the water: the longer, the higher and longer the waves, until"
        " they have grown up",
        300e3,
        10.0,
        1e7,
        "m",
        soft_maximum=1e6,
    )
    significant_wave_height: float = number(
        "Height Hs",
        "Significant wave height: mean height, trough to crest, of the highest third of the waves",
        2.0,
        0.0,
        30.0,
        "m",
        soft_maximum=15.0,
    )
    period: float = number(
        "Period", "Time between two crests that pass a fixed point", 8.0, 0.2, 40.0, "s", soft_maximum=20.0
    )
    period_kind: str = choice("Period Is", "Which period you give", "peak", _PERIODS)
    peak_enhancement: float = number(
        "Peakedness",
        "Gamma of JONSWAP and TMA: 1 is a broad spectrum, 3.3 a growing wind sea, above 5 a long-travelled swell",
        3.3,
        1.0,
        20.0,
        soft_maximum=10.0,
    )
    spreading: str = choice(
        "Spreading",
        "How the waves fan out about their mean direction",
        "swop",
        [kind.option for kind in SPREADINGS.values()],
    )
    spreading_exponent: float = number(
        "Exponent",
        "s of the cos^2s law: 1 is a wide fan, 10 a wind sea, 75 a long swell",
        10.0,
        0.1,
        1000.0,
        soft_maximum=100.0,
    )
    direction: float = number(
        "Direction",
        "Where the waves travel to, in degrees, counter-clockwise from +X",
        0.0,
        -2.0 * math.pi,
        2.0 * math.pi,
        "rad",
    )
    directional_cutoff: float = number(
        "Cut-Off",
        "Waves further than this from the mean direction are left out and their energy given to the others;"
        " 180 degrees leaves none out, a few degrees make the long parallel crests of a swell",
        math.pi,
        math.radians(1.0),
        math.pi,
        "rad",
    )
    wave_share: float = number(
        "Wave Share",
        "The number of waves of this system, over the sea's wave count. Shares need not add to 1: adding a system"
        " leaves the waves of the others as they were",
        1.0,
        0.0,
        1.0,
    )
    seed: int = integer("Seed", "Another number gives another sea of the same kind", 0, 0, LARGEST_SEED)

    def __post_init__(self):
        validate(self)


@dataclass(frozen=True)
class Sea:
    """A sea state. Equal seas make equal waves, bit for bit: a sea can be the key of a cache."""

    systems: tuple[WaveSystem, ...] = (WaveSystem(),)
    finite_depth: bool = switch("Finite Depth", "Whether the waves feel the bottom; off is deep water", False)
    depth: float = number("Depth", "Depth of the water at rest", 20.0, 0.05, 1e5, "m", soft_maximum=1000.0)
    surface_tension: bool = switch(
        "Surface Tension",
        "Whether surface tension speeds up waves shorter than about 7 cm",
        False,
    )
    choppiness: float = number(
        "Choppiness",
        "Horizontal over vertical motion of the water: 0 is a rolling height field, 1 is physical (sharp crests,"
        " flat troughs), more is for effect and can fold crests over",
        1.0,
        0.0,
        2.0,
    )
    wave_count: int = integer(
        "Waves", "Number of waves that a system of full share is made of; more is richer and slower", 128, 1, 4096
    )
    directions: int = integer(
        "Per Band",
        "How many waves of neighbouring length share out the fan of directions among them. 1 leaves it to chance;"
        " more makes every band of lengths fan out as its spreading law says",
        8,
        1,
        64,
    )
    seed: int = integer("Seed", "Another number gives another sea of the same kind", 0, 0, LARGEST_SEED)
    loop_period: float = 0.0
    """Time in s after which the sea repeats exactly; 0 never repeats. No parameter of a sea state: it belongs to
    the shot, whose clock makes it of a number of frames (core.ocean_time)."""

    def __post_init__(self):
        if not isinstance(self.systems, tuple) or not all(isinstance(s, WaveSystem) for s in self.systems):
            raise OutOfRangeError("systems", self.systems, "a tuple of wave systems")
        if not 0.0 <= self.loop_period < math.inf:
            raise OutOfRangeError("loop_period", self.loop_period, "0 or more seconds")
        validate(self)

    @property
    def water(self) -> Water:
        """The water that the waves move in."""
        return Water(
            self.depth if self.finite_depth else np.inf,
            SURFACE_TENSION_OVER_DENSITY if self.surface_tension else 0.0,
        )
