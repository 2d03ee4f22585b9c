# SPDX-License-Identifier: GPL-3.0-or-later
"""The bump of one ocean: its bands, their slope variances, and their images at any time."""

import itertools
from dataclasses import dataclass

import numpy as np

from ..lod import Grid
from ..ripple_settings import Ripples
from ..roughness import along_across, roughening_system
from ..sea import Sea
from ..spectra.moments import significant_wave_height
from ..waves import TWO_PI, WaveSet
from .handover import bump_amplitudes, handed_over_count
from .layout import Band, Tile, random_tiles, ripple_tiles
from .spectrum import RippleSpectrum, levels_for, ripple_spectrum, slope_tensor_between
from .synthesis import TileSynthesis, tile_syntheses

_ISOTROPIC_MOMENTS = np.array([[3.0, 1.0], [1.0, 3.0]]) / 8.0
"""Means of cos^4, cos^2 sin^2 and sin^4 over all directions."""


@dataclass(frozen=True)
class BumpLayout:
    """What the shader of a bump is built from.

    tiles        the images, from long waves to short
    handed_over  number of bands, from the longest on, that the mesh shows in part
    kind         "spectral" or "random"
    gusts        whether gusts strengthen and weaken the bands that the mesh never shows
    """

    tiles: tuple[Tile, ...]
    handed_over: int
    kind: str
    gusts: bool = False

    @property
    def bands(self) -> tuple[Band, ...]:
        """The bands of all tiles, from long to short."""
        return tuple(band for tile in self.tiles for band in tile.bands)


class Bump:
    """The ripples of a sea on a mesh, for settings that are not off."""

    def __init__(self, settings: Ripples, sea: Sea, grid: Grid, waves: WaveSet):
        self._settings, self._sea, self._grid, self._waves = settings, sea, grid, waves
        self.layout = bump_layout(settings, grid.shortest_wavelength)
        spectrum = ripple_spectrum(sea, grid.shortest_wavelength)
        density = spectrum.density
        if settings.kind == "random":
            density = random_density(spectrum, settings.shortest_wavelength, self.layout.bands)
        self._syntheses: tuple[TileSynthesis, ...] = tile_syntheses(density, sea, self.layout.tiles)
        self.tensors = np.concatenate([synthesis.tensors for synthesis in self._syntheses])

    @property
    def moves(self) -> bool:
        """Whether the images change with time."""
        return self._settings.kind == "spectral"

    @property
    def wave_height(self) -> float:
        """Significant height of the waves of the mesh, m."""
        return significant_wave_height(0.5 * float(np.sum(self._waves.amplitude**2)))

    def image(self, number: int, time: float, out: np.ndarray) -> None:
        """Write tile `number` at `time` in s into `out`, (texels, texels, 4) float32; a still one at any time."""
        self._syntheses[number].image(time if self.moves else 0.0, out)

    def amplitudes(self) -> np.ndarray:
        """Roots of the shares that the bump shows of the bands handed over, (vertices, bands) float32."""
        count = self.layout.handed_over
        return bump_amplitudes(self._grid, self._waves, self.layout.bands[:count], self.tensors[:count])


def bump_layout(settings: Ripples, shortest_resolved: float) -> BumpLayout:
    """The layout of ripples that are not off, on a mesh that shows waves down to `shortest_resolved` in m."""
    make_tiles = random_tiles if settings.kind == "random" else ripple_tiles
    tiles = make_tiles(settings, shortest_resolved)
    bands = [band for tile in tiles for band in tile.bands]
    return BumpLayout(tiles, handed_over_count(bands, shortest_resolved), settings.kind, settings.gusts)


def random_density(spectrum: RippleSpectrum, shortest: float, bands: tuple[Band, ...]):
    """A density over (kx, ky) of one image that stands for all ripples that the mesh does not show.

    Its slopes have the same variance in every octave, and altogether the tensor of the ripples from the bands'
    longest wave down to `shortest` in m; its directions say nothing of where waves come from.
    """
    low, high = bands[-1].shortest, bands[0].longest
    edges = np.geomspace(min(shortest, low), high, 9)
    wanted = sum(slope_tensor_between(spectrum.density, a, b) for a, b in itertools.pairwise(edges))
    rough = roughening_system(spectrum.sea)
    direction = 0.0 if rough is None else spectrum.sea.systems[rough].direction
    moments = _ISOTROPIC_MOMENTS * TWO_PI * np.log(high / low)
    along, across = levels_for(np.array(along_across(wanted, direction)), moments)

    def density(kx, ky):
        k = np.hypot(kx, ky)
        theta = np.arctan2(ky, kx) - direction
        return (along * np.cos(theta) ** 2 + across * np.sin(theta) ** 2) / np.maximum(k, 1.0 / high) ** 4

    return density
