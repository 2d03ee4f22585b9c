# SPDX-License-Identifier: GPL-3.0-or-later
"""What the shader does with ripples, over `ops`: the reference and the nodes are the same formulas.

All vectors are in the object's axes, z up; slopes are per undisturbed metre. Two horizontal axes matter at a
shading point: u, from the point towards the viewer, and v, to the left of it.

A pixel is a patch of water, long along u and narrow along v. Slopes along u are made by waves that run along u,
slopes along v by waves that run along v, so both are faded by their own side of the patch. With F = diag(f_u, f_v)
a band of slope variance B shows F B F; what the mesh does not show and no band either is left to the BRDF.
"""

from typing import Any, NamedTuple

FOOTPRINT = 0.3
"""Standard deviation of what a pixel averages over, in pixels. A wave of three pixels keeps half its variance, one
of one pixel 5 %."""

GRAZING_COSINE = 1e-3
"""Least cosine of the angle of view: smooth shading bends normals of visible points beyond edge-on."""

HORIZONTAL_FLOOR = 1e-6
"""Keeps the horizontal direction of view finite straight above."""

CELLS_PER_TILE = 3
"""Cells of a grid along the side of the square of water that an image shows. Any two cells may see the same water,
and their common part is what an autocorrelation finds of it: with 2, a picture of one or two images has peaks of
0.05 to 0.13, with 3 those of chance. Smaller cells would cut waves short: the longest keep half their correlation
with themselves over one wavelength, which waves of many directions and lengths have not anyway."""

VISIBLE_SHARE = 0.98
"""A slope reaches at most this share of the slope at which it is seen edge-on."""

VARIANCE_FLOOR = 1e-12
"""Least variance of slopes along u: deviations and covariances are divided by it."""

_MILLS_0 = 0.7978845608028654  # sqrt(2 / pi)
_MILLS_1, _MILLS_2 = 0.77551088, 0.25209983


class Sight(NamedTuple):
    """The slope along u at which a facet is seen edge-on, and the variances of a pixel's footprint in m^2."""

    edge_on: Any
    footprint_u: Any
    footprint_v: Any


class TensorAxes(NamedTuple):
    """Vectors that turn tensors: (xx, yy, xy) . of_uu is the component uu, and so on; the tensor (xx, yy, xy) is
    uu times `uu`, plus vv times `vv`, plus uv times `uv`."""

    of_uu: Any
    of_vv: Any
    of_uv: Any
    uu: Any
    vv: Any
    uv: Any


class Shown(NamedTuple):
    """Slopes of the bump along u and v, and their variances and covariance: of all bands, or of the first few."""

    u: Any
    v: Any
    uu: Any
    vv: Any
    uv: Any


def view_axes(ops, to_viewer):
    """u as (c, s), so that v is (-s, c), for a unit vector to the viewer, (x, y, z)."""
    v_x, v_y, _ = to_viewer
    horizontal = _horizontal(ops, to_viewer)
    return ops.label((v_x + HORIZONTAL_FLOOR) / horizontal, "u, x"), ops.label(v_y / horizontal, "u, y")


def _horizontal(ops, to_viewer):
    """Length of the horizontal part of the vector to the viewer."""
    v_x, v_y, _ = to_viewer
    return ops.sqrt(v_x * v_x + v_y * v_y) + HORIZONTAL_FLOOR


def sight_of(ops, to_viewer, normal, pixel_width) -> Sight:
    """How a pixel `pixel_width` wide (m, across the view) covers water of the normal `normal`.

    `to_viewer` and `normal` (of the mesh) are unit vectors, (x, y, z).
    """
    v_x, v_y, v_z = to_viewer
    n_x, n_y, n_z = normal
    cosine = ops.maximum(v_x * n_x + v_y * n_y + v_z * n_z, GRAZING_COSINE)
    cosine = ops.label(cosine / ops.maximum(n_z, GRAZING_COSINE), "cosine of view over n_z")
    across = pixel_width * FOOTPRINT
    along = across / cosine
    return Sight(cosine / _horizontal(ops, to_viewer), along * along, across * across)


def tensor_axes(ops, c, s) -> TensorAxes:
    """For u = (c, s) and v = (-s, c)."""
    cc, ss, cs = c * c, s * s, c * s
    double = 2.0 * cs
    return TensorAxes(
        ops.vector(cc, ss, double),
        ops.vector(ss, cc, -1.0 * double),
        ops.vector(-1.0 * cs, cs, cc - ss),
        ops.vector(cc, ss, cs),
        ops.vector(ss, cc, -1.0 * cs),
        ops.vector(-1.0 * double, double, cc - ss),
    )


def blend_weight(t_x, t_y):
    """Weight of a grid's cell at the place (t_x, t_y), 0 to 1, in it, not normalised: 0 on its border."""
    return t_x * (1.0 - t_x) * (t_y * (1.0 - t_y))


