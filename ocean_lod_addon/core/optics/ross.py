# SPDX-License-Identifier: GPL-3.0-or-later
"""The Ross BRDF of a sea surface (Eqs. 13 to 24, corrected) in a form that shaders can trust.

Axes: z up, x downwind; v to the viewer, l to the light, unit vectors. With M = cos theta Lambda (`smith`),

    BRDF cos theta_l = p(zeta_h) (1 + |zeta_h|^2)^2 F(v.h) l_z / [4 (v_z l_z + l_z M_v + v_z M_l)]

No trigonometry, no division by a cosine. What is rendered, BRDF cos theta_l, is finite at every angle; the BRDF
alone is not.

**Resolved waves.** Slopes add. Where geometry and bump already tilt the surface by the slope zeta_bar, the BRDF
holds the remaining slopes, p(zeta_h - zeta_bar), and v_z becomes v_z - v_xy . zeta_bar, the area that the tilted
surface shows to v per horizontal area (THEORY section 6). Shaders meet zeta_bar as the **tilt** of the shading
normal n,

    tilt = (n_x, n_y)/n_z = -zeta_bar

which has the sign of the Gram-Charlier X and spares minus signs.

**Tangent frame.** The alternative, v and l as components along tangent, bitangent and normal and no tilt, is what
tangent-space shaders do. On a flat surface it is the same; on waves it is not quite: two equal scales of
waves, sigma 0.15 each, then make a slope variance of 0.0473 with kurtosis 3.33 instead of 0.0450 with 3.
"""

from typing import Any, NamedTuple

from . import fresnel

H_Z_MIN = 1e-6
"""Keeps the half vector's slope finite where v + l vanishes (light and viewer opposite, both grazing) or points
down; the density is 0 there, and (1 + |zeta|^2)^2 < 2e25 still fits float32."""

N_Z_MIN = 1e-3
"""Keeps the tilt finite where a breaking wave overhangs (n_z <= 0)."""

AREA_MIN = 1e-30
"""Prevents 0/0 where both directions graze exactly; the numerator is 0 there."""


class HalfVector(NamedTuple):
    """What the half vector h of v and l decides."""

    tilt_x: Any
    """h_x/h_z, minus the slope zeta_h of the facets that mirror l to v, downwind"""
    tilt_y: Any
    """h_y/h_z, the same across the wind"""
    secant2: Any
    """1 + |zeta_h|^2 = 1/h_z^2"""
    cos_incidence: Any
    """v.h = l.h"""


def half_vector(ops, view, light) -> HalfVector:
    """H = v + l, not normalised (Eq. 24); for unit v and l, v.h = |H|/2, which nothing cancels in."""
    H_x, H_y = view[0] + light[0], view[1] + light[1]
    H_z = ops.maximum(view[2] + light[2], H_Z_MIN)
    x, y = H_x / H_z, H_y / H_z
    secant2 = ops.multiply_add(x, x, ops.multiply_add(y, y, 1.0))
    cos_incidence = ops.minimum(H_z * ops.sqrt(secant2) * 0.5, 1.0)
    return HalfVector(x, y, ops.label(secant2, "1 + slope squared"), ops.label(cos_incidence, "v . h"))


def tilt_of_normal(ops, normal):
    """The tilt (n_x, n_y)/n_z of a shading normal in wind axes."""
    n_z = ops.maximum(normal[2], N_Z_MIN)
    return normal[0] / n_z, normal[1] / n_z


def to_wind_axes(ops, vector, wind_x, wind_y):
    """A world vector in axes with x along the unit vector (wind_x, wind_y) that the wind blows towards."""
    x, y, z = vector
    return (
        ops.multiply_add(x, wind_x, y * wind_y),
        y * wind_x - x * wind_y,
        z,
    )


def shown_area(ops, w, tilt):
    """(w . f)/f_z of a facet of the given tilt: the area it shows to w per horizontal area, negative behind."""
    return ops.multiply_add(w[0], tilt[0], ops.multiply_add(w[1], tilt[1], w[2]))


def reflection_lobe(ops, view, light, half: HalfVector, slopes, tilt=None):
    """BRDF cos theta_l, 1/sr, of facets that reflect everything (F = 1): 0 for light below the surface.

    `slopes` is one of the distributions of `slope_density`; `tilt` the resolved one, None for a flat surface. A
    view that grazes or looks from behind the tilted surface, as interpolated normals do at silhouettes, has the
    value of exact grazing, so that there is no black seam.
    """
    tilt_x, tilt_y = half.tilt_x, half.tilt_y
    v_z, l_z = view[2], light[2]
    if tilt is not None:
        tilt_x, tilt_y = tilt_x - tilt[0], tilt_y - tilt[1]
        v_z, l_z = shown_area(ops, view, tilt), shown_area(ops, light, tilt)
    v_z, l_z = ops.maximum(v_z, 0.0), ops.maximum(l_z, 0.0)
    p = slopes.density(ops, tilt_x, tilt_y)
    M_v = slopes.masked_area(ops, (view[0], view[1], v_z))
    M_l = slopes.masked_area(ops, (light[0], light[1], l_z))
    area = ops.multiply_add(l_z, v_z + M_v, v_z * M_l)
    visible = ops.label(l_z / ops.maximum(area, AREA_MIN), "Visible and lit share")
    return ops.label(p * half.secant2 * half.secant2 * visible * 0.25, "Lobe")


def sun_radiance_factor(ops, view, light, slopes, refractive_index, tilt=None):
    """What a sun's irradiance (on a plane facing it) is multiplied by to give the radiance that v sees, 1/sr.

    The whole of it: Ross BRDF with exact Fresnel times cos theta_l. Vectors are unit vectors in wind axes
    (`to_wind_axes`), `tilt` is that of the shading normal (`tilt_of_normal`), `slopes` are the slopes that the
    normal leaves out.
    """
    half = half_vector(ops, view, light)
    lobe = reflection_lobe(ops, view, light, half, slopes, tilt)
    F = fresnel.exact(ops, half.cos_incidence, refractive_index)
    return ops.label(lobe * F, "Sun radiance factor")


def brdf_cos(ops, view, light, slopes, refractive_index):
    """BRDF cos theta_l, 1/sr, over the mean plane (Eq. 22); 0 if v or l is not above it."""
    above = ops.less_than(0.0, ops.minimum(view[2], light[2]))
    return ops.where(above, sun_radiance_factor(ops, view, light, slopes, refractive_index), 0.0)


def brdf(ops, view, light, slopes, refractive_index):
    """The Ross BRDF, 1/sr (Eq. 22); 0 if v or l is not above the mean plane. Reciprocal, unbounded at grazing."""
    cos_light = ops.where(ops.less_than(0.0, light[2]), light[2], 1.0)
    return brdf_cos(ops, view, light, slopes, refractive_index) / cos_light


def visible_slope_density(ops, tilt, view, slopes, light=None):
    """q(zeta, v, l) for zeta = -tilt: the density of slopes as v sees them, those in shadow of l left out.

    p max(v.f, 0)/[f_z cos theta_v (1 + Lambda_v + Lambda_l)] (Eq. 13); without a light Lambda_l is absent
    (Eq. 20) and the integral over all slopes is 1 (Eq. 21). v_z and l_z > 0; the facet must face the light.
    """
    area = view[2] + slopes.masked_area(ops, view)
    if light is not None:
        area = area + view[2] * slopes.masked_area(ops, light) / light[2]
    return slopes.density(ops, tilt[0], tilt[1]) * ops.maximum(shown_area(ops, view, tilt), 0.0) / area
