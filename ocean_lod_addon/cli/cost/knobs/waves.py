# SPDX-License-Identifier: GPL-3.0-or-later
"""The knob of discretisation: how a spectrum becomes a set of waves."""

import math

import numpy as np

from ....core.discretise import bin_edges, integrate_bins, representative_waves
from ....core.dispersion import angular_frequency, wavenumber
from ....core.quadrature import bin_nodes
from ....core.sea import Sea
from ....core.spectra.moments import NO_ENERGY_BELOW
from ....core.spectra.table import spectrum_of
from ....core.spreading.table import spreading_of
from ....core.waves import TWO_PI
from .knob import Knob, Step

_COUNT = 64
_SHORTEST = 0.4  # m
_SEA = Sea()  # Pierson-Moskowitz at 10 m/s


def _spectrum():
    return spectrum_of(_SEA.systems[0], _SEA.water)


def _cutoff():
    return float(angular_frequency(TWO_PI / _SHORTEST, _SEA.water))


def _moments(omega, amplitude):
    """Height variance and slope variance of waves."""
    energy = 0.5 * amplitude**2
    return np.array([energy.sum(), (wavenumber(omega, _SEA.water) ** 2 * energy).sum()])


def _true_moments():
    spectrum, cutoff = _spectrum(), _cutoff()
    nodes = bin_nodes(np.array([NO_ENERGY_BELOW * spectrum.peak_frequency, cutoff]), spectrum.peak_frequency)
    S = spectrum.density(nodes.omega)
    k = wavenumber(nodes.omega, _SEA.water)
    return np.array([nodes.integrate(S).sum(), nodes.integrate(k * k * S).sum()])


def equal_energy():
    """Equal energies: the frequency that halves each bin's, (B / -ln u)^(1/4) for Pierson and Moskowitz."""
    spectrum, cutoff = _spectrum(), _cutoff()
    B = 1.25 * spectrum.peak_frequency**4
    below_cutoff = math.exp(-B / cutoff**4)
    u = below_cutoff * (np.arange(_COUNT) + 0.5) / _COUNT
    energy = _true_moments()[0] / _COUNT
    return (B / -np.log(u)) ** 0.25, np.full(_COUNT, math.sqrt(2.0 * energy))


def equal_frequency():
    """Equal steps of frequency, S(omega) d omega at their middles."""
    spectrum, cutoff = _spectrum(), _cutoff()
    step = cutoff / _COUNT
    omega = (np.arange(_COUNT) + 0.5) * step
    return omega, np.sqrt(2.0 * spectrum.density(omega) * step)


def _bins():
    spectrum = _spectrum()
    spreading = spreading_of(_SEA.systems[0], spectrum, _SEA.water)
    edges = bin_edges(spectrum.peak_frequency, _cutoff(), _COUNT)
    return integrate_bins(spectrum, spreading, _SEA.systems[0].directional_cutoff, _SEA.water, edges)


def geometric_middles():
    """Geometric bins with their exact energy, at their geometric middles."""
    bins = _bins()
    return bins.middle, np.sqrt(2.0 * bins.energy)


def exact_slopes():
    """Geometric bins with their exact energy, at the frequency that gives their exact slope variance: ours."""
    bins = _bins()
    _, omega = representative_waves(bins, _SEA.water, 0.0)
    return omega, np.sqrt(2.0 * bins.energy)


def _worst_share(rule):
    errors = _moments(*rule()) / _true_moments() - 1.0
    return 100.0 * float(np.abs(errors).max())


DISCRETISATION = Knob(
    "discretisation",
    "Discretisation of the spectrum",
    "How high and how steep the sea is",
    f"Height variance or slope variance of {_COUNT} waves, whichever is further off",
    "% of variance",
    "The integrals of the spectrum down to 0.4 m (Pierson-Moskowitz, 10 m/s)",
    f"{_COUNT} frequencies and amplitudes, once",
    tuple(
        Step(name, lambda rule=rule: _worst_share(rule), lambda rule=rule: lambda _time: rule())
        for name, rule in (
            ("equal energies, median frequency", equal_energy),
            ("equal steps of frequency", equal_frequency),
            ("geometric bins, middle frequency", geometric_middles),
            ("geometric bins, frequency of the slopes", exact_slopes),
        )
    ),
)
