# SPDX-License-Identifier: GPL-3.0-or-later
"""The material's settings: what the water is, and how far an artist wants to leave the physics."""

from dataclasses import dataclass

from .parameters import Option, choice, number, switch, validate

PHYSICAL = "1 is physical"


@dataclass(frozen=True)
class MaterialSettings:
    """What the ocean material is built from; every default is physical."""

    water_type: str = choice(
        "Water",
        "What is in the water: it decides the colour of the light that comes back out of it",
        "clear_ocean",
        (
            Option("clear_ocean", "Clear ocean", "Deep blue water with next to no plankton"),
            Option("ocean", "Ocean", "Open sea of temperate latitudes"),
            Option("coastal", "Coastal", "Green water, rich in plankton"),
            Option("river", "River", "Brown water with silt and humic matter"),
        ),
    )
    tint_red: float = number("Tint Red", f"Factor on the red of the water. {PHYSICAL}", 1.0, 0.0, 4.0)
    tint_green: float = number("Tint Green", f"Factor on the green of the water. {PHYSICAL}", 1.0, 0.0, 4.0)
    tint_blue: float = number("Tint Blue", f"Factor on the blue of the water. {PHYSICAL}", 1.0, 0.0, 4.0)
    roughness: float = number(
        "Roughness",
        f"Factor on the root mean square slope of the waves that only shading shows. {PHYSICAL}",
        1.0,
        0.0,
        4.0,
    )
    glitter_strength: float = number(
        "Glitter", f"Factor on the brightness of the sun's reflection. {PHYSICAL}", 1.0, 0.0, 4.0
    )
    sun_model: str = choice(
        "Sun in Cycles",
        "How Cycles reflects the sun. EEVEE always evaluates the formula",
        "closure",
        (
            Option("closure", "Closure", "Cycles samples the sun's disc itself, with shadows"),
            Option("formula", "Formula", "The Ross BRDF of the sun in math nodes, for comparison"),
        ),
    )
    skewed_slopes: bool = switch(
        "Skewed Slopes",
        "Steep slopes rise towards the wind, as Cox and Munk measured, where the formula reflects the sun: EEVEE, "
        "and Cycles with Sun in Cycles set to Formula",
        False,
    )
    see_through: bool = switch(
        "See Through",
        "Refract and absorb light, for shots that look into the water. Slower, and the sea needs a bottom",
        False,
    )
    eevee_depth: float = number(
        "Bottom",
        "With See Through: depth of the bottom that EEVEE reckons with. Cycles finds the bottom itself",
        10.0,
        0.0,
        1000.0,
        "m",
        soft_maximum=50.0,
    )

    def __post_init__(self):
        validate(self)
