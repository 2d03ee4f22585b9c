# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of whole configurations, to be timed: by NumPy alone, or through the handler that Blender calls."""

from dataclasses import dataclass, replace

import numpy as np

from ...core.column_blocks import TANGENTS
from ...core.cost.planned import planned_work
from ...core.cost.work import Work
from ...core.effects import Effects
from ...core.foam_settings import Foam
from ...core.framing import Framing
from ...core.lod import Grid
from ...core.material_settings import MaterialSettings
from ...core.normals import surface_normals
from ...core.ocean import Ocean, Surface
from ...core.plan import Facts, Settings
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from ..bench.timing import FRAMES_PER_SECOND, Contestant

IN_VIEWPORT = Facts(engine="CYCLES", final=False)
"""What is timed: a frame of the viewport, where the whole plane moves, without a camera."""


def settings_of(sea: Sea, grid: Grid, ripples: Ripples) -> Settings:
    """An artist's settings with everything else left to itself."""
    return Settings(sea, grid, Framing(), MaterialSettings(), ripples, Foam(), Effects())


def work(settings: Settings) -> Work:
    """The work of a frame of these settings."""
    return planned_work(IN_VIEWPORT, settings, None)


class NumpyFrame:
    """The stages of a frame that need no Blender, with any contraction."""

    def __init__(self, settings: Settings, contraction: str | None):
        ripples = settings.ripples
        if settings.effects.ripples == "off":
            ripples = replace(ripples, kind="off")
        self._surface = Surface(Ocean(settings.sea, settings.grid, settings.framing, ripples), contraction)
        self._placement = self._surface.placement()
        self._positions = np.empty((self._surface.vertex_count, 3), np.float32)
        self._tangents = np.empty((self._surface.vertex_count, TANGENTS.columns), np.float32)
        self._bump = self._surface.bump

    def contestant(self, name: str) -> Contestant:
        """The stages as parts."""
        return Contestant(name, {"waves": self._waves, "normals": self._normals, "ripples": self._ripples})

    def _waves(self, time):
        self._surface.positions(time, self._placement, self._positions, {TANGENTS: self._tangents})

    def _normals(self, _time):
        surface_normals(self._tangents, self._positions)

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
