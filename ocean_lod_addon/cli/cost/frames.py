# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of whole configurations, to be timed: by NumPy alone, or through the handler that Blender calls."""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ...core.column_blocks import POSITION, TANGENTS
from ...core.cost.planned import planned_work
from ...core.cost.work import Work
from ...core.discretise import discretise
from ...core.effects import Effects
from ...core.foam_settings import Foam
from ...core.framing import Framing
from ...core.lod import Grid
from ...core.material_settings import MaterialSettings
from ...core.normals import surface_normals
from ...core.ocean import Ocean, Surface
from ...core.plan import Facts, Settings, decide, effective
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from ..bench import in_blender
from ..bench.timing import FRAMES_PER_SECOND, Contestant, one_after_another

IN_VIEWPORT = Facts(engine="CYCLES", final=False)
"""What is timed: a frame of the viewport, where the whole plane moves, without a camera."""


def settings_of(sea: Sea, grid: Grid, ripples: Ripples, foam: Foam | None = None) -> Settings:
    """An artist's settings with everything else left to itself."""
    return Settings(sea, grid, Framing(), MaterialSettings(), ripples, foam or Foam(), Effects())


def work(settings: Settings, contraction: str | None = None) -> Work:
    """The work of a frame of these settings, with a contraction of core.contraction or this NumPy's own."""
    return planned_work(IN_VIEWPORT, settings, None, contraction)


class NumpyFrame:
    """The stages of a frame that need no Blender, with any contraction."""

    def __init__(self, settings: Settings, contraction: str | None):
        plan = decide(IN_VIEWPORT, settings, discretise(settings.sea, settings.grid.shortest_wavelength))
        used = effective(settings, plan)
        ocean = Ocean(used.sea, used.grid, used.framing, used.ripples, used.foam)
        self._surface = Surface(ocean, contraction)
        self._placement = self._surface.placement()
        self._positions = self._array(POSITION.columns)
        self._tangents = self._array(TANGENTS.columns) if TANGENTS in plan.blocks else None
        self._foam = None if ocean.foam is None else self._array(ocean.foam.memory_steps)
        self._bump = self._surface.bump

    def _array(self, columns):
        return np.empty((self._surface.vertex_count, columns), np.float32)

    def contestant(self, name: str) -> Contestant:
        """The stages as parts."""
        parts = {"waves": self._waves}
        if self._tangents is not None:
            parts["normals"] = lambda _time: surface_normals(self._tangents, self._positions)
        if self._foam is not None:
            parts["foam"] = self._find_foam
        return Contestant(name, parts | {"ripples": self._ripples})

    def _waves(self, time):
        more = {} if self._tangents is None else {TANGENTS: self._tangents}
        if self._foam is not None:
            more[self._surface.whitecaps.block] = self._foam
        self._surface.positions(time, self._placement, self._positions, more)

    def _find_foam(self, _time):
        self._surface.whitecaps.foam(self._foam, np.empty(len(self._foam), np.float32))

    def _ripples(self, time):
        if self._bump is None or not self._bump.moves:
            return
        for number, tile in enumerate(self._bump.layout.tiles):
            self._bump.image(number, time, np.empty((tile.texels, tile.texels, 4), np.float32))


@dataclass(frozen=True)
class BlenderOcean:
    """An ocean alone in a scene, moved by the function that the frame-change handler calls."""

    ob: object
    scene: object

    @classmethod
    def of(cls, settings: Settings) -> "BlenderOcean":
        """A new ocean with these settings."""
        import bpy

        from ... import register
        from ...scene import ocean_object, properties

        if not hasattr(bpy.types.Object, "ocean_lod"):
            register()
        scene = bpy.data.scenes.new("cost")
        ob = ocean_object.create(scene, settings.sea, Grid(cells=8, levels=1), settings.material)
        properties.write_quality(ob.ocean_lod, "", settings.grid, settings)
        scene.collection.objects.link(ob)
        ocean_object.refresh(ob, scene)
        made = cls(ob, scene)
        made.evaluate()
        return made

    def contestant(self, name: str) -> Contestant:
        """The handler, then Blender's evaluation of the object."""
        return Contestant(name, {"handler": self.handle, "blender": self.evaluate})

    def handle(self, time: float) -> None:
        """Move the ocean to a time in s."""
        from ...scene import ocean_object

        # The number of the frame alone: frame_set would call the handlers of every ocean, and time them here.
        self.scene.frame_current = round(FRAMES_PER_SECOND * time)
        ocean_object.update(self.ob, self.scene, self.scene.view_layers[0].depsgraph)

    def evaluate(self, _time: float = 0.0) -> None:
        """Let Blender evaluate what has changed."""
        self.scene.view_layers[0].update()


@contextlib.contextmanager
def later_frames(
    settings: Settings, with_blender: bool, contraction: str | None = None
) -> Iterator[Callable[[], None]]:
    """A function that makes frame after frame of an ocean, through Blender or by NumPy alone.

    The first one, which writes what is static, has been made. By NumPy alone `contraction` is as for `work`.
    """
    with in_blender.fresh_data() if with_blender else contextlib.nullcontext():
        ocean = BlenderOcean.of(settings) if with_blender else NumpyFrame(settings, contraction)
        run = one_after_another(ocean.contestant("frame"))
        run()
        yield run


def times(run: Callable[[], None], frames: int = 3, seconds: float = 0.15) -> list[float]:
    """Seconds of each of so many `frames` or more, which take so many `seconds` together or more."""
    taken = []
    while len(taken) < frames or sum(taken) < seconds:
        start = time.perf_counter()
        run()
        taken.append(time.perf_counter() - start)
    return taken
