# SPDX-License-Identifier: GPL-3.0-or-later
"""From the settings of a sea to the finite set of waves that stands for it. THEORY section 3.

Each wave stands for a bin of frequencies. Bins are geometric; a wave has its bin's energy exactly, and the
wavenumber that gives the bin's slope variance exactly too:

    A = sqrt(2 int S d omega)        k^2 = int k^2 S d omega / int S d omega

and omega follows from k by the dispersion relation. So the height and the slope variance of the waves are
those of the spectrum up to the cut-off, whatever the number of waves, the spectrum and the depth.

Every wave has a frequency of its own (waves that share one would stand still against each other and make some
places calm for ever). The fan of directions is shared out among the waves of a *band*, `directions`
neighbouring bins: each gets a slice of the spreading law in proportion to its energy, in random order, and a
random angle within its slice. Then one exponent per band bends the angles a little so that the slope variance
of the band along and across the mean direction is exact as well.

Draws are numbered from the longest wave of a system, and depend on nothing but seeds and that number.
"""

from dataclasses import dataclass

import numpy as np

from .dispersion import Water, angular_frequency, coth_kh, wavenumber
from .errors import OceanError, OutOfRangeError
from .quadrature import BinNodes, bin_nodes
from .rng import stream_seed, uniform
from .sea import Sea, WaveSystem
from .spectra.moments import NO_ENERGY_BELOW, significant_wave_height
from .spectra.table import Spectrum, spectrum_of
from .spreading.sampling import direction_at_share, mean_cos2
from .spreading.table import Spreading, spreading_of
from .waves import TWO_PI, WaveSet

LOWEST_EDGE = 0.6
"""Where the geometric bins start, over the peak frequency: 6e-5 of a Pierson-Moskowitz sea's energy is below.

The first bin takes what is below: with 0.7 (0.55 %) its wave would stand out among many.
"""

SMALLEST_BIN_ENERGY = 1e-30
"""m^2; a bin with less is empty: its wave has no height, and dividing by its energy would make it nonsense."""

_BEND_STEPS = 60
_LARGEST_LOG_BEND = 8.0

_PHASE_STREAM, _ANGLE_STREAM, _ORDER_STREAM = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Bins:
    """The frequency bins of a wave system, from the longest waves on; SI units, arrays of shape (bins,).

    energy           int S d omega, m^2
    slope_variance   int k^2 S d omega
    upwave_variance  the part of it along the mean direction, int k^2 S <cos^2 theta> d omega
    middle           geometric middle frequency, rad/s
    """

    energy: np.ndarray
    slope_variance: np.ndarray
    upwave_variance: np.ndarray
    middle: np.ndarray


def discretise(sea: Sea, shortest_wavelength: float) -> WaveSet:
    """The waves of a sea, down to `shortest_wavelength` in m.

    A system without energy (no wind, no height, switched off, no share) has no waves; a flat sea has none at all.
    Raises `OutOfRangeError` if the shortest wavelength is not a positive number.
    """
    check_shortest_wavelength(shortest_wavelength)
    cutoff = float(angular_frequency(TWO_PI / shortest_wavelength, sea.water))
    parts = [
        part
        for index, system in enumerate(sea.systems)
        if (part := _system_waves(sea, index, system, cutoff)) is not None
    ]
    columns = [np.concatenate(column) for column in zip(*parts, strict=True)] if parts else [np.zeros(0)] * 7
    return WaveSet(*columns, loop_period=sea.loop_period)


def check_shortest_wavelength(shortest_wavelength: float) -> None:
    """Raise `OutOfRangeError` unless the wavelength, m, is a positive number."""
    if not 0.0 < shortest_wavelength < np.inf:
        raise OutOfRangeError("shortest wavelength", shortest_wavelength, "a positive length in m")


