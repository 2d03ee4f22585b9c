# SPDX-License-Identifier: GPL-3.0-or-later
"""The whitecaps of one ocean: columns for the frame kernel, and foam from what it makes of them.

The column of the instant of age tau_j is e_j c(t - tau_j). The waves' phases at that instant are those of now plus
omega tau_j, which goes into the column's weights: all instants share the left factor of the surface.

With distance the mesh leaves out waves, and seen from high above it has none of the short ones anywhere. What is
left of c varies less than the sea's c. It is compared with its own deviation, so that the longer waves break as
often as all of them would; whitecaps grow, and their share of the sea stays. Before they grow too large they go
over into a uniform share of foam:

    foam = fade F + (1 - fade) W.

Crests of c are as large as sqrt(int S_c dk / int k^2 S_c dk), S_c its spectrum. Of the sea of Pierson and
Moskowitz, waves with 0.85 of the variance of c make them 1.6 times as large as all waves do, with 0.6 of it 2.5.
"""

import functools
from dataclasses import dataclass

import numpy as np

from ..column_blocks import ColumnBlock
from ..contraction import in_threads, shares
from ..dispersion import wavenumber
from ..foam_settings import Foam
from ..lod import Grid
from ..quadrature import bin_nodes
from ..roughness import roughening_system
from ..sea import Sea
from ..slope_budget import resolved_sums
from ..spectra.moments import NO_ENERGY_ABOVE, NO_ENERGY_BELOW
from ..spectra.table import spectrum_of
from ..waves import WaveSet
from ..windows import FADE_START, window, window_reach
from .calibration import (
    breaker_wavenumber,
    breaking_weights,
    memory_of,
    ramp_of,
    statistics_of,
    threshold_for,
)
from .whitecap_law import whitecap_coverage

_SMALLEST_VARIANCE = 1e-12
"""Of c; a sea without it has no crest that could break."""

_FADED_AT, _WHOLE_FROM = 0.6, 0.85
"""Shares of the variance of the sea's c: below the first foam is uniform, above the second it is all whitecaps."""

_MOST_COVERAGE = 0.99
"""Of whitecaps; a wholly white sea is uniform foam."""

_CALIBRATED_SHARES = (_FADED_AT, _WHOLE_FROM, 1.0)
"""Between them the threshold changes by a few hundredths of a deviation."""

_SEARCHED_DISTANCES = 64


def sea_wind(sea: Sea) -> float:
    """The wind in m/s at 10 m that makes the whitecaps; 0 without any."""
    rough = roughening_system(sea)
    return 0.0 if rough is None else sea.systems[rough].wind_speed


def sea_coverage(settings: Foam, sea: Sea) -> float:
    """Share of the sea that is white: that of the wind times the artist's factor."""
    return min(settings.coverage * whitecap_coverage(sea_wind(sea)), _MOST_COVERAGE)


def sea_breaker_wavenumber(sea: Sea) -> float:
    """k_b of the sea that the wind roughens, rad/m; where it raises no waves, that of a wave of 10 m."""
    rough = roughening_system(sea)
    spectrum = None if rough is None else spectrum_of(sea.systems[rough], sea.water)
    if spectrum is None:
        return 2.0 * np.pi / 10.0
    return breaker_wavenumber(float(wavenumber(spectrum.peak_frequency, sea.water)))


def sea_breaking_variance(sea: Sea, largest: float) -> float:
    """Variance of c of all waves of the sea, whatever mesh shows them: sum over systems of int b^2 S domega.

    `largest` is k_b in rad/m.
    """
    total = 0.0
    for system in sea.systems:
        spectrum = spectrum_of(system, sea.water)
        if spectrum is not None:
            peak = spectrum.peak_frequency
            nodes = bin_nodes(np.array([NO_ENERGY_BELOW, NO_ENERGY_ABOVE]) * peak, peak)
            weights = breaking_weights(wavenumber(nodes.omega, sea.water), largest)
            total += float(nodes.integrate(weights**2 * spectrum.density(nodes.omega))[0])
    return total


def _variance(breaking, waves):
    return 0.5 * float(np.sum((breaking * waves.amplitude) ** 2))


@dataclass(frozen=True, eq=False)
class _Vertices:
    """(vertices,) float32 each: foam = fade max_j min(e_j, gain column_j - e_j offset) + uniform."""

    gain: np.ndarray
    offset: np.ndarray
    fade: np.ndarray
    uniform: np.ndarray


