# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist's word on each effect: leave it to the plan, or not."""

from dataclasses import dataclass

from .parameters import Option, choice, validate

AUTO, ON, OFF = "auto", "on", "off"

_CHOICES = (
    Option(AUTO, "Auto", "On where the scene calls for it: the list of effects says why"),
    Option(ON, "On", "On, whether it shows or not"),
    Option(OFF, "Off", "Off, and nothing is spent on it"),
)


def _effect(label, description):
    return choice(label, description, AUTO, _CHOICES)


@dataclass(frozen=True)
class Effects:
    """Auto, on or off for every effect that can be left out of a picture.

    Auto turns an effect on if its own settings ask for it, where it has some, and if it shows.
    """

    horizontal_displacement: str = _effect(
        "Choppiness", "Sideways motion of the water, which makes crests sharp and troughs flat"
    )
    analytic_normals: str = _effect(
        "Wave Normals", "Shade with the exact slopes of the waves instead of those of the mesh's faces"
    )
    velocity: str = _effect(
        "Velocity", "Velocity of the water at each vertex, for motion blur in Cycles, exports and simulations"
    )
    foam: str = _effect("Foam", "Whitecaps of breaking waves, and the foam that they leave")
    ripples: str = _effect("Ripples", "Short waves as a bump of the surface")
    gusts: str = _effect("Gusts", "Patches of stronger and weaker ripples that drift with the wind")
    skewed_slopes: str = _effect("Skewed Slopes", "Steeper ripples towards the wind in the sun's reflection")
    curved_earth: str = _effect("Curved Earth", "The sea sinks away with distance, as the Earth does")
    see_through: str = _effect("See Through", "Light refracted into the water, absorbed and scattered there")
    finite_depth: str = _effect("Finite Depth", "Waves feel the bottom")

    def __post_init__(self):
        validate(self)
