# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a picture of the sea repeats: its autocorrelation, beside that of the sea itself.

Waves know of each other over some wavelengths, and the autocorrelation of any sea falls from 1 in the origin to 0
over that distance; what a picture repeats shows as a peak beyond it. Four numbers tell one from the other:

    rho(r)     autocorrelation of the slopes of the sea's spectrum, as pixels see them:
               the inverse Fourier transform of |e . k|^2 Psi(k) |P(k)|^2, e the direction of the slopes, P the
               average over a pixel
    origin     all r up to the correlation length L: |rho| < ORIGIN_LEVEL beyond L in every direction
    sigma      standard deviation of an autocorrelation measured on an area A, where there is none:
               sigma^2 = int rho^2 dr / A (Bartlett 1946), with A the overlap of the picture and itself, moved
    chance     the highest of M independent values of this deviation, sigma sqrt(2 ln M): what a perfect sea has;
               M is the area of the shifts looked at over int rho^2 dr

A picture need not be linear in slopes: where slopes are uncorrelated, so is any function of them.
"""

from dataclasses import dataclass

import numpy as np

from ocean_lod_addon.core.directional import system_elevation_spectrum
from ocean_lod_addon.core.sea import Sea

ORIGIN_LEVEL = 0.05
"""Half of what is allowed beyond the origin."""


@dataclass(frozen=True)
class Peak:
    """The highest autocorrelation of a picture outside the origin, and the shift (x, y) in m at which it is."""

    value: float
    shift: tuple[float, float]


@dataclass(frozen=True)
class Expected:
    """Of a perfect sea: the correlation length in m, and what chance makes of the highest autocorrelation."""

    length: float
    chance: float


def detrended(picture: np.ndarray) -> np.ndarray:
    """Less its best quadratic surface: what light and lens do over the whole picture is no pattern of waves."""
    n = len(picture)
    y, x = np.mgrid[:n, :n] / n
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1).reshape(n * n, -1)
    return picture - (terms @ np.linalg.lstsq(terms, picture.ravel(), rcond=None)[0]).reshape(n, n)


def correlation(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Of two pictures (n, n) of the same water, for shifts from -n/2 to n/2 - 1 pixels; 1 in the middle.

    Two pictures that differ in nothing but their noise: it then counts neither in the middle nor elsewhere. Only
    pixels that are in the picture before and after a shift are compared.
    """
    n = len(first)
    size = (2 * n, 2 * n)
    spectra = [np.fft.fft2(detrended(picture), size) for picture in (first, second)]
    inside = np.abs(np.fft.fft2(np.ones((n, n)), size)) ** 2
    sums, counts = (np.fft.ifft2(product).real for product in (spectra[0].conj() * spectra[1], inside))
    shifts = np.fft.fftshift(sums / np.maximum(counts, 1.0))[n // 2 : n + n // 2, n // 2 : n + n // 2]
    return shifts / shifts[n // 2, n // 2]


def distances(n: int, pixel: float) -> np.ndarray:
    """Lengths in m of the shifts of `correlation`, (n, n)."""
    y, x = np.mgrid[:n, :n] - n // 2
    return pixel * np.hypot(x, y)


def highest_beyond(correlations: np.ndarray, pixel: float, length: float) -> Peak:
    """The peak at shifts of more than `length` in m."""
    n = len(correlations)
    outside = np.where(distances(n, pixel) > length, correlations, -1.0)
    row, column = np.unravel_index(np.argmax(outside), outside.shape)
    return Peak(float(outside[row, column]), (pixel * float(column - n // 2), pixel * float(row - n // 2)))


def slope_correlation(sea: Sea, direction: float, n: int, pixel: float) -> np.ndarray:
    """rho of slopes along `direction` (rad from x) of the first wave system, for the shifts of `correlation`."""
    k = 2.0 * np.pi * np.fft.fftfreq(2 * n, pixel)
    kx, ky = np.meshgrid(k, k)
    kx[0, 0] = k[1]  # no wave is infinitely long
    psi = system_elevation_spectrum(sea, 0, kx, ky)
    psi[0, 0] = 0.0
    averaged = np.sinc(0.5 * kx * pixel / np.pi) * np.sinc(0.5 * ky * pixel / np.pi)
    seen = psi * ((kx * np.cos(direction) + ky * np.sin(direction)) * averaged) ** 2
    rho = np.fft.fftshift(np.fft.ifft2(seen).real)[n // 2 : n + n // 2, n // 2 : n + n // 2]
    return rho / rho[n // 2, n // 2]


def expected(rho: np.ndarray, pixel: float) -> Expected:
    """What to expect of a picture of a sea with this autocorrelation."""
    n = len(rho)
    length = float(distances(n, pixel)[np.abs(rho) >= ORIGIN_LEVEL].max())
    integral = float(np.sum(rho**2)) * pixel**2
    y, x = np.abs(np.mgrid[:n, :n] / n - 0.5)
    overlap = np.mean(1.0 / ((1.0 - x) * (1.0 - y)))  # of the area, its mean effect on sigma^2
    width = n * pixel
    sigma = np.sqrt(integral / width**2 * overlap)
    independent = max(0.5 * width**2 / integral, 2.0)  # r and -r have the same value
    return Expected(length, float(sigma * np.sqrt(2.0 * np.log(independent))))
