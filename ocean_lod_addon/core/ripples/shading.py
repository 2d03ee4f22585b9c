# SPDX-License-Identifier: GPL-3.0-or-later
"""What the shader does with ripples, over `ops`: the reference and the nodes are the same formulas.

All vectors are in the object's axes, z up; slopes are per undisturbed metre. Two horizontal axes matter at a
shading point: u, from the point towards the viewer, and v, to the left of it.

A pixel is a patch of water, long along u and narrow along v. Slopes along u are made by waves that run along u,
slopes along v by waves that run along v, so both are faded by their own side of the patch, and what is faded goes
to the BRDF: with F = diag(f_u, f_v) a band of slope variance B shows F B F and leaves B - F B F.
"""

from typing import Any, NamedTuple

FOOTPRINT = 0.4
"""Standard deviation of what a pixel averages over, in pixels: between a box and the filter of Cycles."""

GRAZING_COSINE = 1e-3
"""Least cosine of the angle of view: smooth shading bends normals of visible points beyond edge-on."""

HORIZONTAL_FLOOR = 1e-6
"""Keeps the horizontal direction of view finite straight above."""

VISIBLE_SHARE = 0.98
"""A slope reaches at most this share of the slope at which it is seen edge-on."""

SHOWN_FLOOR = 1e-12
"""Least variance of the shown slopes along u: a covariance is divided by it."""

_MILLS_0 = 0.7978845608028654  # sqrt(2 / pi)
_MILLS_1, _MILLS_2 = 0.77551088, 0.25209983


class View(NamedTuple):
    """How a shading point is seen: the unit vector u, the slope along u at which a facet is seen edge-on, and the
    variances of a pixel's footprint along u and v in m^2."""

    u_x: Any
    u_y: Any
    edge_on: Any
    footprint_u: Any
    footprint_v: Any


class Tensor(NamedTuple):
    """Variances and covariance of two components of the slope."""

    aa: Any
    bb: Any
    ab: Any


class BandLook(NamedTuple):
    """What a shading point sees of a band: slopes along u and v, their variances, and those left to the BRDF."""

    slope_u: Any
    slope_v: Any
    shown: Tensor
    faded: Tensor


def view_of(ops, to_viewer, normal, distance, pixel_angle, pixel_size) -> View:
    """`to_viewer` and `normal` (of the mesh) are unit vectors as (x, y, z), `distance` from the camera is in m.

    A pixel is distance pixel_angle + pixel_size wide: the angle in rad of a perspective camera, the size in m of
    an orthographic one.
    """
    v_x, v_y, v_z = to_viewer
    n_x, n_y, n_z = normal
    horizontal = ops.sqrt(v_x * v_x + v_y * v_y) + HORIZONTAL_FLOOR
    u_x, u_y = (v_x + HORIZONTAL_FLOOR) / horizontal, v_y / horizontal
    cosine = ops.maximum(v_x * n_x + v_y * n_y + v_z * n_z, GRAZING_COSINE)
    cosine = ops.label(cosine / ops.maximum(n_z, GRAZING_COSINE), "cosine of view over n_z")
    edge_on = ops.label(cosine / horizontal, "edge-on slope")
    across = ops.multiply_add(distance, pixel_angle, pixel_size) * FOOTPRINT
    along = across / cosine
    return View(
        u_x,
        u_y,
        edge_on,
        ops.label(along * along, "footprint along view"),
        ops.label(across * across, "footprint across view"),
    )


def blend_weight(ops, t_x, t_y):
    """Weight of a grid's cell at the place (t_x, t_y), 0 to 1, in it, not normalised: 0 on its border."""
    return t_x * (1.0 - t_x) * (t_y * (1.0 - t_y))


def blend_normaliser(ops, weights):
    """1 / sqrt(sum w^2): the sum of w_i s_i then has the variance that each of the independent s_i has."""
    first, second, third = weights
    return 1.0 / ops.sqrt(ops.multiply_add(first, first, ops.multiply_add(second, second, third * third)))


def kept_variance(ops, footprint, wavenumber):
    """Share of a band's slope variance that a pixel keeps: 1 / (1 + (k^2 footprint)^2), footprint in m^2."""
    squared = footprint * wavenumber**2
    return 1.0 / ops.multiply_add(squared, squared, 1.0)


def along_view(ops, view: View, x, y):
    """Components (u, v) of a horizontal vector."""
    return ops.multiply_add(x, view.u_x, y * view.u_y), ops.multiply_add(y, view.u_x, -1.0 * (x * view.u_y))


def from_view(ops, view: View, u, v):
    """Components (x, y) of a horizontal vector."""
    return ops.multiply_add(u, view.u_x, -1.0 * (v * view.u_y)), ops.multiply_add(u, view.u_y, v * view.u_x)


