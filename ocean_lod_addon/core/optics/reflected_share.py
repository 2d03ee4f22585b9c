# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a bright sky all around a rough sea throws back to the viewer, by one reflection.

Less than the mean Fresnel reflectance over the visible slopes: some facets mirror the viewer's ray downwards,
where it meets the water a second time. It then mostly enters the water, so the sea shows its own color there.
"""

import numpy as np

from . import fresnel, ross
from .mean_fresnel import mean_fresnel, visible_slopes

COTANGENT_MAX = 100.0
"""Of the elevation over sigma_v: beyond it nothing is reflected downwards; keeps the fourth power in float32."""

SINE_MIN = 1e-3
"""Keeps sigma_v = s_v/sin theta finite at the zenith, where the loss does not depend on it."""


def reflected_share_reference(ops, view, slopes, refractive_index, order=64):
    """int q(zeta, v, l) F(v.f) d^2 zeta over the slopes that mirror v upwards, by quadrature. NumPy only.

    q is Eq. 13 with the light that each slope mirrors to v: the reflectance under a uniform sky (THEORY section 6,
    energy: the single-scattering albedo, with F).
    """
    tilt_x, tilt_y, weight = visible_slopes(view, slopes, order)
    secant = np.sqrt(1.0 + tilt_x**2 + tilt_y**2)
    cos_incidence = np.clip(ross.shown_area(ops, view, (tilt_x, tilt_y)) / secant, 0.0, 1.0)
    light = [2.0 * cos_incidence * n / secant - v for n, v in zip((tilt_x, tilt_y, 1.0), view, strict=True)]
    upwards = light[2] > 0.0
    light[2] = np.where(upwards, light[2], 1.0)
    q = ross.visible_slope_density(ops, (tilt_x, tilt_y), view, slopes, light)
    F = fresnel.exact(ops, cos_incidence, refractive_index)
    return float((weight * q * F * upwards).sum())


def share_mirrored_downwards(ops, cos_view, s_v):
    """Of what the visible facets reflect, the share that goes downwards: a fit to the quadrature.

    3.30 sigma_v^0.628 u/(3.47 + u^2 + 0.0627 u^4), u = cot theta/sigma_v; s_v is the slope spread along v
    (`smith.slope_spread`), sigma_v = s_v/sin theta.
    """
    u = ops.minimum(cos_view / s_v, COTANGENT_MAX)
    sine = ops.maximum(ops.sqrt(ops.maximum(ops.multiply_add(cos_view * -1.0, cos_view, 1.0), 0.0)), SINE_MIN)
    u2 = u * u
    height = ops.power(s_v / sine, 0.6281) * 3.2994
    falloff = ops.multiply_add(u2, ops.multiply_add(u2, 0.0627, 1.0), 3.4699)
    return ops.label(height * u / falloff, "Downward share")


def reflected_share(ops, cos_view, s_v, refractive_index):
    """The reflectance of the sea under a uniform sky, in few operations.

    For n = 1.333, sigma_v from 0.02 to 0.3 and sigma across v from 0.8 to 1.25 sigma_v, at every angle within
    0.028 and 14 % of the quadrature, 0.0055 rms.
    """
    F = mean_fresnel(ops, cos_view, s_v, refractive_index)
    return ops.label(F * (1.0 - share_mirrored_downwards(ops, cos_view, s_v)), "Reflected share")
