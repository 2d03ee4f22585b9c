# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectra a wave system can have: the one table behind the panel, presets, command line and docs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ..dispersion import Water
from ..parameters import Option
from ..wind import (
    ELFOUHAILY_HEIGHT,
    JONSWAP_HEIGHT,
    NEUMANN_HEIGHT,
    PIERSON_MOSKOWITZ_HEIGHT,
    wind_at_height,
)
from .elfouhaily import elfouhaily_from_height, elfouhaily_from_wind
from .jonswap import (
    fully_developed_fetch,
    jonswap_from_height,
    jonswap_from_wind,
    peak_frequency_of_period,
)
from .neumann import Neumann, neumann_from_height
from .pierson_moskowitz import pierson_moskowitz_from_height, pierson_moskowitz_from_wind
from .tma import Tma, tma_from_height
from .two_parameter import DECAY_FROM_PERIOD, two_parameter

if TYPE_CHECKING:
    from ..sea import WaveSystem

SHORTEST_GRAVITY_WAVE = 0.017
"""m; shorter waves are capillary ripples, which no spectrum here but Elfouhaily's describes."""

SHORTEST_RIPPLE = 0.001
"""m; the wind raises nothing shorter."""


class Spectrum(Protocol):
    """A spectrum with all its numbers filled in."""

    @property
    def peak_frequency(self) -> float:
        """Where its energy gathers, rad/s; it may have a kink there and nowhere else."""

    def density(self, omega: np.ndarray) -> np.ndarray:
        """Variance density S in m^2 s/rad for omega > 0 in rad/s; 0 where it underflows."""


@dataclass(frozen=True)
class SpectrumKind:
    """A row of the table.

    option               what the artist chooses
    source               the publication
    wind_height          m, of the wind that the formula is written in
    shortest_wavelength  m, down to which the spectrum means something
    from_wind            the spectrum of a system sized by its wind (U10 > 0)
    wind_settings        the settings of a wave system that this one depends on
    from_height          the spectrum of a system sized by its significant wave height (> 0)
    height_settings      the settings of a wave system that this one depends on
    """

    option: Option
    source: str
    wind_height: float
    shortest_wavelength: float
    from_wind: Callable[[WaveSystem, Water], Spectrum]
    wind_settings: tuple[str, ...]
    from_height: Callable[[WaveSystem, Water], Spectrum]
    height_settings: tuple[str, ...]


def _pierson_moskowitz_by_wind(system, water):
    return pierson_moskowitz_from_wind(wind_at_height(system.wind_speed, PIERSON_MOSKOWITZ_HEIGHT))


def _pierson_moskowitz_by_height(system, water):
    return pierson_moskowitz_from_height(system.significant_wave_height)


def _jonswap_by_wind(system, water):
    """Past the fetch of a fully developed sea the waves outrun the wind: more fetch then changes nothing."""
    fully_developed = _pierson_moskowitz_by_wind(system, water)
    fetch = min(system.fetch, fully_developed_fetch(system.wind_speed, fully_developed.peak_frequency))
    return jonswap_from_wind(system.wind_speed, fetch, system.peak_enhancement)


def _jonswap_by_height(system, water):
    peak = peak_frequency_of_period(system.period, system.period_kind, system.peak_enhancement)
    return jonswap_from_height(system.significant_wave_height, peak, system.peak_enhancement)


def _neumann_by_wind(system, water):
    return Neumann(wind_at_height(system.wind_speed, NEUMANN_HEIGHT))


def _neumann_by_height(system, water):
    return neumann_from_height(system.significant_wave_height)


def _two_parameter_by_wind(system, water):
    """Height and peak of the fully developed sea: the same curve as Pierson and Moskowitz's."""
    return _pierson_moskowitz_by_wind(system, water)


def _two_parameter_by_height(system, water):
    return two_parameter(system.significant_wave_height, DECAY_FROM_PERIOD[system.period_kind](system.period))


def _tma_by_wind(system, water):
    return Tma(_jonswap_by_wind(system, water), water)


def _tma_by_height(system, water):
    return tma_from_height(system.significant_wave_height, _jonswap_by_height(system, water), water)