def check_wave_height(sea: Sea, waves: WaveSet) -> None:
    """Raise `OceanError` if the significant height of a sea's waves is larger than the depth of its water.

    Waves break long before (at about 0.6 of the depth), and troughs would lie below the bottom: no sum of waves
    is a sea there. Between the two the sum is still drawn, if not natural.
    """
    height = significant_wave_height(0.5 * float(np.sum(waves.amplitude**2)))
    if height > sea.water.depth:
        raise OceanError(
            f"significant wave height is {height:.3g} m in water {sea.depth:.3g} m deep, allowed is up to"
            " the depth: make the water deeper or the waves lower"
        )


def _system_waves(sea, index, system, cutoff):
    """The columns of the `WaveSet` for one system, or None."""
    spectrum = spectrum_of(system, sea.water)
    per_band, bands = band_layout(sea, system)
    if spectrum is None or bands == 0:
        return None
    edges = bin_edges(spectrum.peak_frequency, cutoff, bands * per_band)
    return system_waves(sea, index, edges, per_band)


def band_layout(sea: Sea, system: WaveSystem) -> tuple[int, int]:
    """Waves in each band of a system, and number of bands: as many waves as its share allows."""
    count = round(sea.wave_count * system.wave_share)
    per_band = max(1, min(sea.directions, count))
    return per_band, count // per_band


def bin_edges(peak_frequency: float, cutoff: float, count: int) -> np.ndarray:
    """The `count` + 1 edges of geometric bins up to `cutoff`, rad/s; the first bin reaches down to no energy."""
    start = LOWEST_EDGE * min(peak_frequency, cutoff)
    edges = start * (cutoff / start) ** (np.arange(count + 1) / count)
    edges[0] = NO_ENERGY_BELOW / LOWEST_EDGE * start
    return edges


def system_waves(sea: Sea, index: int, edges: np.ndarray, per_band: int) -> tuple[np.ndarray, ...] | None:
    """The columns of a `WaveSet` for the bins of system number `index`, or None if it has no energy there.

    `edges` in rad/s, increasing; their bins form bands of `per_band`. A wave depends on its own band's bins and
    its number alone: appending bands leaves the waves before them as they were, bit for bit.
    """
    system, water = sea.systems[index], sea.water
    spectrum = spectrum_of(system, water)
    if spectrum is None:
        return None
    spreading = spreading_of(system, spectrum, water)
    bins = integrate_bins(spectrum, spreading, system.directional_cutoff, water, edges)
    if not np.any(bins.energy > SMALLEST_BIN_ENERGY):
        return None
    k, omega = representative_waves(bins, water, sea.loop_period)
    seed = stream_seed(stream_seed(sea.seed, index), system.seed)
    number = np.arange(len(omega))
    angle = _angles(seed, number, per_band, omega, k, bins, spreading, system.directional_cutoff)
    return (
        np.where(bins.energy > SMALLEST_BIN_ENERGY, np.sqrt(2.0 * bins.energy), 0.0),
        k,
        omega,
        np.mod(system.direction + angle, TWO_PI),
        TWO_PI * uniform(stream_seed(seed, _PHASE_STREAM), number),
        sea.choppiness * coth_kh(k, water.depth),
        np.full(len(omega), index),
    )


def integrate_bins(
    spectrum: Spectrum, spreading: Spreading, directional_cutoff: float, water: Water, edges: np.ndarray
) -> Bins:
    """Energy and slope variances of the bins between `edges` in rad/s, by quadrature."""
    nodes: BinNodes = bin_nodes(edges, spectrum.peak_frequency)
    S = spectrum.density(nodes.omega)
    slope_density = wavenumber(nodes.omega, water) ** 2 * S
    return Bins(
        nodes.integrate(S),
        nodes.integrate(slope_density),
        nodes.integrate(slope_density * mean_cos2(spreading, nodes.omega, directional_cutoff)),
        np.sqrt(edges[:-1] * edges[1:]),
    )


