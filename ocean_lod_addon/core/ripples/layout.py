# SPDX-License-Identifier: GPL-3.0-or-later
"""Into which bands of wavelengths the ripples are cut, and which bands share an image.

A band is what fades as one: by the share that the mesh shows of it, and by the size of a pixel. The shortest wave
of the mesh is an edge between two bands. An image is a square periodic tile of water with two bands in it, two
channels each; its size follows from the number of texels that its shortest wave needs.
"""

import itertools
import math
from dataclasses import dataclass

from ..ripple_settings import Ripples

TEXELS_PER_WAVE = 8
"""Texels along the shortest wave of an image: a texel is seen at random up to half a texel beside its place."""

WAVES_PER_TILE = 8
"""The longest waves of an image fit at least this often into it, so that it holds waves of many directions."""

BANDS_PER_IMAGE = 2

SLACK = 0.12
"""A band more is worth this share of its width: without it, the others are that much wider together."""


@dataclass(frozen=True)
class Band:
    """Waves shorter than `longest` and at least as long as `shortest`, in m."""

    shortest: float
    longest: float

    @property
    def middle_wavenumber(self) -> float:
        """Geometric middle, rad/m."""
        return 2.0 * math.pi / math.sqrt(self.shortest * self.longest)


@dataclass(frozen=True)
class Tile:
    """An image: the side of the square of water that it shows, m, the texels along it, and one or two bands."""

    size: float
    texels: int
    bands: tuple[Band, ...]


def band_ratio(texels: int) -> float:
    """Largest ratio of the longest to the shortest wave of a band, for images of this many texels a side."""
    return (texels / (TEXELS_PER_WAVE * WAVES_PER_TILE)) ** (1.0 / BANDS_PER_IMAGE)


def bands_between(shortest: float, longest: float, ratio: float) -> tuple[Band, ...]:
    """Equal bands on a logarithmic scale from `longest` down to `shortest`, each of `ratio` or hardly more."""
    count = max(1, math.ceil(math.log(longest / shortest) / math.log(ratio) - SLACK))
    step = (shortest / longest) ** (1.0 / count)
    edges = [longest * step**number for number in range(count)] + [shortest]
    return tuple(Band(low, high) for high, low in itertools.pairwise(edges))


def ripple_bands(settings: Ripples, shortest_resolved: float) -> tuple[Band, ...]:
    """The bands of a sea whose mesh shows waves down to `shortest_resolved` in m, from long to short."""
    ratio = band_ratio(settings.texels)
    shortest, longest = settings.shortest_wavelength, settings.longest_wavelength
    if not shortest * ratio < shortest_resolved * ratio < longest:
        return bands_between(shortest, longest, ratio)
    return bands_between(shortest_resolved, longest, ratio) + bands_between(shortest, shortest_resolved, ratio)


def ripple_tiles(settings: Ripples, shortest_resolved: float) -> tuple[Tile, ...]:
    """The images of these bands, from long to short."""
    bands = ripple_bands(settings, shortest_resolved)
    pairs = [bands[first : first + BANDS_PER_IMAGE] for first in range(0, len(bands), BANDS_PER_IMAGE)]
    return tuple(
        Tile(pair[-1].shortest * settings.texels / TEXELS_PER_WAVE, settings.texels, pair) for pair in pairs
    )


def random_tiles(settings: Ripples, shortest_resolved: float) -> tuple[Tile, ...]:
    """The one image of random slopes, just below the waves of the mesh."""
    longest = min(settings.longest_wavelength, shortest_resolved)
    ratio = band_ratio(settings.texels)
    shortest = longest / ratio**BANDS_PER_IMAGE
    bands = bands_between(shortest, longest, ratio)
    return (Tile(shortest * settings.texels / TEXELS_PER_WAVE, settings.texels, bands),)
