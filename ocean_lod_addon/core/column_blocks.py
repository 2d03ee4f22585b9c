# SPDX-License-Identifier: GPL-3.0-or-later
"""What the frame kernel can give for each vertex: blocks of columns of its right factor, over one left factor.

With P_ai = A_i exp(i (kx_i x_a + phi_i(t))) w_i(x_a) and Q_ib = exp(i ky_i y_b) w_i(y_b), any sum over the waves
that is linear in them is Re sum_i P_ai weight_ci Q_ib. Its weights, one for each wave and column, make the block,
together with its base: what it is on still water.

A derivative along x or y takes the windows w_i as locally constant. A window falls from 1 to 0 over half its
reach, wavelength cells / (8 samples_per_wavelength), with a slope of at most 15/8 over that; its derivative, left
out, is thus at most 15 samples_per_wavelength / (2 pi cells), 3.7 % by default, of the slope of the waves that
fade at a place, and a quarter of a wave out of step with it: it changes their slope variance by 0.14 % at most.
Along x it would take a left factor of its own, for which the frame would pay twice.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .constants import EARTH_RADIUS
from .waves import WaveSet


@dataclass(frozen=True)
class Still:
    """Where a level's lines are, for the base of a block.

    lines    (lines,) m, relative to the level's anchor, in x and in y
    anchor   (2,) m
    centre   (2,) m, of the finest level: from where a curved Earth sinks
    curved   whether it does
    """

    lines: np.ndarray
    anchor: np.ndarray
    centre: np.ndarray
    curved: bool


@dataclass(frozen=True)
class ColumnBlock:
    """`columns` values of a vertex.

    weights   of a set of waves, (waves, columns) complex
    base      of a level, (3, lines, columns): what multiplies 1, x_a and x_a'^2, for each line y_b. x_a is counted
              from the level's anchor, x_a' from the finest level's
    """

    columns: int
    weights: Callable[[WaveSet], np.ndarray]
    base: Callable[[Still], np.ndarray]


def _orbit(waves):
    """Weights of the displacement (x, y, z): i C cos(theta), i C sin(theta), 1 (corrected Eq. 2)."""
    C, theta = waves.orbit_ratio, waves.direction
    return np.stack([1j * C * np.cos(theta), 1j * C * np.sin(theta), np.ones(len(waves))], axis=-1)


def _position_base(still):
    base = np.zeros((3, len(still.lines), 3))
    one, x, x_squared = base
    one[:, 0], x[:, 0] = still.anchor[0], 1.0
    one[:, 1] = still.lines + still.anchor[1]
    if still.curved:
        drop = -0.5 / EARTH_RADIUS
        x_squared[:, 2] = drop
        one[:, 2] = drop * (still.lines + (still.anchor[1] - still.centre[1])) ** 2
    return base


def _velocity_weights(waves):
    """The displacement's times -i omega, since its phase falls by omega t."""
    return -1j * waves.angular_frequency[:, None] * _orbit(waves)


def _still_water(still):
    return np.zeros((3, len(still.lines), 3))


def _tangent_weights(waves):
    """Derivatives by x, i k cos(theta), and by y of the displacement's: Jxx, Jxy = Jyx, Jyy, Zx, Zy."""
    C, k, theta = waves.orbit_ratio, waves.wavenumber, waves.direction
    cos, sin = np.cos(theta), np.sin(theta)
    return np.stack(
        [-C * k * cos * cos, -C * k * cos * sin, -C * k * sin * sin, 1j * k * cos, 1j * k * sin], axis=-1
    )


def _tangent_base(still):
    base = np.zeros((3, len(still.lines), 5))
    one, x, _ = base
    one[:, 0] = one[:, 2] = 1.0
    if still.curved:
        x[:, 3] = -1.0 / EARTH_RADIUS
        one[:, 3] = -(still.anchor[0] - still.centre[0]) / EARTH_RADIUS
        one[:, 4] = -(still.lines + (still.anchor[1] - still.centre[1])) / EARTH_RADIUS
    return base


POSITION = ColumnBlock(3, _orbit, _position_base)
"""Where the vertex is, m."""

VELOCITY = ColumnBlock(3, _velocity_weights, _still_water)
"""The velocity of the water there, m/s."""

TANGENTS = ColumnBlock(5, _tangent_weights, _tangent_base)
"""Derivatives of the position by the undisturbed one: dX/dx, dX/dy = dY/dx, dY/dy, dZ/dx, dZ/dy."""
