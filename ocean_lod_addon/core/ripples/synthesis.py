# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of ripple slopes at any time, by inverse FFT.

The waves of a tile stand on the lattice of wavenumbers 2 pi (i, j) / size. A wave of amplitude A, travelling along
k, has slopes  -A k sin(k.x - omega t + eps):  both components of all waves of a band are the real and the
imaginary part of one complex inverse FFT. Nothing is carried from one time to the next, and phases are draws that
are numbered by band and lattice point: every machine makes the same image of a frame.
"""

from dataclasses import dataclass

import numpy as np

from ..constants import SURFACE_TENSION_OVER_DENSITY
from ..contraction import even_slices, in_threads
from ..discretise import looping_frequency
from ..dispersion import Water, angular_frequency
from ..rng import stream_seed, uniform
from ..sea import Sea
from ..waves import TWO_PI, WaveSet
from .layout import Band, Tile
from .spectrum import slope_tensor_between

RIPPLE_STREAM = 0x52495050
"""The sub-stream of the sea's seed that the phases of ripples are drawn from."""


@dataclass(frozen=True, eq=False)
class BandWaves:
    """The waves of one band of one tile.

    waves     the waves themselves, (n,)
    column    lattice coordinates i, j of each wavenumber, (n,) integers
    row
    tensor    slope variances (xx, yy, xy) that they have together
    """

    waves: WaveSet
    column: np.ndarray
    row: np.ndarray
    tensor: np.ndarray


def band_waves(density, tile: Tile, band: Band, water: Water, loop_period: float, seed: int) -> BandWaves:
    """The waves of a band on the lattice of its tile, with the slope variance of `density`(kx, ky) in the band.

    `density` is a variance density of the elevation in m^4. Amplitudes are those of the density at the lattice
    points, all scaled alike so that the slope variance of the band is exact. A lattice point keeps its phase
    whatever else is in the band.
    """
    step = TWO_PI / tile.size
    reach = int(np.floor(TWO_PI / band.shortest / step))
    i = np.arange(-reach, reach + 1)
    column, row = (axis.ravel() for axis in np.meshgrid(i, i, indexing="xy"))
    k = step * np.hypot(column, row)
    inside = (k > TWO_PI / band.longest) & (k <= TWO_PI / band.shortest)
    column, row, k = column[inside], row[inside], k[inside]
    energy = density(step * column, step * row) * step**2
    slope_variance = np.sum(energy * k**2)
    wanted = slope_tensor_between(density, band.shortest, band.longest)[:2].sum()
    present = energy > 0.0
    if slope_variance <= 0.0 or wanted <= 0.0:
        present[:] = False
    column, row, k, energy = column[present], row[present], k[present], energy[present]
    energy = energy * (wanted / slope_variance if len(energy) else 1.0)
    omega = angular_frequency(k, water)
    if loop_period > 0.0:
        omega = looping_frequency(omega, loop_period)
    number = (row + tile.texels).astype(np.int64) * (4 * tile.texels) + column + tile.texels
    waves = WaveSet(
        np.sqrt(2.0 * energy),
        k,
        omega,
        np.arctan2(row, column),
        TWO_PI * uniform(seed, number),
        np.zeros(len(k)),
        np.zeros(len(k), np.int64),
        loop_period,
    )
    kx, ky = step * column, step * row
    tensor = np.array([np.sum(energy * kx * kx), np.sum(energy * ky * ky), np.sum(energy * kx * ky)])
    return BandWaves(waves, column, row, tensor)


