# SPDX-License-Identifier: GPL-3.0-or-later
"""Which settings of a wave system have an effect: the panel shows these, the command line takes these."""

from .sea import WaveSystem
from .spectra.table import SPECTRA
from .spreading.table import SPREADINGS


def size_settings(system: WaveSystem) -> tuple[str, ...]:
    """The settings that make the waves of a system large or small."""
    kind = SPECTRA[system.spectrum]
    return kind.wind_settings if system.sized_by == "wind" else kind.height_settings


def direction_settings(system: WaveSystem) -> tuple[str, ...]:
    """The settings that say where the waves of a system go."""
    return ("direction", "spreading", *SPREADINGS[system.spreading].settings, "directional_cutoff")


def relevant_settings(system: WaveSystem) -> tuple[str, ...]:
    """All settings that change the waves of a system."""
    return (
        "enabled",
        "spectrum",
        "sized_by",
        *size_settings(system),
        *direction_settings(system),
        "wave_share",
        "seed",
    )
