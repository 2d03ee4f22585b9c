# SPDX-License-Identifier: GPL-3.0-or-later
"""Slope variances as the sockets of Blender's microfacet closures (distribution Beckmann).

The Ross BRDF is an anisotropic Beckmann BRDF with alpha = sqrt(2) sigma per axis (THEORY section 6). These
functions turn sigma_x^2 (along the wind) and sigma_y^2 (across) into the closures' own parameters.
"""

from typing import Any, NamedTuple

ALPHA_SQUARED_MIN = 5e-7
"""sigma = 5e-4: below it Cycles' Beckmann lobe loses precision."""

ALPHA_SQUARED_MAX = 1.0
"""Cycles clamps alpha at 1 (sigma = 0.707)."""

ASPECT_MIN = 0.1
"""alpha_min/alpha_max of the Metallic closure at Anisotropy 1, its largest."""

GLOSSY_ANISOTROPY_MAX = 0.99
"""The largest Anisotropy of the Glossy closure, of either sign."""


class MetallicSockets(NamedTuple):
    """Roughness and Anisotropy of the Metallic closure; along_wind is 1 where its Tangent is the wind, 0 where
    it is across (Tangent must lie along the rougher axis)."""

    roughness: Any
    anisotropy: Any
    along_wind: Any


class GlossySockets(NamedTuple):
    """Roughness and Anisotropy of the Glossy closure, whose Tangent is the wind."""

    roughness: Any
    anisotropy: Any


def alpha_squared(ops, slope_variance):
    """alpha^2 = 2 sigma^2, within what the closures can hold (`ALPHA_SQUARED_MIN`, `ALPHA_SQUARED_MAX`)."""
    return ops.maximum(ops.minimum(2.0 * slope_variance, ALPHA_SQUARED_MAX), ALPHA_SQUARED_MIN)


def roughness(ops, alpha_x2, alpha_y2):
    """Roughness = (alpha_x alpha_y)^(1/2) ^(1/2): Blender squares it into the mean alpha."""
    return ops.label(ops.sqrt(ops.sqrt(ops.sqrt(alpha_x2 * alpha_y2))), "Roughness")


def metallic_sockets(ops, variance_x, variance_y) -> MetallicSockets:
    """The Metallic closure's sockets: Anisotropy = (1 - alpha_min/alpha_max)/0.9 (DESIGN section 4)."""
    alpha_x2, alpha_y2 = alpha_squared(ops, variance_x), alpha_squared(ops, variance_y)
    squared_aspect = ops.minimum(alpha_x2, alpha_y2) / ops.maximum(alpha_x2, alpha_y2)
    aspect = ops.maximum(ops.sqrt(squared_aspect), ASPECT_MIN)
    anisotropy = ops.label((1.0 - aspect) * (1.0 / 0.9), "Anisotropy")
    along_wind = ops.label(ops.less_than(alpha_y2, alpha_x2), "Rougher along the wind")
    return MetallicSockets(roughness(ops, alpha_x2, alpha_y2), anisotropy, along_wind)


def glossy_sockets(ops, variance_x, variance_y) -> GlossySockets:
    """The Glossy closure's sockets: Anisotropy = +-(1 - sqrt(alpha_min/alpha_max)), positive where the wind
    axis is the smoother one (DESIGN section 4)."""
    alpha_x2, alpha_y2 = alpha_squared(ops, variance_x), alpha_squared(ops, variance_y)
    squared_aspect = ops.minimum(alpha_x2, alpha_y2) / ops.maximum(alpha_x2, alpha_y2)
    size = ops.minimum(1.0 - ops.sqrt(ops.sqrt(squared_aspect)), GLOSSY_ANISOTROPY_MAX)
    sign = 1.0 - 2.0 * ops.less_than(alpha_y2, alpha_x2)
    return GlossySockets(roughness(ops, alpha_x2, alpha_y2), ops.label(sign * size, "Anisotropy"))
