# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that tie the plane to the camera."""

import math
from dataclasses import dataclass

from .parameters import Option, choice, number, switch, validate


@dataclass(frozen=True)
class Framing:
    """Where the plane stands and which part of it is worth moving."""

    centre: str = choice(
        "Centre",
        "Where the finest level of the plane is",
        "CAMERA",
        (
            Option("CAMERA", "Camera", "The plane travels with the scene's camera over a sea that stays put"),
            Option("PINNED", "Pinned", "The plane stays centred on the object's origin"),
        ),
    )
    only_in_view: bool = switch(
        "Only in View",
        "In renders, leave parts of the plane flat that the camera does not see. The viewport always moves all",
        True,
    )
    view_margin: float = number(
        "View Margin",
        "How far around the camera's frame, in degrees, water still moves: for what reflections and shadows show",
        math.radians(5.0),
        0.0,
        math.pi / 2,
        "rad",
    )
    viewport_share: float = number(
        "Waves Shown",
        "Share of the waves, the longest first, that move in the viewport. Renders always show all of them",
        1.0,
        0.05,
        1.0,
    )
    curved_earth: bool = switch(
        "Curved Earth",
        "Let the sea sink away with distance as the Earth does, so that the horizon lies where it should:"
        " visible from some ten metres of height on",
        False,
    )

    def __post_init__(self):
        validate(self)
