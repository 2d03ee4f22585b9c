# SPDX-License-Identifier: GPL-3.0-or-later
"""The knob of foam: at how many past instants it is looked for."""

import functools

import numpy as np

from ....core.discretise import discretise
from ....core.foam.whitecaps import Whitecaps
from ....core.foam_settings import Foam
from ....core.kernel import FrameKernel
from ....core.lod import Grid
from ....core.parameters import parameters_of
from ....core.sea import Sea, WaveSystem
from .knob import Knob, Step

_SEA = Sea(systems=(WaveSystem(wind_speed=15.0),), wave_count=128)
_GRID = Grid(cell_size=0.4, cells=192, levels=1)
_TIMES = (0.0, 40.0, 80.0)  # s
_LADDER = (1, 2, 4, 8, 16, 32, 64)
_MOST = parameters_of(Foam)["memory_steps"].maximum


class _Foam:
    """The foam of a patch."""

    def __init__(self, steps):
        waves = discretise(_SEA, _GRID.shortest_wavelength)
        self._kernel = FrameKernel(_GRID, waves)
        self._whitecaps = Whitecaps(Foam(memory_steps=steps), _SEA, _GRID, waves)
        self._positions = np.empty((self._kernel.vertex_count, 3), np.float32)
        self._columns = np.empty((self._kernel.vertex_count, steps), np.float32)

    def at(self, time: float) -> np.ndarray:
        """Share of the area around each vertex that is white."""
        anchors = np.zeros((_GRID.levels, 2))
        self._kernel.evaluate(time, anchors, self._positions, more={self._whitecaps.block: self._columns})
        foam = np.empty(len(self._columns), np.float32)
        self._whitecaps.foam(self._columns, foam)
        return foam


@functools.cache
def _truth():
    foam = _Foam(_MOST)
    return np.stack([foam.at(time) for time in _TIMES])


def memory_error(steps: int) -> float:
    """Rms difference of the foam from that of as many instants as there can be, % of the deviation of that."""
    foam = _Foam(steps)
    difference = np.stack([foam.at(time) for time in _TIMES]) - _truth()
    return 100.0 * float(np.sqrt(np.mean(difference**2)) / _truth().std())


MEMORY = Knob(
    "foam_memory",
    "Instants that foam is looked for at",
    "How smoothly the trail of a breaking crest fades",
    "Foam that is elsewhere or missing, rms, over the deviation of all foam",
    "%",
    f"Foam looked for at {_MOST} instants (15 m/s)",
    f"A frame of {_GRID.vertex_count} vertices with foam",
    tuple(Step(str(steps), lambda n=steps: memory_error(n), lambda n=steps: _Foam(n).at) for steps in _LADDER),
)
