# SPDX-License-Identifier: GPL-3.0-or-later
"""The directional elevation spectrum over the wavenumber plane, for ripples made on a grid of wavenumbers."""

import numpy as np

from .dispersion import angular_frequency, group_speed
from .sea import Sea
from .spectra.table import spectrum_of
from .spreading.sampling import share_within
from .spreading.table import spreading_of


def elevation_spectrum(sea: Sea, kx, ky) -> np.ndarray:
    """Variance density Psi(kx, ky) in m^4 of all systems; kx, ky in rad/m, where the waves travel to.

    Its integral over the plane is the variance m0 of the elevation; 0 at the origin.
    """
    kx, ky = np.broadcast_arrays(np.asarray(kx, dtype=np.float64), np.asarray(ky, dtype=np.float64))
    total = np.zeros(kx.shape)
    for index in range(len(sea.systems)):
        total = total + system_elevation_spectrum(sea, index, kx, ky)
    return total


def system_elevation_spectrum(sea: Sea, index: int, kx, ky) -> np.ndarray:
    """The share of system number `index` in `elevation_spectrum`: S(omega) c_g / k D(omega, theta)."""
    kx, ky = np.broadcast_arrays(np.asarray(kx, dtype=np.float64), np.asarray(ky, dtype=np.float64))
    system, water = sea.systems[index], sea.water
    spectrum = spectrum_of(system, water)
    k = np.hypot(kx, ky)
    moving = k > 0.0
    if spectrum is None or not moving.any():
        return np.zeros(k.shape)
    spreading = spreading_of(system, spectrum, water)
    k_moving = k[moving]
    omega = angular_frequency(k_moving, water)
    theta = np.arctan2(ky[moving], kx[moving]) - system.direction
    theta = np.mod(theta + np.pi, 2.0 * np.pi) - np.pi
    D = spreading.density(omega, theta) / share_within(spreading, omega, system.directional_cutoff)
    D = np.where(np.abs(theta) <= system.directional_cutoff, D, 0.0)
    density = np.zeros(k.shape)
    density[moving] = spectrum.density(omega) * group_speed(k_moving, water) / k_moving * D
    return density
