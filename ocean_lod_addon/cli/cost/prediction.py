# SPDX-License-Identifier: GPL-3.0-or-later
"""The cost model tried on configurations that it was not calibrated with."""

from dataclasses import dataclass

from ...core.foam_settings import Foam
from ...core.lod import Grid
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from ..bench import in_blender
from ..bench.timing import one_after_another
from . import frames
from .steady import SteadyPrices

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


def try_model(prices: SteadyPrices, contraction: str | None, with_blender: bool) -> list[Prediction]:
    """Predictions beside times: of whole frames through Blender, or of what NumPy does in them."""
    return [_try_case(prices, contraction, with_blender, *case) for case in CASES]


def _try_case(prices, contraction, with_blender, grid, waves, ripples, instants):
    settings = frames.settings_of(Sea(wave_count=waves), grid, ripples, Foam(memory_steps=instants))
    name = f"{grid.vertex_count} vertices, {waves} waves, ripples {_text(ripples)}, foam {instants}"

    def timed(ocean):
        print(f"    {name}", flush=True)
        measured = prices.typical_seconds(one_after_another(ocean.contestant(name)))
        return Prediction(name, prices.model.total(frames.work(settings)), measured)

    if not with_blender:
        return timed(frames.NumpyFrame(settings, contraction))
    with in_blender.fresh_data():
        return timed(frames.BlenderOcean.of(settings))


def _text(ripples):
    return "off" if ripples.kind == "off" else ripples.resolution
