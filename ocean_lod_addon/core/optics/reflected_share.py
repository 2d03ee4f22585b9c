# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the sky a rough sea throws back to the viewer by one reflection, and from where.

Less than the mean Fresnel reflectance over the visible slopes: some facets mirror the viewer's ray downwards,
where it meets the water a second time. It then mostly enters the water, so the sea shows its own color there.

The light comes from higher up than from a mirror near the horizon (the visible facets lean towards the viewer, and
those that mirror downwards do not count), and from lower down at mid angles (a facet that leans away reflects
more). It also comes from a narrower range of elevations there.
"""

from typing import Any, NamedTuple

import numpy as np

from . import fresnel, ross
from .mean_fresnel import visible_slopes


class ReflectedLight(NamedTuple):
    """A uniform sky's light in a sea, as the viewer sees it."""

    share: Any
    """Radiance over that of the sky: the single-scattering albedo with F (THEORY section 6, energy)"""
    mean_direction: Any
    """(x, y, z), the mean of the unit vectors to where the light comes from; the shorter, the wider the spread"""


def reflected_light_reference(
    ops, view, slopes, refractive_index, order=64, reflectance=fresnel.exact
) -> ReflectedLight:
    """Integrals of q(zeta, v, l) F(v.f), and of that times l, over the slopes that mirror v upwards. NumPy only.

    q is Eq. 13 with the light l that each slope mirrors to v, F a formula of `fresnel`. By quadrature.
    """
    tilt_x, tilt_y, weight = visible_slopes(view, slopes, order)
    secant = np.sqrt(1.0 + tilt_x**2 + tilt_y**2)
    cos_incidence = np.clip(ross.shown_area(ops, view, (tilt_x, tilt_y)) / secant, 0.0, 1.0)
    light = [2.0 * cos_incidence * n / secant - v for n, v in zip((tilt_x, tilt_y, 1.0), view, strict=True)]
    upwards = light[2] > 0.0
    light[2] = np.where(upwards, light[2], 1.0)
    q = ross.visible_slope_density(ops, (tilt_x, tilt_y), view, slopes, light)
    reflected = weight * q * reflectance(ops, cos_incidence, refractive_index) * upwards
    share = float(reflected.sum())
    return ReflectedLight(share, tuple(float((reflected * component).sum()) / share for component in light))


def reflected_share(ops, cos_view, s_v, refractive_index):
    """The reflectance of the sea under a uniform sky, in few operations.

    The Fresnel factor at an effective cosine, which tends to cos theta_v on a smooth sea. s_v is the slope spread
    along v (`smith.slope_spread`). For n = 1.333, sigma_v from 0.02 to 0.3 and sigma across v from 0.8 to 1.25
    sigma_v, at every angle within 6 % of the quadrature, 2.1 % rms.
    """
    c, s = cos_view, s_v
    rise = ops.multiply_add(s, 19.208, ops.multiply_add(c, -8.8453, 2.0717))
    slower = ops.multiply_add(s, 26.029, ops.multiply_add(c, -0.7313, 1.0))
    effective = ops.multiply_add(s * s, rise / ops.multiply_add(s, slower, c * c * 1.6070), c)
    effective = ops.label(ops.maximum(ops.minimum(effective, 1.0), 0.0), "Effective cosine")
    return ops.label(fresnel.exact(ops, effective, refractive_index), "Reflected share")


def sine_of_source(ops, cos_view, s_v):
    """Sine of the elevation that the reflected light comes from on average, over the surface.

    cos theta_v of a mirror, 1.5 sigma_v at grazing. For sigma_v and sigma across it as in `reflected_share`,
    within 4.1 degrees of the quadrature, 1.3 degrees rms.
    """
    c, s = cos_view, s_v
    rise = ops.multiply_add(c, -2.6246, 1.4966) / ops.multiply_add(c * c, 1.2687, s)
    return ops.label(ops.minimum(ops.multiply_add(s * s, rise, c), 1.0), "Sine of source elevation")


def source_variance(ops, cos_view, slope_variance):
    """1 - |mean_direction|: half the variance of the direction that the reflected light comes from, rad^2.

    4 sigma^2 for a small sigma at the zenith, a quarter of it near the horizon; slope_variance is sigma^2, the
    geometric mean of the two variances. For sigma from 0.05 to 0.3 within 42 %, 12 % rms.
    """
    sigma = ops.sqrt(slope_variance)
    height = ops.multiply_add(cos_view, 3.6141, 1.1357)
    slower = ops.multiply_add(sigma, ops.multiply_add(cos_view, -4.9338, 6.5896), 1.0)
    return ops.label(slope_variance * height / slower, "Source variance")
