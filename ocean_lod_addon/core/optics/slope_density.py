# SPDX-License-Identifier: GPL-3.0-or-later
"""How probable a slope is: Gaussian, and Cox and Munk's Gram-Charlier series (Eqs. 7 and 8).

Densities are over slopes per horizontal area. Slopes are standardised, along the wind as the slope of water that
rises **into** the wind:

    X = -zeta_x/sigma_x        Y = zeta_y/sigma_y        zeta = (dz/dx, dz/dy), x downwind

The sign of X matters to the skewness: steep slopes rise towards the wind, E[X^3] = -c03 > 0, and the most probable
slope rises downwind (THEORY section 5). Y is even in everything below, so that (X, Y) may as well be the tilt
(n_x, n_y)/n_z of a facet over (sigma_x, sigma_y).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .cox_munk import C04, C22, C40, SLOPE_VARIANCE_FLOOR, skewness_c03, skewness_c21
from .smith import facing_area, masked_area, slope_spread

GRAM_CHARLIER_WIND_MAX = 15.0
"""m/s: measured up to 14; in stronger wind the series is negative inside 3 sigma, so it is held at this wind."""

_NEGATIVE_MASS = (1.39320e-5, 9.23617, 2.15488)
"""Scale, onset (m/s) and power of the mass that K < 0 holds, a fit to quadrature within 1e-6 up to 15 m/s."""


def gaussian(ops, X, Y, sigma_x, sigma_y):
    """p0 = exp(-(X^2 + Y^2)/2)/(2 pi sigma_x sigma_y) (Eq. 7); 0 where the exponential underflows."""
    return ops.exp(ops.multiply_add(X, X, Y * Y) * -0.5) / (sigma_x * sigma_y * (2.0 * math.pi))


def gram_charlier_factor(ops, X, Y, c21, c03):
    """K(X, Y), what multiplies the Gaussian (Eq. 8 with Y = zeta_y/sigma_y); negative far out in strong wind.

    K integrates to 1 over the Gaussian and leaves mean 0 and variance 1 as they are.
    """
    X2, Y2 = X * X, Y * Y
    HX2, HY2 = X2 - 1.0, Y2 - 1.0
    HX4 = ops.multiply_add(X2, X2 - 6.0, 3.0)
    HY4 = ops.multiply_add(Y2, Y2 - 6.0, 3.0)
    skewness = X * ops.multiply_add(HY2, c21 * -0.5, (X2 - 3.0) * (c03 * (-1.0 / 6.0)))
    peakedness = ops.multiply_add(HX4, C04 / 24.0, ops.multiply_add(HY4, C40 / 24.0, HX2 * HY2 * (C22 / 4.0)))
    return ops.label(skewness + peakedness + 1.0, "Gram-Charlier K")


def negative_mass(ops, wind_speed):
    """delta(U), the probability that the Gram-Charlier density gives to K < 0 with its sign reversed.

    Zero up to 9.2 m/s, where K is nowhere negative by more than 1e-6; wind_speed up to `GRAM_CHARLIER_WIND_MAX`.
    """
    scale, onset, exponent = _NEGATIVE_MASS
    return ops.power(ops.maximum(wind_speed - onset, 0.0), exponent) * scale


def gram_charlier_masked_area(ops, gaussian_M, w, s_w, sigmas, c21, c03):
    """C(w) - w_z = M plus what skewness and peakedness along w add (THEORY section 5, visibility normaliser).

    C(w) = w_z Phi(c) + s n(c) [1 + g3 c/6 + g4 (c^2 - 1)/24], c = w_z/s, with g3 and g4 the third and fourth
    cumulants of the slopes along w; never below 0.
    """
    c = w[2] / s_w
    al = w[0] * sigmas[0] / s_w  # minus the theory's, which cancels the minus of g3
    be = w[1] * sigmas[1] / s_w
    al2, be2 = al * al, be * be
    g3 = al * ops.multiply_add(al2, c03, 3.0 * be2 * c21)
    g4 = ops.multiply_add(be2 * be2, C40, al2 * ops.multiply_add(al2, C04, be2 * (6.0 * C22)))
    bracket = ops.multiply_add(g3 * c, 1.0 / 6.0, g4 * ops.multiply_add(c, c, -1.0) * (1.0 / 24.0))
    return ops.maximum(ops.multiply_add(facing_area(ops, c, s_w), bracket, gaussian_M), 0.0)


@dataclass(frozen=True, eq=False)
class GaussianSlopes:
    """Gaussian slopes of deviations sigma_x along and sigma_y across the wind, both > 0.

    `smith_masked_area` is the form of Smith's M to use: `smith.masked_area` for shading.
    """

    sigma_x: Any
    sigma_y: Any
    smith_masked_area: Callable = masked_area

    def density(self, ops, tilt_x, tilt_y):
        """p of the slope (-tilt_x, -tilt_y), per unit slope squared (Eq. 7)."""
        X, Y = tilt_x / self.sigma_x, tilt_y / self.sigma_y
        return ops.label(gaussian(ops, X, Y, self.sigma_x, self.sigma_y), "Slope density p")

    def masked_area(self, ops, w):
        """M of the direction w = (w_x, w_y, w_z), w_z >= 0 (Eqs. 16, 17)."""
        return self.smith_masked_area(ops, w[2], slope_spread(ops, w[0], w[1], self.sigma_x, self.sigma_y))


@dataclass(frozen=True, eq=False)
class GramCharlierSlopes(GaussianSlopes):
    """Cox and Munk's skewed and peaked slopes (Eq. 8) of the same deviations, for a wind in m/s at 12.5 m.

    Skewness is held at its value for `GRAM_CHARLIER_WIND_MAX`, negative densities are cut to 0 and the rest
    divided by what it then integrates to.
    """

    wind_speed: Any = 0.0

    def _held_wind(self, ops):
        return ops.minimum(self.wind_speed, GRAM_CHARLIER_WIND_MAX)

    def density(self, ops, tilt_x, tilt_y):
        """max(K, 0) p0/(1 + delta) of the slope (-tilt_x, -tilt_y) (Eq. 8, clamped)."""
        U = self._held_wind(ops)
        X, Y = tilt_x / self.sigma_x, tilt_y / self.sigma_y
        K = ops.maximum(gram_charlier_factor(ops, X, Y, skewness_c21(U), skewness_c03(U)), 0.0)
        p0 = gaussian(ops, X, Y, self.sigma_x, self.sigma_y)
        return ops.label(p0 * K / (negative_mass(ops, U) + 1.0), "Slope density p")

    def masked_area(self, ops, w):
        """M = C(w) - w_z of the direction w with the visibility normaliser C of the series."""
        U = self._held_wind(ops)
        s_w = slope_spread(ops, w[0], w[1], self.sigma_x, self.sigma_y)
        M = self.smith_masked_area(ops, w[2], s_w)
        sigmas = (self.sigma_x, self.sigma_y)
        return gram_charlier_masked_area(ops, M, w, s_w, sigmas, skewness_c21(U), skewness_c03(U))


def slope_deviation(ops, variance):
    """sigma of a slope variance, at least that of a mirror under the sun: a calm sea would divide by 0."""
    return ops.sqrt(ops.maximum(variance, SLOPE_VARIANCE_FLOOR))
