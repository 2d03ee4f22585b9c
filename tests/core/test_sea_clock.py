# SPDX-License-Identifier: GPL-3.0-or-later
"""The sea's clock: retiming, and loops that close exactly."""

import dataclasses
import math

import pytest

from ocean_lod_addon.core.errors import OutOfRangeError
from ocean_lod_addon.core.ocean_time import OceanTime, loop_period, sea_time
from ocean_lod_addon.core.parameters import mapping_from_settings
from ocean_lod_addon.core.sea import Sea

RATES = (24.0, 25.0, 30 / 1.001, 24 / 1.001, 1.0, 240.0)


def test_speed_and_offset_act_on_frames_and_on_keyed_time():
    """Truth: time = speed * (frame / rate, or the keyed time) + offset."""
    assert sea_time(OceanTime(speed=0.5, offset=100.0), 48.0, 24.0) == 101.0
    assert sea_time(OceanTime(source="KEYED", time=8.0, speed=-2.0, offset=1.0), 48.0, 24.0) == -15.0


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("frames", [1, 7, 100, 240, 99_999])
def test_frames_a_loop_apart_have_the_same_time(frames, rate):
    """Truth: exact equality, for sub-frames, negative frames and any speed and offset."""
    clock = OceanTime(loop_frames=frames, speed=1.7, offset=12.34)
    for frame in (1.0, 1.25, 37.3, 0.0, -12.75, 250.9):
        first = sea_time(clock, frame, rate)
        assert [sea_time(clock, frame + n * frames, rate) for n in (-1, 1, 5)] == [first] * 3


def test_a_loop_takes_next_to_nothing_from_the_precision_of_time():
    """Truth: within 1/2000 of a frame of the clock without a loop, anywhere in the loop."""
    for frame in (1.0, 17.123456, 99.99):
        looped, free = (sea_time(OceanTime(loop_frames=frames), frame, 24.0) for frames in (100, 0))
        assert abs(looped - free) <= 1 / 2000 / 24


@pytest.mark.parametrize("rate", RATES)
def test_the_loop_is_as_long_as_its_frames(rate):
    """Truth: the sea's clock advances by the loop period from frame 1 to frame N + 1, whichever way it runs."""
    for speed in (1.0, 0.25, -3.0):
        clock = OceanTime(loop_frames=120, speed=speed)
        free = dataclasses.replace(clock, loop_frames=0)
        advance = sea_time(free, 121.0, rate) - sea_time(free, 1.0, rate)
        assert loop_period(clock, rate) == pytest.approx(abs(advance), rel=1e-12)
    assert loop_period(OceanTime(), rate) == 0.0
    assert loop_period(OceanTime(loop_frames=10, speed=0.0), rate) == 0.0


def test_without_a_loop_time_goes_on():
    assert sea_time(OceanTime(), 1_000_000.0, 25.0) == 40_000.0


@pytest.mark.parametrize("wrong", [-1.0, math.nan, math.inf])
def test_a_loop_period_is_a_length_of_time(wrong):
    with pytest.raises(OutOfRangeError, match="loop_period"):
        Sea(loop_period=wrong)


def test_a_loop_is_no_part_of_a_sea_state():
    """Truth: it belongs to the shot: files hold none, whatever the sea."""
    assert not [key for key in mapping_from_settings(Sea(loop_period=10.0)) if "loop" in key]