def blend_normaliser(ops, weights):
    """1 / sqrt(sum w^2): the sum of w_i s_i then has the variance that each of the independent s_i has."""
    first, second, third = weights
    return 1.0 / ops.sqrt(ops.multiply_add(first, first, ops.multiply_add(second, second, third * third)))


def undisturbed_by(ops, place, x, y, amplitude, wavenumber):
    """Where the water at `place`, a vector, was before waves of slopes (x, y) displaced it.

    A trochoid A cos psi displaces water by -A k/|k| sin psi, which is its slope -A k sin psi over |k|.
    """
    factor = amplitude * (-1.0 / wavenumber)
    return place + ops.vector(x * factor, y * factor, 0.0)


def fade(ops, footprint, squared_wavenumber, amplitude):
    """What a pixel keeps of a band's slopes: amplitude / (1 + k^2 footprint); footprint in m^2, k in rad/m."""
    return amplitude / ops.multiply_add(footprint, squared_wavenumber, 1.0)


def add_band(ops, shown: Shown, c, s, axes: TensorAxes, fades, slopes, variance) -> Shown:
    """`shown` and one more band, of whose slopes the shares `fades`, (along u, along v), are shown.

    `slopes` (x, y) are numbers, `variance` (xx, yy, xy) is a vector, both of the whole band.
    """
    f_u, f_v = fades
    x, y = slopes
    along, across = ops.multiply_add(x, c, y * s), y * c - x * s
    return Shown(
        ops.multiply_add(along, f_u, shown.u),
        ops.multiply_add(across, f_v, shown.v),
        ops.multiply_add(ops.dot(variance, axes.of_uu), f_u * f_u, shown.uu),
        ops.multiply_add(ops.dot(variance, axes.of_vv), f_v * f_v, shown.vv),
        ops.multiply_add(ops.dot(variance, axes.of_uv), f_u * f_v, shown.uv),
    )


def left_to_brdf(axes: TensorAxes, unresolved, shown: Shown):
    """Slope variance (xx, yy, xy) of what neither mesh nor bump shows: `unresolved` is what the mesh does not."""
    for tensor, component in ((axes.uu, shown.uu), (axes.vv, shown.vv), (axes.uv, shown.uv)):
        unresolved = unresolved - tensor * component
    return unresolved


def mills_ratio_fit(ops, a):
    """phi(a) / Phi(a) of the normal distribution for a >= 0, so that 1 / (a + it) is right to 0.4 %."""
    return _MILLS_0 * ops.exp(a * ops.multiply_add(a, -_MILLS_2, -_MILLS_1))


def visible_slopes(ops, shown: Shown, edge_on, unresolved_uu):
    """The shown slopes (u, v) as a viewer meets them: facets that lean towards the viewer look larger.

    Of slopes along u of variance s^2, with BRDF facets of variance r^2 on them, the viewer sees the density
    p(s_u) C(e - s_u), with C the mean projected area of the facets and e the slope seen edge-on (THEORY section
    6: the (1 + Lambda) of a Gaussian). With t^2 = s^2 + r^2, a = e / t, lambda = phi/Phi and h = 1 / (a + lambda),
    its mean is -s^2 h / t and its variance s^2 [1 + s^2 / t^2 h (lambda - h)]. A bump map shows every facet the
    same size; mapping its slopes to this mean and variance makes up for it, and turns no facet away.

    `unresolved_uu` is the slope variance along u that the mesh does not show: t^2.
    """
    total = ops.maximum(ops.maximum(unresolved_uu, shown.uu), VARIANCE_FLOOR)
    deviation = ops.sqrt(total)
    a = edge_on / deviation
    mills = mills_ratio_fit(ops, a)
    h = 1.0 / (a + mills)
    share = shown.uu / total
    narrowing = ops.sqrt(ops.multiply_add(share * h, mills - h, 1.0))
    mean = -1.0 * (share * deviation * h)
    seen = ops.minimum(ops.multiply_add(shown.u, narrowing, mean), edge_on * VISIBLE_SHARE)
    seen = ops.label(seen, "visible slope along view")
    follows = shown.uv / ops.maximum(shown.uu, VARIANCE_FLOOR)
    return seen, ops.label(ops.multiply_add(follows, seen - shown.u, shown.v), "visible slope across view")


def bumped_normal(ops, c, s, normal, slope_u, slope_v):
    """The mesh's normal (x, y, z) with slopes added to its own, not normalised: N - N_z (s_x, s_y, 0)."""
    n_x, n_y, n_z = normal
    s_x, s_y = slope_u * c - slope_v * s, slope_u * s + slope_v * c
    return ops.vector(n_x - n_z * s_x, n_y - n_z * s_y, n_z)
