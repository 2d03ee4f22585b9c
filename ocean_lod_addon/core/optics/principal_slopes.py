# SPDX-License-Identifier: GPL-3.0-or-later
"""The principal axes of a slope variance tensor, for the shading point that only has the tensor.

Unresolved waves of several systems add their slope variances as tensors (sigma_xx, sigma_yy, sigma_xy). A
microfacet closure wants two variances and the direction of one of them: the eigenvalues and the major
eigenvector of the symmetric 2 x 2 matrix. Written over `ops`, without angles.
"""

from .cox_munk import SLOPE_VARIANCE_FLOOR

AXIS_FLOOR = 1.0e-12
"""Least length of the major axis before it is normalised: where the tensor is isotropic every direction is
an axis, the formula gives the vector 0, and 0 / 0 is kept away by choosing x."""


def eigenvalue_parts(ops, variance_xx, variance_yy, covariance_xy):
    """(mean, half difference, radius): the eigenvalues are mean + radius and mean - radius."""
    mean = 0.5 * (variance_xx + variance_yy)
    half_difference = 0.5 * (variance_xx - variance_yy)
    radius = ops.sqrt(half_difference * half_difference + covariance_xy * covariance_xy)
    return mean, half_difference, radius


def major_axis(ops, half_difference, radius, covariance_xy):
    """Unit vector (x, y) along the major axis of the tensor; its sign has no meaning.

    Of the two equivalent forms (d + r, xy) and (xy, r - d) of the eigenvector the one without cancellation
    is taken, d being the half difference and r the radius.
    """
    long_side = ops.maximum(ops.absolute(half_difference) + radius, AXIS_FLOOR)
    length = ops.sqrt(long_side * long_side + covariance_xy * covariance_xy)
    along_y = ops.less_than(half_difference, 0.0)
    x = ops.where(along_y, covariance_xy, long_side) / length
    y = ops.where(along_y, long_side, covariance_xy) / length
    return ops.label(x, "major axis x"), ops.label(y, "major axis y")


def principal_slopes(ops, variance_xx, variance_yy, covariance_xy):
    """(major variance, minor variance, axis x, axis y) of the tensor, variances at least the floor.

    Inputs are dimensionless slope variances in the object's axes; the axis is a unit vector in them. Rounding
    may make the smaller eigenvalue slightly negative: the floor covers that as well.
    """
    mean, half_difference, radius = eigenvalue_parts(ops, variance_xx, variance_yy, covariance_xy)
    major = ops.maximum(mean + radius, SLOPE_VARIANCE_FLOOR)
    minor = ops.maximum(mean - radius, SLOPE_VARIANCE_FLOOR)
    axis_x, axis_y = major_axis(ops, half_difference, radius, covariance_xy)
    return ops.label(major, "major variance"), ops.label(minor, "minor variance"), axis_x, axis_y


def variance_along(ops, variance_xx, variance_yy, covariance_xy, axis_x, axis_y):
    """Slope variance along the unit vector (axis_x, axis_y): the tensor between the vector twice, floored."""
    by_x = ops.multiply_add(variance_xx, axis_x, covariance_xy * axis_y)
    by_y = ops.multiply_add(covariance_xy, axis_x, variance_yy * axis_y)
    return ops.maximum(ops.multiply_add(by_x, axis_x, by_y * axis_y), SLOPE_VARIANCE_FLOOR)
