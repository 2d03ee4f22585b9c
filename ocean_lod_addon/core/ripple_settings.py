# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of the ripples: the waves that are too short for the mesh and long enough for the eye."""

from dataclasses import dataclass

from .errors import OceanError
from .parameters import Option, choice, number, switch, validate


@dataclass(frozen=True)
class Ripples:
    """How the waves between the mesh and the BRDF are shown."""

    kind: str = choice(
        "Ripples",
        "How the waves that are too short for the mesh are shown",
        "spectral",
        (
            Option("off", "Off", "Not at all: as roughness only"),
            Option(
                "random",
                "Random",
                "A still texture of random slopes, stronger on high water: costs nothing per frame, but does not"
                " move as waves do",
            ),
            Option(
                "spectral",
                "Spectral",
                "The short waves of this very sea, each moving at its own speed: images written anew for each"
                " frame",
            ),
        ),
    )
    resolution: str = choice(
        "Resolution",
        "Pixels along each side of a ripple image. A larger image holds more lengths of waves: fewer images to"
        " look up when rendering, more work before each frame",
        "512",
        (
            Option("256", "256", "Least work per frame, most images to look up"),
            Option("512", "512", "The middle way"),
            Option("1024", "1024", "More work per frame, fewer images to look up"),
            Option("2048", "2048", "Most work per frame, fewest images to look up: for stills and comparisons"),
        ),
    )
    shortest_wavelength: float = number(
        "Shortest",
        "Shorter ripples are left to roughness. Twice the size of a pixel on the nearest water is short enough",
        0.006,
        0.001,
        10.0,
        "m",
        soft_maximum=1.0,
    )
    longest_wavelength: float = number(
        "Longest",
        "Longer waves are left to roughness where the mesh is too coarse for them. Four times the height of the"
        " camera is long enough",
        8.0,
        0.05,
        1000.0,
        "m",
        soft_maximum=100.0,
    )

    gusts: bool = switch(
        "Gusts", "Patches of stronger and weaker ripples that drift with the wind, such as cat's paws", False
    )
    gust_strength: float = number(
        "Strength",
        "How far gusts and lulls differ: standard deviation of the logarithm of the ripples' slope variance",
        0.6,
        0.0,
        2.0,
    )
    gust_size: float = number(
        "Size", "Length of a patch along the wind", 150.0, 1.0, 1e5, "m", soft_maximum=1000.0
    )

    def __post_init__(self):
        validate(self)
        if self.longest_wavelength < 2.0 * self.shortest_wavelength:
            raise OceanError(
                f"longest_wavelength is {self.longest_wavelength:g} m, allowed is twice the shortest ripple"
                f" ({self.shortest_wavelength:g} m) or more"
            )

    @property
    def texels(self) -> int:
        """Pixels along each side of an image."""
        return int(self.resolution)
