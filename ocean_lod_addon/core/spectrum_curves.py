# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves that show how well the waves that were made stand for the spectra they were made from."""

from collections.abc import Iterator

import numpy as np

from .discretise import band_layout, bin_edges
from .dispersion import angular_frequency
from .quadrature import bin_nodes
from .sea import Sea, WaveSystem
from .spectra.moments import NO_ENERGY_ABOVE, NO_ENERGY_BELOW
from .spectra.table import Spectrum, spectrum_of
from .spreading.sampling import share_within
from .spreading.table import spreading_of
from .waves import TWO_PI, WaveSet


def active_spectra(sea: Sea) -> Iterator[tuple[int, WaveSystem, Spectrum]]:
    """Index, settings and spectrum of each wave system that has waves."""
    for index, system in enumerate(sea.systems):
        spectrum = spectrum_of(system, sea.water)
        if spectrum is not None:
            yield index, system, spectrum


def target_density(sea: Sea, omega: np.ndarray) -> np.ndarray:
    """Sum of the spectra of a sea, m^2 s/rad, at omega > 0 in rad/s."""
    return sum((s.density(omega) for _, _, s in active_spectra(sea)), np.zeros(np.shape(omega)))


def sampled_density(sea: Sea, waves: WaveSet, shortest_wavelength: float, omega: np.ndarray) -> np.ndarray:
    """Energy of the waves over the width of the bins that they stand for, m^2 s/rad, at omega in rad/s.

    `waves` are those of `discretise` down to `shortest_wavelength` in m. With a loop the bins are centred on the
    multiples of 2 pi / loop_period.
    """
    total = np.zeros(np.shape(omega))
    cutoff = float(angular_frequency(TWO_PI / shortest_wavelength, sea.water))
    for index, system, spectrum in active_spectra(sea):
        own = waves.system == index
        if not own.any():
            continue
        if sea.loop_period > 0.0:
            step = TWO_PI / sea.loop_period
            cycles = np.rint(waves.angular_frequency[own] / step)
            edges = (np.arange(cycles.min(), cycles.max() + 2.0) - 0.5) * step
        else:
            per_band, bands = band_layout(sea, system)
            edges = bin_edges(spectrum.peak_frequency, cutoff, per_band * bands)
        energy, _ = np.histogram(waves.angular_frequency[own], edges, weights=0.5 * waves.amplitude[own] ** 2)
        bin_of = np.searchsorted(edges, omega, side="right") - 1
        inside = (bin_of >= 0) & (bin_of < len(energy))
        density = energy / np.diff(edges)
        total += np.where(inside, density[np.clip(bin_of, 0, len(energy) - 1)], 0.0)
    return total


def directional_density(sea: Sea, omega: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Sum over the systems of S(omega) D(omega, direction), m^2 s/rad^2; omega and direction (rad) broadcast."""
    omega, direction = np.broadcast_arrays(omega, direction)
    total = np.zeros(omega.shape)
    for _, system, spectrum in active_spectra(sea):
        spreading = spreading_of(system, spectrum, sea.water)
        theta = np.mod(direction - system.direction + np.pi, TWO_PI) - np.pi
        D = spreading.density(omega, theta) / share_within(spreading, omega, system.directional_cutoff)
        total += spectrum.density(omega) * np.where(np.abs(theta) <= system.directional_cutoff, D, 0.0)
    return total


def energy_by_direction(sea: Sea, direction: np.ndarray) -> np.ndarray:
    """The spectra's variance per direction, m^2/rad: `directional_density` integrated over all frequencies."""
    total = np.zeros(np.shape(direction))
    for _, system, spectrum in active_spectra(sea):
        peak = spectrum.peak_frequency
        nodes = bin_nodes(np.array([NO_ENERGY_BELOW, NO_ENERGY_ABOVE]) * peak, peak)
        alone = Sea((system,), sea.finite_depth, sea.depth, sea.surface_tension)
        total += [float(nodes.integrate(directional_density(alone, nodes.omega, angle))[0]) for angle in direction]
    return total
