# SPDX-License-Identifier: GPL-3.0-or-later
"""What the commands' arguments mean, each with one clear line for a bad value."""

import argparse
import math
import re
from dataclasses import dataclass

_LARGEST_FRAME = 1_048_574  # Blender's own limit
_LARGEST_SIDE = 65_536


@dataclass(frozen=True)
class FrameRange:
    """Frames first to last, both rendered, `step` apart."""

    first: int
    last: int
    step: int = 1

    def __len__(self):
        return len(range(self.first, self.last + 1, self.step))


def frame_range(text: str) -> FrameRange:
    """A, A:B or A:B:STEP."""
    match = re.fullmatch(r"(-?\d+)(?::(-?\d+)(?::(\d+))?)?", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not A, A:B or A:B:STEP, such as 1:240 or 1:240:2")
    first = int(match[1])
    last = int(match[2]) if match[2] else first
    step = int(match[3]) if match[3] else 1
    if not -_LARGEST_FRAME <= first <= last <= _LARGEST_FRAME:
        raise argparse.ArgumentTypeError(
            f"{text!r}: allowed is {-_LARGEST_FRAME} <= first <= last <= {_LARGEST_FRAME}"
        )
    if step < 1:
        raise argparse.ArgumentTypeError(f"{text!r}: the step is {step}, allowed is 1 or more")
    return FrameRange(first, last, step)


def resolution(text: str) -> tuple[int, int]:
    """WIDTHxHEIGHT in pixels."""
    match = re.fullmatch(r"(\d+)[xX](\d+)", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not WIDTHxHEIGHT, such as 1920x1080")
    width, height = int(match[1]), int(match[2])
    if not (4 <= width <= _LARGEST_SIDE and 4 <= height <= _LARGEST_SIDE):
        raise argparse.ArgumentTypeError(f"{text!r}: allowed is 4 to {_LARGEST_SIDE} pixels a side")
    return width, height


def whole_number(minimum: int, maximum: int):
    """A parser for whole numbers from `minimum` to `maximum`."""

    def parse(text):
        try:
            value = int(text)
        except ValueError:
            value = None
        if value is None or not minimum <= value <= maximum:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not allowed, give a whole number from {minimum} to {maximum}"
            )
        return value

    return parse


def real_number(minimum: float, maximum: float):
    """A parser for numbers from `minimum` to `maximum`."""

    def parse(text):
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not minimum <= value <= maximum:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not allowed, give a number from {minimum:g} to {maximum:g}"
            )
        return value

    return parse