def _elfouhaily_by_wind(system, water):
    return elfouhaily_from_wind(system.wind_speed, system.fetch, water)


def _elfouhaily_by_height(system, water):
    return elfouhaily_from_height(system.significant_wave_height, system.fetch, water)


_JONSWAP_BY_WIND = ("wind_speed", "fetch", "peak_enhancement")
_JONSWAP_BY_HEIGHT = ("significant_wave_height", "period", "period_kind", "peak_enhancement")

_KINDS = (
    SpectrumKind(
        Option(
            "pierson_moskowitz",
            "Pierson-Moskowitz",
            "A wind sea that has blown long enough over open water to grow no further. The wind alone, or the"
            " wave height alone, decides everything",
        ),
        "Pierson and Moskowitz 1964",
        PIERSON_MOSKOWITZ_HEIGHT,
        SHORTEST_GRAVITY_WAVE,
        _pierson_moskowitz_by_wind,
        ("wind_speed",),
        _pierson_moskowitz_by_height,
        ("significant_wave_height",),
    ),
    SpectrumKind(
        Option(
            "jonswap",
            "JONSWAP",
            "A wind sea that is still growing, measured in the North Sea: its waves are more alike in length, the"
            " more so the higher the peak enhancement. Also the usual choice for swell",
        ),
        "Hasselmann et al. 1973",
        JONSWAP_HEIGHT,
        SHORTEST_GRAVITY_WAVE,
        _jonswap_by_wind,
        _JONSWAP_BY_WIND,
        _jonswap_by_height,
        _JONSWAP_BY_HEIGHT,
    ),
    SpectrumKind(
        Option(
            "neumann",
            "Neumann",
            "A fully grown wind sea from visual records, the oldest of these; long waves are more prominent",
        ),
        "Neumann 1953",
        NEUMANN_HEIGHT,
        SHORTEST_GRAVITY_WAVE,
        _neumann_by_wind,
        ("wind_speed",),
        _neumann_by_height,
        ("significant_wave_height",),
    ),
    SpectrumKind(
        Option(
            "two_parameter",
            "Bretschneider/ISSC",
            "The standard of ship design, by ISSC and ITTC: any wave height with any period",
        ),
        "Bretschneider 1959; ISSC 1964; ITTC 1978",
        PIERSON_MOSKOWITZ_HEIGHT,
        SHORTEST_GRAVITY_WAVE,
        _two_parameter_by_wind,
        ("wind_speed",),
        _two_parameter_by_height,
        ("significant_wave_height", "period", "period_kind"),
    ),
    SpectrumKind(
        Option(
            "tma",
            "TMA",
            "JONSWAP in shallow water: the bottom takes the energy of waves that are long against the depth."
            " Needs Finite Depth",
        ),
        "Bouws et al. 1985",
        JONSWAP_HEIGHT,
        SHORTEST_GRAVITY_WAVE,
        _tma_by_wind,
        _JONSWAP_BY_WIND,
        _tma_by_height,
        _JONSWAP_BY_HEIGHT,
    ),
    SpectrumKind(
        Option(
            "elfouhaily",
            "Elfouhaily",
            "Wind waves of all lengths down to ripples, with the roughness that satellites and sun glitter show",
        ),
        "Elfouhaily et al. 1997",
        ELFOUHAILY_HEIGHT,
        SHORTEST_RIPPLE,
        _elfouhaily_by_wind,
        ("wind_speed", "fetch"),
        _elfouhaily_by_height,
        ("significant_wave_height", "fetch"),
    ),
)

SPECTRA: dict[str, SpectrumKind] = {kind.option.key: kind for kind in _KINDS}


CALM = 1e-6
"""m/s of wind, or m of wave height, up to which a system has no waves: powers of smaller sizes underflow to 0 and
would be divided by."""


def spectrum_of(system: WaveSystem, water: Water) -> Spectrum | None:
    """The spectrum of a wave system, or None if it has no waves: switched off, no wind, or no height."""
    kind = SPECTRA[system.spectrum]
    size = system.wind_speed if system.sized_by == "wind" else system.significant_wave_height
    if not system.enabled or size <= CALM:
        return None
    return (kind.from_wind if system.sized_by == "wind" else kind.from_height)(system, water)
