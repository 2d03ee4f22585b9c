# SPDX-License-Identifier: GPL-3.0-or-later
"""What time it is on the sea in a given frame: a function of the frame and the settings, nothing else."""

from dataclasses import dataclass

from .parameters import Option, choice, integer, number, validate

_LOOP_SUBFRAMES = 1000
"""Moments of a frame that a loop tells apart. Blender rounds the sum of frame and sub-frame to float32, by which
the same sub-frame of frames a loop apart differs: by 1/4000 below frame 8192. It still is the same moment."""

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
        "Speed",
        "Speed of the sea's clock against the scene's; 1 is real time, negative runs backwards. To change it"
        " during a shot, key the Time instead",
        1.0, -100.0, 100.0,
    )  # fmt: skip
    offset: float = number(
        "Offset", "Seconds added to the sea's clock: another stretch of the same sea",
        0.0, -_LONGEST_TIME, _LONGEST_TIME, "s",
    )  # fmt: skip

    loop_frames: int = integer(
        "Loop Frames", "Number of frames after which the sea repeats exactly; 0 never repeats", 0, 0, 1_000_000
    )

    def __post_init__(self):
        validate(self)


def sea_time(settings: OceanTime, frame: float, frames_per_second: float) -> float:
    """The sea's clock, s, at a frame number with its sub-frame.

    `frame` is the scene's own number; its time remapping is in `frames_per_second`. A loop is taken out of the
    frame number, where it is exact: frames N apart have the same time, bit for bit, whatever the frame rate.
    """
    if settings.source == "KEYED":
        scene_time = settings.time
    elif settings.loop_frames:
        scene_time = _frame_of_loop(frame, settings.loop_frames) / frames_per_second
    else:
        scene_time = frame / frames_per_second
    return scene_time * settings.speed + settings.offset


def _frame_of_loop(frame, loop_frames):
    return round(frame * _LOOP_SUBFRAMES) % (loop_frames * _LOOP_SUBFRAMES) / _LOOP_SUBFRAMES


def loop_period(settings: OceanTime, frames_per_second: float) -> float:
    """Time on the sea's clock in s that a loop's frames take; 0 without a loop, or when the clock stands still."""
    return settings.loop_frames / frames_per_second * abs(settings.speed)
