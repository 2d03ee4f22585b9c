# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface as a direct sum over waves in float64: the reference that the frame kernel is checked against.

The paper's Eqs. 1 to 5 in their corrected form, THEORY section 2.
"""

from dataclasses import dataclass

import numpy as np

from .waves import WaveSet

SMALLEST_JACOBIAN = 1e-3
"""Slopes divide by the Jacobian, which is 0 where a crest folds over; below this it is held."""

UPWARD = np.array([0.0, 0.0, 1.0])
"""The normal where there is none, at the cusp of a wave with C k A = 1: the mean of those on its two sides."""


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """The displaced points and what follows from them; vectors have a last axis of 3 (slope: 2).

    position      m
    tangent_x     derivative of the position by the undisturbed x
    tangent_y     derivative of the position by the undisturbed y
    jacobian      horizontal area over undisturbed area; 0 or less where the surface folds
    normal        unit, upward on unfolded water
    slope         (dz/dx, dz/dy) of the displaced surface
    velocity      m/s, of the water
    """

    position: np.ndarray
    tangent_x: np.ndarray
    tangent_y: np.ndarray
    jacobian: np.ndarray
    normal: np.ndarray
    slope: np.ndarray
    velocity: np.ndarray


def surface_points(waves: WaveSet, x0, y0, time: float) -> SurfacePoints:
    """Eq. 2 and its derivatives at undisturbed points x0, y0 (m, any equal shape) and `time` in s.

    With psi = k k^ . x0 - omega t + eps and C = orbit ratio:
    X = x0 - sum C A cos(th) sin psi,  Y = y0 - sum C A sin(th) sin psi,  Z = sum A cos psi.
    """
    x0, y0 = np.broadcast_arrays(np.asarray(x0, dtype=np.float64), np.asarray(y0, dtype=np.float64))
    X, Y, Z = x0.copy(), y0.copy(), np.zeros_like(x0)
    Jxx, Jxy, Jyy = np.ones_like(x0), np.zeros_like(x0), np.ones_like(x0)
    Zx, Zy = np.zeros_like(x0), np.zeros_like(x0)
    velocity_x, velocity_y, velocity_z = np.zeros_like(x0), np.zeros_like(x0), np.zeros_like(x0)
    columns = (waves.amplitude, waves.wavenumber, waves.angular_frequency, waves.direction, waves.orbit_ratio)
    for A, k, omega, theta, C, phase in zip(*columns, waves.phase_at(time), strict=True):
        kx, ky = np.cos(theta), np.sin(theta)
        psi = k * (kx * x0 + ky * y0) + phase
        c, s = np.cos(psi), np.sin(psi)
        X -= C * A * kx * s
        Y -= C * A * ky * s
        Z += A * c
        Jxx -= C * k * A * kx * kx * c
        Jxy -= C * k * A * kx * ky * c
        Jyy -= C * k * A * ky * ky * c
        Zx -= k * A * kx * s
        Zy -= k * A * ky * s
        velocity_x += C * A * omega * kx * c
        velocity_y += C * A * omega * ky * c
        velocity_z += A * omega * s
    tangent_x, tangent_y = np.stack([Jxx, Jxy, Zx], -1), np.stack([Jxy, Jyy, Zy], -1)
    normal = np.cross(tangent_x, tangent_y)
    jacobian = normal[..., 2].copy()
    slope = -normal[..., :2] / np.maximum(jacobian, SMALLEST_JACOBIAN)[..., None]
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    cusp = length == 0.0
    normal = np.where(cusp, UPWARD, normal / np.where(cusp, 1.0, length))
    return SurfacePoints(
        np.stack([X, Y, Z], -1),
        tangent_x,
        tangent_y,
        jacobian,
        normal,
        slope,
        np.stack([velocity_x, velocity_y, velocity_z], -1),
    )


def sum_steepness(waves: WaveSet) -> float:
    """sum C k A: below 1 the surface cannot fold."""
    return float(np.sum(waves.orbit_ratio * waves.wavenumber * waves.amplitude))


def mean_level(waves: WaveSet) -> float:
    """Mean of Z over horizontal area, m: -sum C k A^2 / 2, exact for one wave."""
    return float(-0.5 * np.sum(waves.orbit_ratio * waves.wavenumber * waves.amplitude**2))


def gerstner_particle(a: float, k: float, z0, psi) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eq. 1: displacement (x, z) in m and area Jacobian of the water at depth z0 <= 0 in one deep Gerstner wave.

    x - x0 = -E sin psi, z - z0 = E cos psi, E = a exp(k z0); the Jacobian 1 - k^2 E^2 is constant in time.
    """
    E = a * np.exp(k * z0)
    return -E * np.sin(psi), E * np.cos(psi), 1.0 - k**2 * E**2
