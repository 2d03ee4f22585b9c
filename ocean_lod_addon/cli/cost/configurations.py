# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole configurations from Draft to Reference: what each gets wrong, and what its frames take."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from ...core.cost.model import CostModel
from ...core.cost.probe import typical
from ...core.cost.quality import QUALITIES, Quality, apply, ladder
from ...core.ripple_settings import Ripples
from . import frames
from .budgets import SIZED
from .knobs.geometry import MILLIMETRES, mesh_height_error
from .knobs.ripples import ripple_error
from .pictures import PictureDifference


@dataclass(frozen=True)
class ConfigurationResult:
    """A quality on the ocean of the Add menu.

    height       rms height of the mesh between its vertices, mm
    ripples      share of the ripples' slope variance shown wrongly or not at all, %
    predicted    ms of a frame
    measured     ms, or None where it was not measured
    picture      difference from the Reference's picture, or None where none was rendered
    """

    name: str
    label: str
    vertices: int
    waves: int
    samples: float
    reach: float
    texels: str
    instants: int
    height: float
    ripples: float
    predicted: float
    measured: float | None
    picture: PictureDifference | None

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "quality": self.name,
            "label": self.label,
            "vertices": self.vertices,
            "waves": self.waves,
            "vertices_per_wavelength": self.samples,
            "reach": self.reach,
            "ripples": self.texels,
            "foam_instants": self.instants,
            "height_error_mm": self.height,
            "ripples_wrong_percent": self.ripples,
            "predicted_ms": self.predicted,
            "measured_ms": self.measured,
            "picture": self.picture and self.picture.as_mapping(),
        }


def settings_of_quality(name: str):
    """The settings of the ocean of the Add menu in a quality."""
    return apply(QUALITIES[name], SIZED)


def measure_configurations(
    find: Callable[[], CostModel], longest: float, with_blender: bool
) -> list[ConfigurationResult]:
    """All qualities, without their pictures, each by the prices that `find` finds just before it is measured.

    Those whose frames are predicted to take more than `longest` s are not measured.
    """
    return [_measure(name, quality, find, longest, with_blender) for name, quality in QUALITIES.items()]


def _measure(name, quality, find, longest, with_blender):
    settings = apply(quality, SIZED)
    predicted = find().total(frames.work(settings))
    measured = None
    if predicted <= longest:
        with frames.later_frames(settings, with_blender) as run:
            measured = 1e3 * typical(frames.times(run))
    return ConfigurationResult(
        name,
        quality.label,
        settings.grid.vertex_count,
        settings.sea.wave_count,
        quality.samples,
        quality.reach,
        quality.ripples,
        quality.instants,
        height_error(quality),
        _ripples_wrong(quality),
        1e3 * predicted,
        measured,
        None,
    )


def height_error(quality: Quality) -> float:
    """Rms height of the mesh between its vertices, mm."""
    settings = apply(quality, SIZED)
    return MILLIMETRES * mesh_height_error(settings.grid, settings.sea)


def _ripples_wrong(quality):
    if quality.ripples == "off":
        return ripple_error(Ripples(kind="off"))
    return ripple_error(replace(SIZED.ripples, resolution=quality.ripples))


@dataclass(frozen=True)
class FrontPoint:
    """A step of the ladder: predicted ms, and the height error of its mesh density, mm."""

    label: str
    samples: float
    ripples: str
    predicted: float

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "label": self.label,
            "vertices_per_wavelength": self.samples,
            "ripples": self.ripples,
            "predicted_ms": self.predicted,
        }


def front(model: CostModel) -> list[FrontPoint]:
    """The predicted time of every rung of the ladder between Draft and Reference."""
    return [
        FrontPoint(
            rung.label,
            rung.quality.samples,
            rung.quality.ripples,
            1e3 * model.total(frames.work(apply(rung.quality, SIZED))),
        )
        for rung in ladder(SIZED.grid)
    ]