def tensor_along_view(ops, view: View, tensor: Tensor) -> Tensor:
    """A tensor of the axes x, y in the axes u, v."""
    c, s = view.u_x, view.u_y
    cc, ss, cs = c * c, s * s, c * s
    double = 2.0 * cs
    xx, yy, xy = tensor
    return Tensor(
        ops.multiply_add(cc, xx, ops.multiply_add(ss, yy, double * xy)),
        ops.multiply_add(ss, xx, ops.multiply_add(cc, yy, -1.0 * (double * xy))),
        ops.multiply_add(cs, yy - xx, (cc - ss) * xy),
    )


def tensor_from_view(ops, view: View, tensor: Tensor) -> Tensor:
    """A tensor of the axes u, v in the axes x, y."""
    return tensor_along_view(ops, view._replace(u_y=-1.0 * view.u_y), tensor)


def band_look(ops, view: View, wavenumber: float, tensor: Tensor, share, slope_x, slope_y) -> BandLook:
    """A band of this middle wavenumber (rad/m) and slope variance, of which the mesh leaves `share` to the bump.

    The slopes are those of the whole band.
    """
    kept_u = kept_variance(ops, view.footprint_u, wavenumber)
    kept_v = kept_variance(ops, view.footprint_v, wavenumber)
    gain_u, gain_v = ops.sqrt(kept_u * share), ops.sqrt(kept_v * share)
    s_u, s_v = along_view(ops, view, slope_x, slope_y)
    uu, vv, uv = tensor_along_view(ops, view, tensor)
    whole = Tensor(uu * share, vv * share, uv * share)
    shown = Tensor(whole.aa * kept_u, whole.bb * kept_v, uv * (gain_u * gain_v))
    faded = Tensor(*(all_of_it - part for all_of_it, part in zip(whole, shown, strict=True)))
    return BandLook(s_u * gain_u, s_v * gain_v, shown, faded)


def add_looks(looks) -> BandLook:
    """Bands are independent: slopes and variances add."""
    total = looks[0]
    for look in looks[1:]:
        total = BandLook(
            total.slope_u + look.slope_u,
            total.slope_v + look.slope_v,
            Tensor(*(a + b for a, b in zip(total.shown, look.shown, strict=True))),
            Tensor(*(a + b for a, b in zip(total.faded, look.faded, strict=True))),
        )
    return total


def mills_ratio_fit(ops, a):
    """phi(a) / Phi(a) of the normal distribution for a >= 0, so that 1 / (a + it) is right to 0.4 %."""
    return _MILLS_0 * ops.exp(a * ops.multiply_add(a, -_MILLS_2, -_MILLS_1))


def visible_slopes(ops, view: View, slope_u, slope_v, shown: Tensor, rest_variance_u):
    """The shown slopes (u, v) as a viewer meets them: facets that lean towards the viewer look larger.

    Of slopes along u of variance s^2, with BRDF facets of variance r^2 on them, the viewer sees the density
    p(s_u) C(e - s_u), with C the mean projected area of the facets and e the slope seen edge-on (THEORY section
    6: the (1 + Lambda) of a Gaussian). With a = e / sqrt(s^2 + r^2), lambda = phi/Phi and h = 1 / (a + lambda),
    its mean is -s^2 h / sqrt(s^2 + r^2), its variance s^2 [1 + s^2 / (s^2 + r^2) h (lambda - h)]. A bump map
    shows every facet the same size; mapping its slopes to this mean and variance makes up for it, and turns no
    facet away.
    """
    total = ops.maximum(shown.aa + rest_variance_u, SHOWN_FLOOR)
    deviation = ops.sqrt(total)
    a = view.edge_on / deviation
    mills = mills_ratio_fit(ops, a)
    h = 1.0 / (a + mills)
    share = shown.aa / total
    narrowing = ops.sqrt(ops.multiply_add(share * h, mills - h, 1.0))
    mean = -1.0 * (share * deviation * h)
    seen = ops.minimum(ops.multiply_add(slope_u, narrowing, mean), view.edge_on * VISIBLE_SHARE)
    seen = ops.label(seen, "visible slope along view")
    follows = shown.ab / ops.maximum(shown.aa, SHOWN_FLOOR)
    return seen, ops.label(ops.multiply_add(follows, seen - slope_u, slope_v), "visible slope across view")


def bumped_normal(ops, normal, slope_x, slope_y):
    """The mesh's normal (x, y, z) with slopes added to its own, not normalised: N - N_z (s_x, s_y, 0)."""
    n_x, n_y, n_z = normal
    opposite = -1.0 * n_z
    return ops.multiply_add(opposite, slope_x, n_x), ops.multiply_add(opposite, slope_y, n_y), n_z
