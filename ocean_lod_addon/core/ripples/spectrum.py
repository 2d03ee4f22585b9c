# SPDX-License-Identifier: GPL-3.0-or-later
"""Which slopes the ripples have: the sea's own directional spectrum, with the roughness that the wind makes.

Spectra of waves say little about ripples: carried on to millimetres they give half of the slope variance that Cox
and Munk measured in a strong wind and more than all of it in a light one. Here the waves of the roughening system
(slope_budget) keep their shape but not their level: between FULL_ABOVE and CORRECTED_BELOW their variance density
goes over into

    Psi(k) (p cos^2 theta + q sin^2 theta) V(k),        theta from the wind,

with V the fall of the ripples that viscosity stops, and p and q the two numbers that give the whole sea Cox and
Munk's slope variances along and across the wind. Where longer waves alone exceed those, p or q is 0. Waves of
other systems are as they are, down to the shortest that the mesh shows.
"""

import functools
from dataclasses import dataclass

import numpy as np

from ..directional import system_elevation_spectrum
from ..dispersion import angular_frequency, wavenumber
from ..quadrature import bin_nodes
from ..roughness import cox_munk_along_across, roughening_system
from ..sea import Sea
from ..spectra.elfouhaily import K_M
from ..spectra.moments import NO_ENERGY_BELOW
from ..spectra.table import SHORTEST_RIPPLE, SPECTRA, spectrum_of
from ..spreading.table import spreading_of
from ..waves import TWO_PI

FULL_ABOVE = 0.3
"""m; longer waves keep the level of their spectrum."""

CORRECTED_BELOW = 0.03
"""m; shorter waves are corrected in full. Measured spectra rise above k^-4 in this range."""

_DIRECTIONS = 360
_THETA = (np.arange(_DIRECTIONS) + 0.5) * TWO_PI / _DIRECTIONS - np.pi
_RADIAL_NODES, _RADIAL_WEIGHTS = np.polynomial.legendre.leggauss(24)


def correction_share(k) -> np.ndarray:
    """0 where waves keep their level, 1 where they are corrected in full; linear in ln k between, k in rad/m."""
    wavelength = TWO_PI / np.maximum(k, TWO_PI / FULL_ABOVE)
    return np.clip(np.log(FULL_ABOVE / wavelength) / np.log(FULL_ABOVE / CORRECTED_BELOW), 0.0, 1.0)


def viscous_fall(k) -> np.ndarray:
    """V(k) = exp(-(k / k_m - 1)^2 / 4) beyond k_m = 370 rad/m: Elfouhaily et al. 1997, Eq. 41."""
    return np.exp(-0.25 * np.maximum(np.asarray(k) / K_M - 1.0, 0.0) ** 2)


def _fall_of(system, k):
    """The viscous fall for spectra that do not have it of their own."""
    describes_ripples = SPECTRA[system.spectrum].shortest_wavelength <= SHORTEST_RIPPLE
    return np.ones_like(k) if describes_ripples else viscous_fall(k)


@dataclass(frozen=True)
class WindRipples:
    """What the wind makes of the short waves of a system.

    along, across  p and q
    total          slope variances along and across the wind of all its waves with these levels, or Cox and Munk's
                   where those are larger
    """

    along: float
    across: float
    total: tuple[float, float]


@functools.lru_cache(maxsize=64)
def wind_ripples(sea: Sea, index: int) -> WindRipples:
    """p and q of system number `index`: two linear equations, slope variance along and across the wind.

    Both are 0 or more: what the longer waves exceed in one axis can not be taken off the other.
    """
    system = sea.systems[index]
    spectrum = spectrum_of(system, sea.water)
    target = np.array(cox_munk_along_across(system))
    if spectrum is None:
        return WindRipples(0.0, 0.0, tuple(target))
    end = float(angular_frequency(TWO_PI / SHORTEST_RIPPLE, sea.water))
    start = min(NO_ENERGY_BELOW * spectrum.peak_frequency, 0.5 * end)
    nodes = bin_nodes(np.array([start, end]), spectrum.peak_frequency)
    k = wavenumber(nodes.omega, sea.water)
    slope_density = k * k * spectrum.density(nodes.omega) * nodes.weight
    share = correction_share(k)
    kept, corrected = slope_density * (1.0 - share), slope_density * share * _fall_of(system, k)
    D = spreading_of(system, spectrum, sea.water).density(nodes.omega[..., None], _THETA)
    D = np.where(np.abs(_THETA) <= system.directional_cutoff, D, 0.0)
    D = D / np.maximum(D.sum(axis=-1, keepdims=True), np.finfo(float).tiny)
    c2, s2 = np.cos(_THETA) ** 2, np.sin(_THETA) ** 2
    have = np.array([np.sum(kept * (D @ c2)), np.sum(kept * (D @ s2))])
    moments = np.array([[np.sum(corrected * (D @ (a * b))) for a in (c2, s2)] for b in (c2, s2)])
    along, across = levels_for(target - have, moments)
    total = np.maximum(target, have + moments @ (along, across))
    return WindRipples(along, across, (float(total[0]), float(total[1])))


