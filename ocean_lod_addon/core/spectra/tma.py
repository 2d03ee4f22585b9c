# SPDX-License-Identifier: GPL-3.0-or-later
"""Bouws et al. 1985 (Texel, Marsen, Arsloe): JONSWAP in water of finite depth. THEORY section 3."""

from dataclasses import dataclass, replace

import numpy as np

from ..dispersion import Water, two_kh_over_sinh, wavenumber
from .jonswap import Jonswap
from .moments import spectrum_moments


def kitaigorodskii_factor(omega, water: Water) -> np.ndarray:
    """phi = tanh^2 kh / (1 + 2kh / sinh 2kh) at omega in rad/s: the spectrum over k keeps its deep-water tail."""
    if np.isinf(water.depth):
        return np.ones_like(omega, dtype=np.float64)
    k = wavenumber(omega, water)
    return np.tanh(k * water.depth) ** 2 / (1.0 + two_kh_over_sinh(k, water.depth))


@dataclass(frozen=True)
class Tma:
    """S = S_JONSWAP phi."""

    deep: Jonswap
    water: Water

    @property
    def peak_frequency(self) -> float:
        """The peak of the JONSWAP spectrum, rad/s."""
        return self.deep.peak_frequency

    def density(self, omega) -> np.ndarray:
        """Variance density S in m^2 s/rad for omega > 0 in rad/s."""
        return self.deep.density(omega) * kitaigorodskii_factor(omega, self.water)


def tma_from_height(significant_wave_height: float, deep: Jonswap, water: Water) -> Tma:
    """The spectrum of the shape of `deep` in this water that has the height in m."""
    m0 = spectrum_moments(Tma(deep, water))[0]
    return Tma(replace(deep, alpha=deep.alpha * significant_wave_height**2 / (16.0 * m0)), water)
