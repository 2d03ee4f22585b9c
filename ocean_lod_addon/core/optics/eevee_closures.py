# SPDX-License-Identifier: GPL-3.0-or-later
"""What EEVEE's closures must be told so that they show what is meant.

**Where reflected light comes from.** EEVEE looks at the sky in one direction, in a picture of it that is blurred
around that direction by an isotropic lobe. Both follow from the closure's normal n and its roughness r
(alpha = r^2):

    direction ~ (1 - f) n + f R,   R = 2 (v.n) n - v,   f = (1 - alpha) (sqrt(1 - alpha) + alpha)
    1 - |mean direction of the lobe| = 2 alpha^2/(1 + 1.3 alpha)       (measured, alpha from 0.2 to 0.45)

With the sea's normal and roughness it would look too low near the horizon (the facets that are seen there lean
towards the viewer), and partly below it.

**How bright a closure is.** EEVEE keeps its color in ten bits and cuts off the rest, which is much of the
reflectance of water.
"""

import math

from . import beckmann

ALPHA_MIN = math.sqrt(beckmann.ALPHA_SQUARED_MIN)

HALF_COLOR_STEP = 0.5 / 1023.0
"""What EEVEE cuts off the color of a closure, on average."""

COS_VIEW_MIN = 1e-3
"""Keeps the bisector of v and l from vanishing where both graze, so that its direction survives in float32."""

_SINE_SQUARED_MIN = 1e-12
"""Prevents 0/0 at the zenith, where v is the normal and the azimuth of the source does not matter."""


def alpha_of_spread(ops, source_variance):
    """alpha of a lobe with 1 - |mean direction| = source_variance, within what the closures can hold."""
    linear = 0.25 * 1.3 * source_variance
    alpha = linear + ops.sqrt(ops.multiply_add(linear, linear, 0.5 * source_variance))
    return ops.maximum(ops.minimum(alpha, 1.0), ALPHA_MIN)


def normal_towards(ops, cos_view, sine_of_source, alpha):
    """(p, q) of the normal p N + q v, not normalised, with which EEVEE looks at a given elevation.

    The source l is opposite v, sine_of_source above the surface: l = (z + c rho) N - rho v, rho^2 = (1 - z^2) /
    (1 - c^2). Were f = 1, n would be the bisector of v and l. EEVEE looks closer to n than R, by an angle delta
    with f sin(delta) = (1 - f) sin(psi/2 - delta/2), psi the angle between v and l; so n is delta/2 further from
    v. To first order in delta, tan(delta/2) = g sin(psi/2) with g = (1 - f)/(2 f + (1 - f) cos(psi/2)): exact for
    f = 1 and f = 0.
    """
    c, z = cos_view, sine_of_source
    rho2 = ops.maximum(1.0 - z * z, 0.0) / ops.maximum(1.0 - c * c, _SINE_SQUARED_MIN)
    rho = ops.label(ops.sqrt(rho2), "rho")
    l_n = ops.label(ops.multiply_add(c, rho, z), "l along normal")
    cos_psi = ops.multiply_add(l_n, c, rho * -1.0)
    half = ops.sqrt(ops.maximum(ops.multiply_add(cos_psi, 0.5, 0.5), 0.0))
    smooth = 1.0 - alpha
    f = ops.label(smooth * (ops.sqrt(smooth) + alpha), "f")
    rest = 1.0 - f
    g = rest * half / ops.multiply_add(rest, half, 2.0 * f)
    return l_n * (1.0 + g), 1.0 - rho - g * (1.0 + rho)
