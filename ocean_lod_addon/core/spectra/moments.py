# SPDX-License-Identifier: GPL-3.0-or-later
"""Moments and periods of any spectrum, by quadrature."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..dispersion import Water, wavenumber
from ..quadrature import bin_nodes

if TYPE_CHECKING:
    from .table import Spectrum

NO_ENERGY_BELOW = 0.15
"""Over the peak frequency; from here down every spectrum is below 1e-50 of its peak. Keeps omega^-5 finite."""

NO_ENERGY_ABOVE = 1e4
"""Over the peak frequency; a tail as omega^-5 has 1e-16 of m0, 1e-12 of m1 and 1e-8 of m2 beyond."""


def spectrum_moments(spectrum: Spectrum) -> tuple[float, float, float]:
    """m0, m1 and m2, m_n = int omega^n S d omega in m^2 (rad/s)^n, over all frequencies."""
    peak = spectrum.peak_frequency
    nodes = bin_nodes(np.array([NO_ENERGY_BELOW, NO_ENERGY_ABOVE]) * peak, peak)
    S = spectrum.density(nodes.omega)
    m0, m1, m2 = (float(nodes.integrate(nodes.omega**n * S)[0]) for n in range(3))
    return m0, m1, m2


def mean_wavenumber(spectrum: Spectrum, water: Water) -> float:
    """int k S d omega / m0 in rad/m."""
    peak = spectrum.peak_frequency
    nodes = bin_nodes(np.array([NO_ENERGY_BELOW, NO_ENERGY_ABOVE]) * peak, peak)
    S = spectrum.density(nodes.omega)
    k = wavenumber(nodes.omega, water)
    return float(nodes.integrate(k * S)[0] / nodes.integrate(S)[0])


def significant_wave_height(m0: float) -> float:
    """Hs = 4 sqrt(m0), m."""
    return 4.0 * math.sqrt(m0)


def mean_period(m0: float, m1: float) -> float:
    """T1 = 2 pi m0 / m1, s."""
    return 2.0 * math.pi * m0 / m1


def zero_crossing_period(m0: float, m2: float) -> float:
    """Tz = 2 pi sqrt(m0 / m2), s."""
    return 2.0 * math.pi * math.sqrt(m0 / m2)
