# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sea is, in the numbers of oceanographers: from its spectrum, and from the waves that were made."""

import dataclasses
import math
from dataclasses import dataclass, replace

import numpy as np

from .beaufort import beaufort_force
from .discretise import Bins, discretise, integrate_bins
from .dispersion import angular_frequency
from .sea import Sea, WaveSystem
from .spectra.moments import (
    NO_ENERGY_BELOW,
    mean_period,
    mean_wavenumber,
    significant_wave_height,
    spectrum_moments,
    zero_crossing_period,
)
from .spectra.table import SPECTRA, Spectrum, spectrum_of
from .spreading.table import spreading_of
from .waves import TWO_PI, WaveSet

_PEAK_SEARCH = np.geomspace(0.5, 2.0, 2001)
"""Over each system's nominal peak frequency: where the peak of the whole sea is looked for, in steps of 0.07 %."""


def _in(unit: str):
    """A dataclass field whose key in files ends in its unit."""
    return dataclasses.field(metadata={"unit": unit})


@dataclass(frozen=True)
class SeaStatistics:
    """Statistics of a sea; None where a flat sea has none. Slope variances along and across the wind."""

    significant_wave_height: float = _in("m")
    peak_period: float | None = _in("s")
    mean_period: float | None = _in("s")
    zero_crossing_period: float | None = _in("s")
    mean_wavelength: float | None = _in("m")
    slope_variance_along: float
    slope_variance_across: float


@dataclass(frozen=True)
class LoopDistortion:
    """What a perfect loop changes: relative shifts of frequency, and slope variance over what it was."""

    largest_frequency_shift: float
    rms_frequency_shift: float
    slope_variance_ratio: float


@dataclass(frozen=True)
class SeaReport:
    """A sea read back.

    theoretical           from the spectra, all frequencies; slope variance down to the shortest wave they describe
    sampled               from the waves
    wind_direction        where the wind blows to, the axis of the slope variances
    beaufort_number       None for a sea of swell alone, which has no wind
    energy_share          share of the spectra's variance that the waves carry
    slope_variance_share  share of the spectra's slope variance that the waves carry
    loop                  None without a loop
    """

    theoretical: SeaStatistics
    sampled: SeaStatistics
    wind_speed: float | None = _in("m_s")
    wind_direction: float = _in("rad")
    beaufort_number: int | None
    beaufort_name: str | None
    wave_count: int
    shortest_wavelength: float = _in("m")
    energy_share: float | None
    slope_variance_share: float | None
    loop: LoopDistortion | None

    def to_json(self) -> dict:
        """The report as plain dicts, numbers, texts and None; keys end in their units."""
        return _plain(self)


def _plain(value):
    if not dataclasses.is_dataclass(value):
        return value
    return {
        "_".join([field.name, *field.metadata.values()]): _plain(getattr(value, field.name))
        for field in dataclasses.fields(value)
    }


def sea_report(sea: Sea, waves: WaveSet, shortest_wavelength: float) -> SeaReport:
    """Read back a sea and the waves that `discretise` made of it down to `shortest_wavelength` in m."""
    winds = [system for system in sea.systems if system.enabled and system.sized_by == "wind"]
    wind = max(winds, key=lambda system: system.wind_speed, default=None)
    axis = wind_axis(sea)
    theoretical = theoretical_statistics(sea, axis)
    sampled = sampled_statistics(sea, waves, axis)
    force = beaufort_force(wind.wind_speed) if wind else None
    return SeaReport(
        theoretical=theoretical,
        sampled=sampled,
        wind_speed=wind.wind_speed if wind else None,
        wind_direction=axis,
        beaufort_number=force.number if force else None,
        beaufort_name=force.name if force else None,
        wave_count=len(waves),
        shortest_wavelength=shortest_wavelength,
        energy_share=_ratio(sampled.significant_wave_height**2, theoretical.significant_wave_height**2),
        slope_variance_share=_ratio(_slope_variance(sampled), _slope_variance(theoretical)),
        loop=loop_distortion(sea, shortest_wavelength) if sea.loop_period > 0.0 else None,
    )


def _slope_variance(statistics):
    return statistics.slope_variance_along + statistics.slope_variance_across


def _ratio(part, whole):
    return part / whole if whole > 0.0 else None


def wind_axis(sea: Sea) -> float:
    """Direction in rad of the strongest wind, of the first system where no system has wind, or 0."""
    enabled = [system for system in sea.systems if system.enabled]
    winds = [system for system in enabled if system.sized_by == "wind"]
    if winds:
        return max(winds, key=lambda system: system.wind_speed).direction
    return enabled[0].direction if enabled else 0.0


