# SPDX-License-Identifier: GPL-3.0-or-later
"""The finite set of waves that stands for a sea, and its phases at a time."""

from dataclasses import dataclass

import numpy as np

TWO_PI = 2.0 * np.pi

LOOP_STEPS = 2.0**36
"""Moments that a loop tells apart: far fewer than float64 does, so that rounded times fall on the same moment."""


@dataclass(frozen=True, eq=False)
class WaveSet:
    """Directional wave components in SI units, one entry per wave; every array is float64 and read-only.

    amplitude           m, vertical
    wavenumber          rad/m, > 0
    angular_frequency   rad/s, > 0
    direction           rad, where the wave travels to, counter-clockwise from +x
    phase               rad, at the world's origin and time 0
    orbit_ratio         horizontal over vertical orbit radius, Q coth(k h) (1 for a deep Gerstner wave)
    system              index of the wave system that a wave belongs to
    loop_period         s, or 0: with a loop, angular_frequency is a whole multiple of 2 pi / loop_period
    """

    amplitude: np.ndarray
    wavenumber: np.ndarray
    angular_frequency: np.ndarray
    direction: np.ndarray
    phase: np.ndarray
    orbit_ratio: np.ndarray
    system: np.ndarray
    loop_period: float = 0.0

    def __post_init__(self):
        for name in ("amplitude", "wavenumber", "angular_frequency", "direction", "phase", "orbit_ratio"):
            values = np.array(getattr(self, name), dtype=np.float64, ndmin=1)
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        system = np.array(self.system, dtype=np.int64, ndmin=1)
        system.setflags(write=False)
        object.__setattr__(self, "system", system)

    def __len__(self):
        return len(self.amplitude)

    @property
    def wavelength(self) -> np.ndarray:
        """Wavelengths 2 pi / k, m."""
        return TWO_PI / self.wavenumber

    def phase_at(self, time: float) -> np.ndarray:
        """Phases eps_i - omega_i t at the world's origin, rad, in [0, 2 pi), for `time` in s.

        With a loop the whole number of cycles n_i = omega_i T / 2 pi is taken exactly and only the fraction
        of n_i t / T is kept, with t / T rounded to LOOP_STEPS steps, so that t and t + T give the same bits
        although both are rounded when a frame is divided by the frame rate (THEORY section 3, perfect loop).
        """
        if self.loop_period > 0.0:
            cycles = np.rint(self.angular_frequency * self.loop_period / TWO_PI)
            step = np.rint(np.mod(time / self.loop_period, 1.0) * LOOP_STEPS)
            turns = np.mod(cycles * step, LOOP_STEPS) / LOOP_STEPS
        else:
            turns = np.mod(self.angular_frequency * time / TWO_PI, 1.0)
        return np.mod(self.phase - TWO_PI * turns, TWO_PI)
