# SPDX-License-Identifier: GPL-3.0-or-later
"""What an accuracy knob is: a ladder of values, each with an error that is exact and a piece of work to time."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Step:
    """One value of a knob.

    value   as a person would call it
    error   computes the error in the knob's unit; the same on every call
    work    prepares what is to be timed, and returns a function of the sea's time in s; None for what takes none
    scale   how many times the timed work belongs to the knob's `time_of`
    """

    value: str
    error: Callable[[], float]
    work: Callable[[], Callable[[float], object]] | None
    scale: float = 1.0


@dataclass(frozen=True)
class Knob:
    """A choice between exact and cheap.

    key         short name, for files and the command line
    label       for tables and plots
    affects     what of the picture it changes
    error_of    what the error is, in words; `unit` is its unit
    reference   what the error is counted from
    time_of     what the time is of
    steps       from the least accurate to the most accurate: errors never rise along the ladder
    in_blender  whether its steps need Blender
    """

    key: str
    label: str
    affects: str
    error_of: str
    unit: str
    reference: str
    time_of: str
    steps: tuple[Step, ...]
    in_blender: bool = False
