# SPDX-License-Identifier: GPL-3.0-or-later
"""What time it is on the sea in a given frame: a function of the frame and the settings, nothing else."""

from dataclasses import dataclass

from .parameters import Option, choice, number, validate

_LONGEST_TIME = 1e9  # s, thirty years; float64 phases still have micro-radian precision there


@dataclass(frozen=True)
class OceanTime:
    """How the sea's clock follows the shot."""

    source: str = choice(
        "Clock",
        "What drives the sea's clock",
        "FRAMES",
        (
            Option("FRAMES", "Frame", "The sea's clock follows the scene's frame and frame rate"),
            Option("KEYED", "Keyed Time", "The sea's clock is the Time below, to be keyed for a retimed shot"),
        ),
    )
    time: float = number("Time", "The sea's clock when it is keyed", 0.0, -_LONGEST_TIME, _LONGEST_TIME, "s")
    speed: float = number(
        "Speed", "Speed of the sea's clock against the scene's; 1 is real time, negative runs backwards",
        1.0, -100.0, 100.0,
    )  # fmt: skip
    offset: float = number(
        "Offset", "Seconds added to the sea's clock: another stretch of the same sea",
        0.0, -_LONGEST_TIME, _LONGEST_TIME, "s",
    )  # fmt: skip

    def __post_init__(self):
        validate(self)


def sea_time(settings: OceanTime, frame: float, frames_per_second: float) -> float:
    """The sea's clock, s, at a frame number with its sub-frame, after the scene's own time remapping."""
    scene_time = settings.time if settings.source == "KEYED" else frame / frames_per_second
    return scene_time * settings.speed + settings.offset