def theoretical_statistics(sea: Sea, axis: float) -> SeaStatistics:
    """Statistics of the spectra of a sea, slope variances along and across `axis` in rad."""
    spectra = [(system, s) for system in sea.systems if (s := spectrum_of(system, sea.water)) is not None]
    moments = np.array([spectrum_moments(spectrum) for _, spectrum in spectra]).reshape(-1, 3)
    m0, m1, m2 = moments.sum(axis=0)
    if m0 <= 0.0:
        return SeaStatistics(0.0, None, None, None, None, 0.0, 0.0)
    mean_k = [mean_wavenumber(spectrum, sea.water) for _, spectrum in spectra]
    along, across = (
        sum(parts)
        for parts in zip(*(_spectral_slopes(sea, system, s, axis) for system, s in spectra), strict=True)
    )
    return SeaStatistics(
        significant_wave_height(m0),
        TWO_PI / peak_frequency([spectrum for _, spectrum in spectra]),
        mean_period(m0, m1),
        zero_crossing_period(m0, m2),
        TWO_PI * m0 / float(np.dot(moments[:, 0], mean_k)),
        along,
        across,
    )


def peak_frequency(spectra: list[Spectrum]) -> float:
    """Where the sum of these spectra is largest, rad/s."""
    omega = np.concatenate([_PEAK_SEARCH * spectrum.peak_frequency for spectrum in spectra])
    return float(omega[np.argmax(sum(spectrum.density(omega) for spectrum in spectra))])


def _spectral_slopes(sea, system: WaveSystem, spectrum, axis):
    """Slope variance of a system along and across the axis, down to the shortest wave its spectrum describes."""
    end = float(angular_frequency(TWO_PI / SPECTRA[system.spectrum].shortest_wavelength, sea.water))
    start = NO_ENERGY_BELOW * spectrum.peak_frequency
    if end <= start:
        return 0.0, 0.0
    spreading = spreading_of(system, spectrum, sea.water)
    bins: Bins = integrate_bins(spectrum, spreading, system.directional_cutoff, sea.water, np.array([start, end]))
    total, upwave = float(bins.slope_variance[0]), float(bins.upwave_variance[0])
    turn = math.cos(system.direction - axis) ** 2  # the law is symmetric: its axes are the principal ones
    along = upwave * turn + (total - upwave) * (1.0 - turn)
    return along, total - along


def sampled_statistics(sea: Sea, waves: WaveSet, axis: float) -> SeaStatistics:
    """Statistics of a set of waves, slope variances along and across `axis` in rad."""
    energy = 0.5 * waves.amplitude**2
    m0 = float(energy.sum())
    if m0 <= 0.0:
        return SeaStatistics(0.0, None, None, None, None, 0.0, 0.0)
    m1, m2 = (float(np.sum(energy * waves.angular_frequency**n)) for n in (1, 2))
    slope = waves.wavenumber**2 * energy
    along = float(np.sum(slope * np.cos(waves.direction - axis) ** 2))
    return SeaStatistics(
        significant_wave_height(m0),
        TWO_PI / _sampled_peak(sea, waves, energy),
        mean_period(m0, m1),
        zero_crossing_period(m0, m2),
        TWO_PI * m0 / float(np.sum(energy * waves.wavenumber)),
        along,
        float(slope.sum()) - along,
    )


def _sampled_peak(sea, waves, energy):
    """Frequency of the wave with the largest energy per width of its bin, in the system the sea's peak belongs to.

    Widths of a system's bins are in proportion to their frequencies, but the first reaches further down.
    """
    peaks = {}
    for index in np.unique(waves.system):
        spectrum = spectrum_of(sea.systems[index], sea.water)
        peaks[index] = float(spectrum.density(np.float64(spectrum.peak_frequency)))
    own = waves.system == max(peaks, key=peaks.get)
    first = min(1, np.count_nonzero(own) - 1)
    omega = waves.angular_frequency[own][first:]
    return float(omega[np.argmax(energy[own][first:] / omega)])


def loop_distortion(sea: Sea, shortest_wavelength: float) -> LoopDistortion:
    """What the loop of a sea (loop_period > 0) changes in its waves down to `shortest_wavelength` in m."""
    looped = discretise(sea, shortest_wavelength)
    free = discretise(replace(sea, loop_period=0.0), shortest_wavelength)
    energy = free.amplitude**2
    if energy.sum() <= 0.0:
        return LoopDistortion(0.0, 0.0, 1.0)
    shift = looped.angular_frequency / free.angular_frequency - 1.0
    slopes = [np.sum(energy * waves.wavenumber**2) for waves in (looped, free)]
    return LoopDistortion(
        float(np.max(np.abs(shift))),
        float(np.sqrt(np.sum(energy * shift**2) / np.sum(energy))),
        float(slopes[0] / slopes[1]),
    )
