# SPDX-License-Identifier: GPL-3.0-or-later
"""The spreading laws a system can have: the one table behind the panel, presets, command line and docs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ..constants import GRAVITY
from ..dispersion import Water
from ..parameters import Option
from ..spectra.pierson_moskowitz import PIERSON_MOSKOWITZ_BETA
from ..spectra.table import Spectrum
from ..wind import (
    ELFOUHAILY_HEIGHT,
    PIERSON_MOSKOWITZ_HEIGHT,
    REFERENCE_HEIGHT,
    SWOP_HEIGHT,
    wind_ratio,
)
from .cos2 import cosine_squared
from .cos2s import constant_cos2s, mitsuyasu
from .elfouhaily import elfouhaily_spreading
from .swop import swop

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
class Conditions:
    """What a spreading law may depend on: U10 in m/s, the peak of the spectrum in rad/s, water, the exponent s."""

    wind_speed: float
    peak_frequency: float
    water: Water
    exponent: float


@dataclass(frozen=True)
class SpreadingKind:
    """A row of the table.

    option       what the artist chooses
    source       the publication
    build        the law under given conditions
    wind_height  m, of the wind that the law is written in; None for a law that does not depend on the wind
    settings     the settings of a wave system that the law alone depends on
    """

    option: Option
    source: str
    build: Callable[[Conditions], Spreading]
    wind_height: float | None
    settings: tuple[str, ...] = ()


def _swop(conditions):
    return swop(GRAVITY / (conditions.wind_speed * wind_ratio(SWOP_HEIGHT)))


def _mitsuyasu(conditions):
    return mitsuyasu(conditions.wind_speed, conditions.peak_frequency)


def _cos2s(conditions):
    return constant_cos2s(conditions.exponent)


def _cos2(conditions):
    return cosine_squared()


def _elfouhaily(conditions):
    return elfouhaily_spreading(conditions.wind_speed, conditions.peak_frequency, conditions.water)


_KINDS = (
    SpreadingKind(
        Option(
            "swop",
            "SWOP",
            "Measured in a wind sea from stereo photographs: long waves keep to the wind, short ones fan out",
        ),
        "Cote et al. 1960",
        _swop,
        SWOP_HEIGHT,
    ),
    SpreadingKind(
        Option(
            "mitsuyasu",
            "Mitsuyasu",
            "Measured from a buoy: the waves at the peak keep to the wind best, longer and shorter ones fan out",
        ),
        "Mitsuyasu et al. 1975",
        _mitsuyasu,
        REFERENCE_HEIGHT,
    ),
    SpreadingKind(
        Option(
            "cos2s", "Cos^2s", "The same fan for waves of all lengths, as wide as the exponent says; for swell"
        ),
        "Longuet-Higgins et al. 1963",
        _cos2s,
        None,
        ("spreading_exponent",),
    ),
    SpreadingKind(
        Option("cos2", "Cos^2", "The same wide fan for waves of all lengths, none against the mean direction"),
        "Pierson et al. 1955",
        _cos2,
        None,
    ),
    SpreadingKind(
        Option("elfouhaily", "Elfouhaily", "The fan that goes with the Elfouhaily spectrum, down to ripples"),
        "Elfouhaily et al. 1997",
        _elfouhaily,
        ELFOUHAILY_HEIGHT,
    ),
)

SPREADINGS: dict[str, SpreadingKind] = {kind.option.key: kind for kind in _KINDS}


def spreading_of(system: WaveSystem, spectrum: Spectrum, water: Water) -> Spreading:
    """The spreading law of a wave system with this spectrum.

    A system sized by its height has the wind that would raise a fully developed sea of its peak frequency: U5 of
    SWOP and the wave age of the other laws follow from it.
    """
    by_wind = system.sized_by == "wind"
    wind_speed = system.wind_speed if by_wind else fully_developed_wind(spectrum.peak_frequency)
    conditions = Conditions(wind_speed, spectrum.peak_frequency, water, system.spreading_exponent)
    return SPREADINGS[system.spreading].build(conditions)


def fully_developed_wind(peak_frequency: float) -> float:
    """U10 in m/s of the Pierson-Moskowitz sea of this peak: omega_p = (4 beta / 5)^(1/4) g / U19.5."""
    wind_19_5 = (0.8 * PIERSON_MOSKOWITZ_BETA) ** 0.25 * GRAVITY / peak_frequency
    return wind_19_5 / wind_ratio(PIERSON_MOSKOWITZ_HEIGHT)