@dataclass(frozen=True)
class RippleSpectrum:
    """The directional spectrum of everything that the bump can show.

    sea                the sea it belongs to
    shortest_resolved  m, the shortest wave of the mesh: where waves of other systems end
    rough              index of the roughening system, or None
    wind               its ripples, or None
    """

    sea: Sea
    shortest_resolved: float
    rough: int | None
    wind: WindRipples | None

    def density(self, kx, ky) -> np.ndarray:
        """Variance density of the elevation in m^4 over the wavenumber plane; kx, ky in rad/m."""
        kx, ky = np.broadcast_arrays(np.asarray(kx, dtype=np.float64), np.asarray(ky, dtype=np.float64))
        k = np.hypot(kx, ky)
        total = np.zeros(k.shape)
        for index, system in enumerate(self.sea.systems):
            psi = system_elevation_spectrum(self.sea, index, kx, ky)
            if index == self.rough:
                share, theta = correction_share(k), np.arctan2(ky, kx) - system.direction
                level = self.wind.along * np.cos(theta) ** 2 + self.wind.across * np.sin(theta) ** 2
                total += psi * (1.0 - share + share * level * _fall_of(system, k))
            else:
                total += np.where(k <= TWO_PI / self.shortest_resolved, psi, 0.0)
        return total


def ripple_spectrum(sea: Sea, shortest_resolved: float) -> RippleSpectrum:
    """The spectrum of the ripples of a sea whose mesh shows waves down to `shortest_resolved` in m."""
    rough = roughening_system(sea)
    return RippleSpectrum(sea, shortest_resolved, rough, None if rough is None else wind_ripples(sea, rough))


def levels_for(wanted, moments) -> tuple[float, float]:
    """p, q >= 0 with moments @ (p, q) = `wanted`, (along, across); `moments` is symmetric and positive.

    Where that takes a negative number it is 0, and the sum of both axes alone is as wanted; 0, 0 where that is
    negative, or where there is nothing to scale.
    """
    total = float(np.sum(wanted))
    if total <= 0.0 or np.sum(moments) <= 0.0:
        return 0.0, 0.0
    determinant = moments[0, 0] * moments[1, 1] - moments[0, 1] ** 2
    p = wanted[0] * moments[1, 1] - wanted[1] * moments[0, 1]
    q = wanted[1] * moments[0, 0] - wanted[0] * moments[0, 1]
    if p <= 0.0:
        return 0.0, total / float(moments[:, 1].sum())
    if q <= 0.0:
        return total / float(moments[:, 0].sum()), 0.0
    return float(p / determinant), float(q / determinant)


def slope_tensor_between(density, shortest: float, longest: float) -> np.ndarray:
    """Slope variances (xx, yy, xy) of `density`(kx, ky) between two wavelengths in m."""
    low, high = np.log(TWO_PI / longest), np.log(TWO_PI / shortest)
    half = 0.5 * (high - low)
    k = np.exp(low + half * (1.0 + _RADIAL_NODES))[:, None]
    kx, ky = k * np.cos(_THETA), k * np.sin(_THETA)
    weight = density(kx, ky) * k * k * half * _RADIAL_WEIGHTS[:, None] * TWO_PI / _DIRECTIONS
    return np.array([np.sum(weight * kx * kx), np.sum(weight * ky * ky), np.sum(weight * kx * ky)])
