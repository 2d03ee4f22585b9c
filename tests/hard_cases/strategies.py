# SPDX-License-Identifier: GPL-3.0-or-later
"""Hypothesis strategies for every settings class, derived from the parameters' own descriptions."""

import dataclasses
import math
import os

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from ocean_lod_addon.core.camera_view import CameraView
from ocean_lod_addon.core.framing import Framing
from ocean_lod_addon.core.lod import CELLS_STEP, Grid
from ocean_lod_addon.core.parameters import Choice, Integer, Number, Switch, Text, parameters_of
from ocean_lod_addon.core.sea import Sea, WaveSystem

EXAMPLES = int(os.environ.get("OCEAN_LOD_EXAMPLES", "25"))
"""Examples of each property; `make fuzz` asks for 10 000."""

any_settings = settings(
    max_examples=EXAMPLES,
    deadline=None,  # shared machines
    derandomize="OCEAN_LOD_EXAMPLES" not in os.environ,  # the normal test run is the same every time
    database=None,
    suppress_health_check=list(HealthCheck),
)
"""How the property tests run."""

MOST_SYSTEMS = 3
MOST_WAVES = 200
"""Of a system, in most examples: the largest number is a hard case of its own (test_discretisation)."""

MOST_CELLS, MOST_LEVELS = 24, 5
"""Small planes show what large ones do, and are quick."""


def values_of(parameter):
    """Any allowed value of a parameter: its ends and default often, between them evenly and by magnitude."""
    match parameter:
        case Number():
            low, high = parameter.minimum, parameter.maximum
            between = st.floats(low, high, width=64)
            ends = st.sampled_from([low, high, parameter.default])
            if low < 0.0:
                return ends | between
            smallest = low if low > 0.0 else high * 1e-12
            magnitudes = st.floats(math.log(smallest), math.log(high)).map(
                lambda exponent: min(max(math.exp(exponent), low), high)
            )
            return ends | between | magnitudes
        case Integer():
            return st.sampled_from([parameter.minimum, parameter.maximum, parameter.default]) | st.integers(
                parameter.minimum, parameter.maximum
            )
        case Choice():
            return st.sampled_from([option.key for option in parameter.options])
        case Switch():
            return st.booleans()
        case Text():
            return st.just(parameter.default)
    raise TypeError(parameter)


def settings_of(cls, **fields):
    """Instances of a settings class; `fields` are strategies that replace those of some parameters."""
    strategies = {name: values_of(parameter) for name, parameter in parameters_of(cls).items()}
    return st.builds(cls, **(strategies | fields))


wave_systems = settings_of(WaveSystem)


def seas(**fields):
    """Seas of up to three systems; with `fields` as in `settings_of`."""
    defaults = {
        "systems": st.lists(wave_systems, min_size=1, max_size=MOST_SYSTEMS).map(tuple),
        "wave_count": st.sampled_from([1, 2, 3, 128]) | st.integers(1, MOST_WAVES),
        "loop_period": st.just(0.0) | st.floats(1e-3, 1e6),
    }
    return settings_of(Sea, **(defaults | fields))


grids = settings_of(
    Grid,
    cells=st.integers(1, MOST_CELLS // CELLS_STEP).map(lambda count: CELLS_STEP * count),
    levels=st.integers(1, MOST_LEVELS),
)
framings = settings_of(Framing)

shortest_wavelengths = st.floats(math.log(1e-3), math.log(1e4)).map(math.exp)
places = st.tuples(*[st.floats(-1e6, 1e6)] * 2)
times = st.floats(-1e7, 1e7)
angles = st.floats(-math.pi, math.pi) | st.sampled_from([0.0, math.pi / 2, -math.pi / 2, math.pi])


def _camera(place, height, yaw, pitch, roll, tangents, kind):
    def turn(axis, angle):
        c, s = math.cos(angle), math.sin(angle)
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        matrix = np.eye(3)
        matrix[i, i] = matrix[j, j] = c
        matrix[i, j], matrix[j, i] = -s, s
        return matrix

    columns = turn(2, yaw) @ turn(0, pitch) @ turn(2, roll)
    axes = np.stack([columns[:, 0], columns[:, 1], -columns[:, 2]])
    width, height_of_frame, shift_x, shift_y = tangents
    extent = (shift_x - width, shift_x + width, shift_y - height_of_frame, shift_y + height_of_frame)
    return CameraView(np.array([*place, height]), axes, extent, kind)


cameras = st.builds(
    _camera,
    places,
    st.sampled_from([0.0, 1e-9, 1.7, 1e4]) | st.floats(-100.0, 1e5),
    angles,
    st.floats(0.0, math.pi) | st.sampled_from([0.0, math.pi / 2]),
    angles,
    st.tuples(st.floats(1e-4, 20.0), st.floats(1e-4, 20.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0)),
    st.sampled_from(["PERSP", "ORTHO", "PANO"]),
)
"""Cameras anywhere, turned in any way: yaw about z, pitch from straight down, and roll."""


def rotated(sea: Sea, angle: float) -> Sea:
    """The sea with all its directions turned by an angle in rad."""
    turned = tuple(
        dataclasses.replace(system, direction=math.remainder(system.direction + angle, 2.0 * math.pi))
        for system in sea.systems
    )
    return dataclasses.replace(sea, systems=turned)