def representative_waves(bins: Bins, water: Water, loop_period: float) -> tuple[np.ndarray, np.ndarray]:
    """Wavenumber (rad/m) and frequency (rad/s) of the wave of each bin.

    With a loop, the frequency is rounded to a multiple of 2 pi / loop_period and the wavenumber follows.
    """
    full = bins.energy > SMALLEST_BIN_ENERGY
    mean_square_k = bins.slope_variance / np.where(full, bins.energy, 1.0)
    k = np.where(full, np.sqrt(mean_square_k), wavenumber(bins.middle, water))
    omega = angular_frequency(k, water)
    if loop_period > 0.0:
        omega = looping_frequency(omega, loop_period)
        k = wavenumber(omega, water)
    return k, omega


def looping_frequency(omega, loop_period: float) -> np.ndarray:
    """The multiple of 2 pi / loop_period (s) nearest to omega in rad/s, but not 0. THEORY section 3."""
    cycles = np.maximum(1.0, np.rint(np.asarray(omega) * loop_period / TWO_PI))
    return cycles * TWO_PI / loop_period


def _angles(seed, number, per_band, omega, k, bins, spreading, cutoff):
    """Angles from the mean direction, rad: a slice of the law for each wave of a band, then the exact bend."""
    bands = (-1, per_band)
    energy = np.where(bins.energy > SMALLEST_BIN_ENERGY, bins.energy, 0.0).reshape(bands)
    band_energy = energy.sum(axis=1, keepdims=True)
    empty = band_energy <= 0.0
    slice_width = np.where(empty, 1.0 / per_band, energy / np.where(empty, 1.0, band_energy))
    order = np.argsort(uniform(stream_seed(seed, _ORDER_STREAM), number).reshape(bands), axis=1, kind="stable")
    ordered = np.take_along_axis(slice_width, order, axis=1)
    start = np.empty_like(ordered)
    np.put_along_axis(start, order, np.cumsum(ordered, axis=1) - ordered, axis=1)
    jitter = uniform(stream_seed(seed, _ANGLE_STREAM), number).reshape(bands)
    share = np.clip(start + jitter * slice_width, 0.0, 1.0)
    theta = direction_at_share(spreading, omega.reshape(bands), share, cutoff)
    if per_band == 1:
        return theta.ravel()
    variance = bins.slope_variance.reshape(bands).sum(axis=1)
    known = variance > 0.0
    target = bins.upwave_variance.reshape(bands).sum(axis=1) / np.where(known, variance, 1.0)
    return bend_to_mean_cos2(theta, k.reshape(bands) ** 2 * energy, np.where(known, target, 0.5)).ravel()


def bend_to_mean_cos2(theta: np.ndarray, weight: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Angles (bands, n) bent so that each band's weighted mean of cos^2 is `target` (bands,), 0 < target < 1.

    With phi the angle to the nearer end of the mean line, phi -> pi/2 (2 phi / pi)^gamma keeps every angle in
    its quadrant and takes the mean from 0 (gamma = 0) to 1 (gamma = inf), so there is one gamma: by bisection.
    """
    backwards = np.abs(theta) > 0.5 * np.pi
    phi = np.where(backwards, np.pi - np.abs(theta), np.abs(theta))
    fraction = np.clip(2.0 / np.pi * phi, 0.0, 1.0)
    wanted = target * weight.sum(axis=1)
    low = np.full(len(theta), -_LARGEST_LOG_BEND)
    high = -low
    for _ in range(_BEND_STEPS):
        middle = 0.5 * (low + high)
        bent = 0.5 * np.pi * fraction ** np.exp(middle)[:, None]
        below = (weight * np.cos(bent) ** 2).sum(axis=1) < wanted
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    bent = 0.5 * np.pi * fraction ** np.exp(0.5 * (low + high))[:, None]
    return np.copysign(np.where(backwards, np.pi - bent, bent), theta)
