# SPDX-License-Identifier: GPL-3.0-or-later
"""Gusts: patches in which the wind raises stronger ripples, and between them weaker ones (cat's paws).

The slope variance of the waves that are too short for the mesh is multiplied by

    m(x, t) = exp(a n) / Z,    n = sum_i A_i cos(k_i . x - omega_i t + eps_i),    Z = prod_i I_0(a A_i),

with N waves of A_i = sqrt(2 / N), so that n has variance 1. Over all phases the mean of exp(a A cos) is I_0(a A):
the mean of m is 1, and gusts leave the slope variance of the whole sea as it is. The pattern drifts with the wind
as frozen turbulence does (Taylor 1938), omega = k . drift, and loops when the sea does.
"""

from dataclasses import dataclass

import numpy as np

from .lod import Grid, parts
from .ripple_settings import Ripples
from .rng import stream_seed, uniform
from .roughness import roughening_system
from .sea import Sea
from .waves import TWO_PI

GUST_STREAM = 0x47555354
"""The sub-stream of the sea's seed that gusts are drawn from."""

WAVES = 32

STRETCH = 2.0
"""Patches are this many times longer along the wind than across it."""

DRIFT = 0.8
"""Speed of the patches over the wind's at 10 m: the wind near the water, which carries them, is slower."""


@dataclass(frozen=True, eq=False)
class GustWaves:
    """The waves of n, all of the same amplitude: wavenumbers in rad/m, frequencies in rad/s, phases; (n,) each."""

    kx: np.ndarray
    ky: np.ndarray
    omega: np.ndarray
    phase: np.ndarray


def gust_waves(sea: Sea, size: float) -> GustWaves | None:
    """The gusts of a sea, with patches about `size` m long; None where there is no wind.

    Wavelengths across the wind are spread evenly, on a logarithmic scale, from half the size to twice the size.
    """
    rough = roughening_system(sea)
    if rough is None or sea.systems[rough].wind_speed == 0.0:
        return None
    system, seed = sea.systems[rough], stream_seed(sea.seed, GUST_STREAM)
    number = np.arange(WAVES)
    draws = [uniform(seed, number + WAVES * use) for use in range(3)]
    k = TWO_PI / (size / STRETCH * 2.0 ** (2.0 * (number + draws[0]) / WAVES - 1.0))
    angle = TWO_PI * draws[1]
    along, across = k * np.cos(angle) / STRETCH, k * np.sin(angle)
    c, s = np.cos(system.direction), np.sin(system.direction)
    omega = along * (DRIFT * system.wind_speed)
    if sea.loop_period > 0.0:
        omega = np.rint(omega * sea.loop_period / TWO_PI) * (TWO_PI / sea.loop_period)
    return GustWaves(along * c - across * s, along * s + across * c, omega, TWO_PI * draws[2])


def gust_factor(
    grid: Grid, waves: GustWaves, ripples: Ripples, anchors: np.ndarray, time: float
) -> np.ndarray:
    """m at each vertex of a plane with these level anchors (levels, 2) at `time` in s, (vertices,) float32.

    n separates as the sea's waves do: a small matrix product for each part of a level.
    """
    amplitude = np.sqrt(2.0 / WAVES)
    offset = waves.phase - np.mod(waves.omega * time, TWO_PI)
    n = np.empty(grid.vertex_count, np.float32)
    for level in range(grid.levels):
        x, y = (grid.lines(level) + anchor for anchor in anchors[level])
        px, py = np.multiply.outer(x, waves.kx), np.multiply.outer(waves.ky, y) + offset[:, None]
        left = np.hstack([np.cos(px), -np.sin(px)]).astype(np.float32)
        right = (amplitude * np.vstack([np.cos(py), np.sin(py)])).astype(np.float32)
        for part in parts(grid.cells, level):
            np.matmul(left[part.rows], right[:, part.columns], out=part.of(n))
    a = ripples.gust_strength
    return np.exp(np.float32(a) * n) / np.float32(np.prod(np.i0(a * np.full(WAVES, amplitude))))
