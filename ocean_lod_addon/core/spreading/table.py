# SPDX-License-Identifier: GPL-3.0-or-later
"""The spreading laws a system can have: the one table behind the panel, presets, command line and docs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ..constants import GRAVITY
from ..parameters import Option
from ..spectra.pierson_moskowitz import PIERSON_MOSKOWITZ_BETA
from ..spectra.table import Spectrum
from ..wind import PIERSON_MOSKOWITZ_HEIGHT, SWOP_HEIGHT, wind_ratio
from . import swop

if TYPE_CHECKING:
    from ..sea import WaveSystem


class Spreading(Protocol):
    """A spreading law with all its numbers filled in, symmetric about theta = 0; its integral is 1."""

    def density(self, omega: np.ndarray, theta: np.ndarray) -> np.ndarray:
        """D in 1/rad at omega in rad/s and |theta| <= pi from the mean direction."""

    def cumulative(self, omega: np.ndarray, theta: np.ndarray) -> np.ndarray:
        """int D from -pi to theta."""

    def cos2_integral(self, omega: np.ndarray, half_width: float) -> np.ndarray:
        """int cos^2 theta D over |theta| <= half_width."""


@dataclass(frozen=True)
class SpreadingKind:
    """A row of the table; `build` takes the system, the wind U10 that fits it and its peak frequency."""

    option: Option
    build: Callable[[WaveSystem, float, float], Spreading]


def _swop(system, wind_speed, peak_frequency):
    return swop.swop(GRAVITY / (wind_speed * wind_ratio(SWOP_HEIGHT)))


_KINDS = (
    SpreadingKind(
        Option(
            "swop",
            "SWOP",
            "Measured in a wind sea from stereo photographs: long waves keep to the wind, short ones fan out",
        ),
        _swop,
    ),
)

SPREADINGS: dict[str, SpreadingKind] = {kind.option.key: kind for kind in _KINDS}


def spreading_of(system: WaveSystem, spectrum: Spectrum) -> Spreading:
    """The spreading law of a wave system with this spectrum.

    A system sized by its height has the wind that would raise a fully developed sea of its peak frequency: U5 of
    SWOP and the wave age of the other laws follow from it.
    """
    by_wind = system.sized_by == "wind"
    wind_speed = system.wind_speed if by_wind else fully_developed_wind(spectrum.peak_frequency)
    return SPREADINGS[system.spreading].build(system, wind_speed, spectrum.peak_frequency)


def fully_developed_wind(peak_frequency: float) -> float:
    """U10 in m/s of the Pierson-Moskowitz sea of this peak: omega_p = (4 beta / 5)^(1/4) g / U19.5."""
    wind_19_5 = (0.8 * PIERSON_MOSKOWITZ_BETA) ** 0.25 * GRAVITY / peak_frequency
    return wind_19_5 / wind_ratio(PIERSON_MOSKOWITZ_HEIGHT)
