# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectra a wave system can have: the one table behind the panel, presets, command line and docs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ..dispersion import Water
from ..parameters import Option
from ..wind import PIERSON_MOSKOWITZ_HEIGHT, wind_at_height
from . import pierson_moskowitz

if TYPE_CHECKING:
    from ..sea import WaveSystem


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

    wind_height   m, of the wind that the formula is written in
    from_wind     the spectrum of a system sized by its wind (U10 > 0)
    from_height   the spectrum of a system sized by its significant wave height (> 0) and period
    """

    option: Option
    wind_height: float
    from_wind: Callable[[WaveSystem, Water], Spectrum]
    from_height: Callable[[WaveSystem, Water], Spectrum]


def _pierson_moskowitz_from_wind(system, water):
    wind = wind_at_height(system.wind_speed, PIERSON_MOSKOWITZ_HEIGHT)
    return pierson_moskowitz.pierson_moskowitz_from_wind(wind)


def _pierson_moskowitz_from_height(system, water):
    return pierson_moskowitz.pierson_moskowitz_from_height(system.significant_wave_height)


_KINDS = (
    SpectrumKind(
        Option(
            "pierson_moskowitz",
            "Pierson-Moskowitz",
            "A wind sea that has blown long enough over open water to grow no further. The wind alone, or the"
            " wave height alone, decides everything",
        ),
        PIERSON_MOSKOWITZ_HEIGHT,
        _pierson_moskowitz_from_wind,
        _pierson_moskowitz_from_height,
    ),
)

SPECTRA: dict[str, SpectrumKind] = {kind.option.key: kind for kind in _KINDS}


def spectrum_of(system: WaveSystem, water: Water) -> Spectrum | None:
    """The spectrum of a wave system, or None if it has no waves: switched off, no wind, or no height."""
    kind = SPECTRA[system.spectrum]
    size = system.wind_speed if system.sized_by == "wind" else system.significant_wave_height
    if not system.enabled or size <= 0.0:
        return None
    return (kind.from_wind if system.sized_by == "wind" else kind.from_height)(system, water)
