# SPDX-License-Identifier: GPL-3.0-or-later
"""The cost model tried on configurations that it was not calibrated with.

A processor that grows warm or is shared with others changes its pace within seconds. What a prediction is worth
shows only beside times that were measured when its prices were: so frames are measured before and after these are
found, all of that in turns, and the turn in the middle counts.
"""

from collections.abc import Callable
from dataclasses import dataclass

from ...core.cost.model import CostModel
from ...core.cost.probe import typical
from ...core.foam_settings import Foam
from ...core.lod import Grid
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from . import frames

LIMIT = 0.20
"""A prediction is right within this share of the measured time."""

_NONE, _256, _512, _1024 = (
    Ripples(kind="off"),
    Ripples(resolution="256"),
    Ripples(resolution="512"),
    Ripples(resolution="1024"),
)

CASES = (
    (Grid(0.10, 72, 10), 48, _NONE, 16),
    (Grid(0.10, 88, 11), 128, _NONE, 1),
    (Grid(0.05, 104, 12), 96, _256, 4),
    (Grid(0.20, 112, 9), 200, _NONE, 16),
    (Grid(0.10, 136, 10), 64, _512, 8),
    (Grid(0.08, 144, 11), 128, _256, 16),
    (Grid(0.15, 160, 8), 256, _NONE, 1),
    (Grid(0.10, 168, 11), 32, _256, 4),
    (Grid(0.30, 176, 7), 128, _1024, 16),
    (Grid(0.10, 200, 9), 160, _NONE, 8),
    (Grid(0.07, 208, 11), 96, _512, 16),
    (Grid(0.10, 224, 10), 128, _256, 1),
    (Grid(0.10, 240, 8), 48, _NONE, 4),
    (Grid(0.12, 264, 9), 128, _512, 16),
    (Grid(0.10, 280, 7), 192, _NONE, 8),
    (Grid(0.05, 304, 10), 128, _256, 16),
    (Grid(0.10, 336, 8), 80, _512, 1),
    (Grid(0.10, 352, 9), 128, _NONE, 4),
    (Grid(0.10, 400, 6), 112, _256, 16),
    (Grid(0.10, 448, 7), 64, _NONE, 8),
)
"""(Plane, waves, ripples, instants of foam): 38 k to 827 k vertices."""


_TURNS = 3
"""So often prices are found, and a configuration is measured with them."""

_AGREEMENT = 0.1
"""Turns whose predictions are off by shares further apart than this are followed by as many more, less one."""


@dataclass(frozen=True)
class Prediction:
    """A configuration, and predicted and measured seconds of its frame."""

    name: str
    predicted: float
    measured: float

    @property
    def off_by(self) -> float:
        """Predicted over measured, less 1."""
        return self.predicted / self.measured - 1.0

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "configuration": self.name,
            "predicted_ms": 1e3 * self.predicted,
            "measured_ms": 1e3 * self.measured,
            "off_by": self.off_by,
        }


def try_model(find: Callable[[], CostModel], contraction: str | None, with_blender: bool) -> list[Prediction]:
    """Predictions beside times: of whole frames through Blender, or of what NumPy does in them.

    `find` finds the prices of this machine anew.
    """
    return [_try_case(find, contraction, with_blender, *case) for case in CASES]


def _try_case(find, contraction, with_blender, grid, waves, ripples, instants):
    settings = frames.settings_of(Sea(wave_count=waves), grid, ripples, Foam(memory_steps=instants))
    name = f"{grid.vertex_count} vertices, {waves} waves, ripples {_text(ripples)}, foam {instants}"
    print(f"    {name}", flush=True)
    work = frames.work(settings, contraction)

    with frames.later_frames(settings, with_blender, contraction) as run:

        def turn():
            before = frames.times(run)
            model = find()
            return Prediction(name, model.total(work), typical(before + frames.times(run)))

        turns = [turn() for _ in range(_TURNS)]
        if not agree(turns):
            turns += [turn() for _ in range(_TURNS - 1)]
    return middle(turns)


def agree(predictions: list[Prediction]) -> bool:
    """Whether the machine kept its pace."""
    off = [one.off_by for one in predictions]
    return max(off) - min(off) <= _AGREEMENT


def middle(predictions: list[Prediction]) -> Prediction:
    """The one of an odd number that as many exceed as fall short of."""
    in_order = sorted(predictions, key=lambda one: one.off_by)
    return in_order[len(in_order) // 2]


def _text(ripples):
    return "off" if ripples.kind == "off" else ripples.resolution
