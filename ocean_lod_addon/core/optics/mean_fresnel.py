# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light a rough sea reflects on average, over the slopes that the viewer sees (THEORY section 7).

Roughness cuts the reflectance of the horizon by half and more: the Fresnel factor of the mean plane is no
substitute for it.
"""

import numpy as np

from . import fresnel, ross

_SUM_MIN = 1e-6
"""Prevents 0/0 where a perfectly smooth sea is seen at grazing: c = s = 0."""

_REACH = 9.0
"""Standard deviations that the quadrature covers: 1e-19 of the Gaussian lies beyond."""


def visible_slopes(view, slopes, order=64):
    """Tilts (x, y) and weights, each (order, order), of a quadrature over the slopes that face `view`.

    sum(weight g(tilt)) is the integral of g over slopes with v.f > 0. Gauss-Legendre in the standardised plane,
    along and across the gradient of v.f, so that the kink at v.f = 0 is an edge. `view` is (x, y, z) of floats.
    NumPy only.
    """
    x, y = view[0] * slopes.sigma_x, view[1] * slopes.sigma_y
    s_v = np.hypot(x, y)
    along_x, along_y = (x / s_v, y / s_v) if s_v > 0.0 else (1.0, 0.0)
    nodes, weights = np.polynomial.legendre.leggauss(order)
    low = -_REACH if view[2] >= _REACH * s_v else -view[2] / s_v
    T = (0.5 * (low + _REACH) + 0.5 * (_REACH - low) * nodes)[:, np.newaxis]
    N = (_REACH * nodes)[np.newaxis, :]
    weight = np.outer(0.5 * (_REACH - low) * weights, _REACH * weights) * slopes.sigma_x * slopes.sigma_y
    tilt_x = slopes.sigma_x * (along_x * T - along_y * N)
    tilt_y = slopes.sigma_y * (along_y * T + along_x * N)
    return tilt_x, tilt_y, weight


def mean_over_visible_slopes(ops, reflectance, view, slopes, order=64):
    """int q(zeta) F(v.f) d^2 zeta with q of Eq. 20, by quadrature: the reference. NumPy only.

    `reflectance` takes the cosine of incidence.
    """
    tilt_x, tilt_y, weight = visible_slopes(view, slopes, order)
    tilt = (tilt_x, tilt_y)
    q = ross.visible_slope_density(ops, tilt, view, slopes)
    cos_incidence = ross.shown_area(ops, view, tilt) / np.sqrt(1.0 + tilt_x**2 + tilt_y**2)
    return float((weight * q * reflectance(np.clip(cos_incidence, 0.0, 1.0))).sum())


def mean_fresnel(ops, cos_view, s_v, refractive_index):
    """Fbar, the exact Fresnel reflectance averaged over the visible slopes: a fit in few operations.

    The Fresnel factor at an effective cosine, which tends to cos theta_v on a smooth sea and to 1.3 sigma_v at
    grazing. s_v is the slope spread along v (`smith.slope_spread`). For n = 1.333, sigma_v up to 0.3 and
    sigma across v from 0.8 to 1.25 sigma_v, at every angle: within 0.0095, 0.0031 rms.
    """
    c, s = cos_view, s_v
    A, B, C, D, E = 1.5863, 1.2028, -3.0975, 1.9448, 3.9643
    across = ops.multiply_add(s, ops.multiply_add(s, D, ops.multiply_add(c, C, B)), c)
    effective = ops.multiply_add(s * s, ops.multiply_add(c, -E, A) / ops.maximum(across, _SUM_MIN), c)
    effective = ops.label(ops.maximum(ops.minimum(effective, 1.0), 0.0), "Effective cosine")
    return ops.label(fresnel.exact(ops, effective, refractive_index), "Mean Fresnel")


def mean_fresnel_bruneton(ops, cos_view, sigma_v, refractive_index):
    """Bruneton's fit to the mean of Schlick's F (THEORY section 7): up to 0.095 off the mean of the exact one.

    R + (1-R)(1 - cos theta)^(5 exp(-2.69 sigma_v))/(1 + 22.7 sigma_v^1.5), sigma_v the deviation along v.
    """
    R = fresnel.normal_incidence(refractive_index)
    falloff = ops.power(1.0 - cos_view, 5.0 * ops.exp(-2.69 * sigma_v))
    return R + (1.0 - R) * falloff / (1.0 + 22.7 * ops.power(sigma_v, 1.5))
