# SPDX-License-Identifier: GPL-3.0-or-later
"""Smith's masking of a rough surface by itself, in a form that lives at grazing angles (Eqs. 16, 17).

Smith's Lambda grows without bound as a direction w grazes, its product with w_z does not. So shading never
forms Lambda: it uses the masked area M = w_z Lambda of w, from w_z and the slope spread seen along w,

    s_w = sqrt(sigma_x^2 w_x^2 + sigma_y^2 w_y^2)        (sin theta times the slope deviation along phi)
    M   = s_w/sqrt(2 pi) exp(-a^2) [1 - sqrt(pi) a erfcx(a)],        a = w_z/(sqrt(2) s_w)

which needs no angle, no division by a cosine and no special case at the zenith (THEORY section 6). Like w_z it
is an area per horizontal area: w_z + M is what the facets facing w show to it.
"""

import math

import numpy as np

from .erf import erfc_eq19, erfcx

SPREAD_SQUARED_MIN = 1e-30
"""Prevents w_z/0 at the zenith, where s_w = 0 and M is exactly 0; (w_z/s_w)^2 = 1e30 still fits float32."""

_A_MAX = 40.0
"""Beyond it exp(-a^2) is 0 in float64; keeps infinity times 0 out of Lambda."""

_ABRAMOWITZ_STEGUN_P = 0.3275911
_ABRAMOWITZ_STEGUN_C = (0.254829592, -0.284496736, 1.421413741, -1.453152027, 1.061405429)
"""erfcx(a) = t (c1 + t (c2 + ...)), t = 1/(1 + p a), times exp(-a^2) within 1.5e-7 (7.1.26)."""

_SQRT_2 = math.sqrt(2.0)
_SQRT_PI = math.sqrt(math.pi)
_SQRT_2_PI = math.sqrt(2.0 * math.pi)


def slope_spread(ops, w_x, w_y, sigma_x, sigma_y):
    """s_w, the slope deviation along the azimuth of w times sin theta (THEORY section 6)."""
    x, y = w_x * sigma_x, w_y * sigma_y
    return ops.sqrt(ops.multiply_add(x, x, ops.multiply_add(y, y, SPREAD_SQUARED_MIN)))


def masked_area(ops, w_z, s_w):
    """M = w_z Lambda for w_z >= 0, with erfcx after Abramowitz and Stegun 7.1.26: 1 + Lambda within 1e-7.

    Written in c = w_z/s_w = sqrt(2) a with the constants multiplied out. With the paper's erfc (Eq. 19) it would
    take as many operations and be off by up to 5.9e-4.
    """
    c = w_z / s_w
    t = 1.0 / ops.multiply_add(c, _ABRAMOWITZ_STEGUN_P / _SQRT_2, 1.0)
    c1, c2, c3, c4, c5 = (-_SQRT_PI / _SQRT_2 * coefficient for coefficient in _ABRAMOWITZ_STEGUN_C)
    polynomial = ops.multiply_add(t, c5, c4)
    for coefficient in (c3, c2, c1):
        polynomial = ops.multiply_add(t, polynomial, coefficient)
    masked_share = ops.multiply_add(c * t, polynomial, 1.0)
    return ops.label(facing_area(ops, c, s_w) * masked_share, "Masked area M")


def facing_area(ops, c, s_w):
    """s_w n(c), with n the density of the standard normal distribution."""
    return s_w * (1.0 / _SQRT_2_PI) * ops.exp(c * c * -0.5)


def masked_area_exact(ops, w_z, s_w):
    """M to float64: the reference for `masked_area`. NumPy only; `ops` is there to share its signature."""
    a = np.minimum(np.divide(w_z, _SQRT_2 * np.asarray(s_w)), _A_MAX)
    return s_w / _SQRT_2_PI * np.exp(-(a**2)) * (1.0 - _SQRT_PI * a * erfcx(a))


def a_of_direction(theta, phi, variance_x, variance_y):
    """a = [2 (sigma_x^2 cos^2 phi + sigma_y^2 sin^2 phi) tan^2 theta]^(-1/2) (Eq. 17, its tangent squared)."""
    along_phi = variance_x * np.cos(phi) ** 2 + variance_y * np.sin(phi) ** 2
    with np.errstate(divide="ignore"):  # a is infinite at the zenith
        return 1.0 / np.sqrt(2.0 * along_phi * np.tan(theta) ** 2)


def smith_lambda(a):
    """Lambda(a) = exp(-a^2)/2 [1/(a sqrt(pi)) - erfcx(a)] for a > 0 (Eq. 16), to float64."""
    a = np.minimum(np.asarray(a, dtype=np.float64), _A_MAX)
    return 0.5 * np.exp(-(a**2)) * (1.0 / (a * _SQRT_PI) - erfcx(a))


def smith_lambda_eq19(ops, a):
    """Lambda(a) for a > 0 with the paper's own erfc (Eqs. 16 and 19)."""
    return (ops.exp(-(a * a)) - a * _SQRT_PI * erfc_eq19(ops, a)) / (2.0 * a * _SQRT_PI)