class Whitecaps:
    """The foam of a sea on a mesh.

    coverage   share of the sea that is white
    memory     the instants that foam is looked for at
    breaking   (waves,) weights in rad/m: c = sum breaking A cos(psi)
    """

    def __init__(self, settings: Foam, sea: Sea, grid: Grid, waves: WaveSet):
        self._grid, self._waves = grid, waves
        self.coverage = sea_coverage(settings, sea)
        self.memory = memory_of(settings)
        largest = sea_breaker_wavenumber(sea)
        self.breaking = breaking_weights(waves.wavenumber, largest)
        self._sea_variance = max(sea_breaking_variance(sea, largest), _variance(self.breaking, waves))

    @functools.cached_property
    def block(self) -> ColumnBlock:
        """A column for each instant."""
        phases = np.exp(1j * np.outer(self._waves.angular_frequency, self.memory.ages))
        weights = self.breaking[:, None] * phases * self.memory.decay
        count = len(self.memory.ages)
        return ColumnBlock(count, lambda _: weights, lambda still: np.zeros((3, len(still.lines), count)))

    @property
    def shown(self) -> np.ndarray:
        """How much of the foam is whitecaps, not a uniform share, (vertices,) float32; static in time."""
        return self._vertices.fade

    @functools.cached_property
    def _vertices(self):
        variance = self._sea_variance
        count = self._grid.vertex_count
        if _variance(self.breaking, self._waves) < _SMALLEST_VARIANCE or self.coverage == 0.0:
            # Three arrays, not one under three names: such foam stands for any in the probe of the cost model, and
            # takes as long only if it goes over as much memory.
            gain, offset, fade = np.full((3, count), 0.0, np.float32)
            return _Vertices(gain, offset, fade, np.full(count, self.coverage, np.float32))
        energy = 0.5 * (self.breaking * self._waves.amplitude) ** 2
        share = resolved_sums(self._grid, self._waves, (energy / variance)[:, None])[:, 0]
        u = np.clip((share - _FADED_AT) / (_WHOLE_FROM - _FADED_AT), 0.0, 1.0)
        fade = u * u * (3.0 - 2.0 * u)
        threshold = np.interp(share, *self._thresholds(variance))
        ramp = ramp_of(threshold)
        deviation = np.sqrt(variance * np.maximum(share, _FADED_AT))
        arrays = (1.0 / (deviation * ramp), threshold / ramp, fade, (1.0 - fade) * self.coverage)
        return _Vertices(*(array.astype(np.float32) for array in arrays))

    def _thresholds(self, variance):
        """Some shares of the variance that the mesh shows, increasing, and the thresholds for them."""
        reach = window_reach(self._grid, self._waves.wavelength)
        shares, thresholds = [], []
        for distance in self._distances(reach, variance):
            shown = self.breaking * window(distance, reach)
            shares.append(_variance(shown, self._waves) / variance)
            statistics = statistics_of(shown, self._waves, self.memory)
            thresholds.append(threshold_for(self.coverage, self.memory, statistics))
        return np.array(shares), np.array(thresholds)

    def _distances(self, reach, variance):
        """Distances from the centre, outermost first, at which the mesh shows certain shares of the variance."""
        distances = np.geomspace(FADE_START * reach.min(), reach.max(), _SEARCHED_DISTANCES)
        shown = [_variance(self.breaking * window(distance, reach), self._waves) for distance in distances]
        present = np.array(shown) > 0.0  # a sea of one wave may have no distance with a share in between
        distances, shares = distances[present], np.array(shown)[present] / variance
        return [distances[np.argmin(np.abs(shares - share))] for share in _CALIBRATED_SHARES]

    def foam(self, columns: np.ndarray, out: np.ndarray) -> None:
        """Share of the area around each vertex that is white, into `out`, (vertices,) float32.

        `columns` (vertices, instants) are what the kernel made of `block`.
        """
        decay, vertices = self.memory.decay.astype(np.float32), self._vertices

        def work_out(part):
            gain, offset = vertices.gain[part], vertices.offset[part]
            foam = np.zeros(len(gain), np.float32)
            here, lowered = np.empty_like(foam), np.empty_like(foam)
            for instant, left in zip(columns[part].T, decay, strict=True):
                np.multiply(instant, gain, out=here)
                here -= np.multiply(left, offset, out=lowered)
                np.maximum(foam, np.minimum(here, left, out=here), out=foam)
            np.multiply(foam, vertices.fade[part], out=out[part])
            out[part] += vertices.uniform[part]

        in_threads(work_out, shares(*columns.shape))