class _BandField:
    """One band's slopes, as a complex image: real part along x, imaginary part along y."""

    def __init__(self, band: BandWaves, texels: int):
        self._waves, self._texels = band.waves, texels
        step = band.waves.wavenumber / np.maximum(np.hypot(band.column, band.row), 1.0)
        k = step * (band.column + 1j * band.row)
        # the inverse FFT divides by the number of texels
        self._coefficient = (0.5j * k * band.waves.amplitude * texels**2).astype(np.complex64)
        self._column, self._row = band.column % texels, band.row % texels
        self._mirrored_column, self._mirrored_row = -band.column % texels, -band.row % texels
        self._columns = np.unique(np.concatenate([self._column, self._mirrored_column]))
        self._position = np.searchsorted(self._columns, self._column)
        self._mirrored_position = np.searchsorted(self._columns, self._mirrored_column)

    @property
    def column_count(self) -> int:
        """Columns of the lattice that have waves."""
        return len(self._columns)

    def fill_spectrum(self, time: float, spectrum: np.ndarray) -> None:
        """Fill zeros of (texels, columns) complex64 at `time` in s: rows j, and the columns i that have waves."""
        phase = self._waves.phase_at(time).astype(np.float32)
        wave = self._coefficient * (np.cos(phase) + 1j * np.sin(phase))
        # i k/2 A e^(i phase) e^(ik.x) and its mirror image, i (-k)/2 A e^(-i phase) e^(-ik.x); two waves that
        # travel against each other share a place
        spectrum[self._row, self._position] = wave
        mirrored = self._coefficient * (np.sin(phase) * 1j - np.cos(phase))
        spectrum[self._mirrored_row, self._mirrored_position] += mirrored

    def along_x(self, along_y: np.ndarray) -> np.ndarray:
        """Slopes of some rows of the image, (rows, texels) complex, from a spectrum transformed along y."""
        full = np.zeros((len(along_y), self._texels), np.complex64)
        full[:, self._columns] = along_y
        return np.fft.ifft(full, axis=1)


class TileSynthesis:
    """The image of one tile at any time."""

    def __init__(self, density, tile: Tile, water: Water, loop_period: float, seed: int):
        """`density`(kx, ky) is a variance density in m^4; every band has a sub-stream of `seed`."""
        self.tile = tile
        bands = [
            band_waves(density, tile, band, water, loop_period, stream_seed(seed, number))
            for number, band in enumerate(tile.bands)
        ]
        self.tensors = tuple(band.tensor for band in bands)
        self._fields = [_BandField(band, tile.texels) for band in bands]

    def image(self, time: float, out: np.ndarray) -> None:
        """Write the slopes at `time` in s into `out`, (texels, texels, 4) float32, indexed [y, x].

        Channels are the slopes along x and along y of the longer band, then of the shorter one.
        """
        texels, fields = self.tile.texels, self._fields
        spectrum = np.zeros((texels, sum(field.column_count for field in fields)), np.complex64)
        spectra = np.split(spectrum, np.cumsum([field.column_count for field in fields])[:-1], axis=1)
        for field, own in zip(fields, spectra, strict=True):
            field.fill_spectrum(time, own)

        def transform_along_y(columns):
            spectrum[:, columns] = np.fft.ifft(spectrum[:, columns], axis=0)

        def transform_along_x(rows):
            for number, (field, own) in enumerate(zip(fields, spectra, strict=True)):
                slopes = field.along_x(own[rows])
                out[rows, :, 2 * number] = slopes.real
                out[rows, :, 2 * number + 1] = slopes.imag
            out[rows, :, 2 * len(fields) :] = 0.0

        in_threads(transform_along_y, line_pieces(spectrum.shape[1], texels))
        in_threads(transform_along_x, line_pieces(texels, texels))


def line_pieces(lines: int, texels: int) -> list[slice]:
    """So many rows or columns of so many texels each, in pieces that threads take."""
    return even_slices(lines, _TEXELS_AT_A_TIME / texels)


_TEXELS_AT_A_TIME = 1 << 17
"""In a thread's turn: complex numbers that mostly stay in a core's cache from one step to the next."""


def ripple_water(sea: Sea) -> Water:
    """The water that ripples move in: always with surface tension, which rules their speed."""
    return Water(sea.water.depth, SURFACE_TENSION_OVER_DENSITY)


def tile_syntheses(density, sea: Sea, tiles: tuple[Tile, ...]) -> tuple[TileSynthesis, ...]:
    """The images of the ripples of a sea whose spectrum is `density`."""
    seed = stream_seed(sea.seed, RIPPLE_STREAM)
    return tuple(
        TileSynthesis(density, tile, ripple_water(sea), sea.loop_period, stream_seed(seed, number))
        for number, tile in enumerate(tiles)
    )
