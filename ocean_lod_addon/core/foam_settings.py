# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of the foam that breaking waves leave."""

from dataclasses import dataclass

from .parameters import integer, number, validate

FRESH_REFLECTANCE = 0.55
"""Reflectance of dense fresh foam in visible light: Whitlock, Bartlett and Gurganus 1982."""

DECAY_TIME = 3.5
"""e-folding time in s of the area of a whitecap in salt water: Monahan, Davidson and Spiel 1982, 3.53 s."""


@dataclass(frozen=True)
class Foam:
    """Whitecaps; every default is physical."""

    coverage: float = number(
        "Coverage",
        "Factor on the area of the sea that is white. 1 is what was measured at this wind",
        1.0, 0.0, 10.0, soft_maximum=4.0,
    )  # fmt: skip
    decay_time: float = number(
        "Decay", "Time in which the foam that a crest leaves thins out to a third (1/e)",
        DECAY_TIME, 0.1, 60.0, "s", soft_maximum=15.0,
    )  # fmt: skip
    memory_steps: int = integer(
        "Memory",
        "Number of past instants at which each place is asked whether a crest broke there. More make the trail of"
        " a crest smoother, each at a third of the cost of moving the surface",
        16, 1, 64,
    )  # fmt: skip
    grain: float = number(
        "Grain", "Size of the largest patches and holes of the foam's texture",
        3.0, 0.01, 100.0, "m", soft_maximum=10.0,
    )  # fmt: skip
    reflectance: float = number(
        "Reflectance", "Share of the light that dense fresh foam throws back. 0.55 was measured",
        FRESH_REFLECTANCE, 0.0, 1.0,
    )  # fmt: skip

    def __post_init__(self):
        validate(self)
