# SPDX-License-Identifier: GPL-3.0-or-later
"""Oceans to measure an effect by: with it and no other, with it turned off again, and without any ever."""

import math
from dataclasses import dataclass

from ...core.effects import OFF, ON, Effects
from ...core.foam_settings import Foam
from ...core.framing import Framing
from ...core.lod import Grid
from ...core.material_settings import MaterialSettings
from ...core.parameters import parameters_of
from ...core.plan import Settings
from ...core.ripple_settings import Ripples
from ...core.sea import Sea
from ...core.shot import Shot
from .. import render
from ..bench.in_blender import mesh_bytes
from ..bench.timing import Contestant
from ..bench.workloads import kept_by_building
from ..cost.frames import BlenderOcean

NAMES = tuple(parameters_of(Effects))

ABSENT = "absent"
"""The state of an ocean, beside on and off, that never had any effect."""

_NONE = Effects(**dict.fromkeys(NAMES, OFF))


@dataclass(frozen=True)
class Picture:
    """Renders: the engine, CYCLES or EEVEE, the size in pixels, the samples of each, and how many are timed."""

    engine: str
    resolution: tuple[int, int]
    samples: int
    renders: int


class EffectOcean:
    """An ocean without effects, a camera, a sun and a grey sky; effects can be turned on and off."""

    def __init__(self, grid: Grid):
        from ...scene import shot_scene

        material = MaterialSettings(sun_model="formula")  # with Cycles' closure there are no skewed slopes
        self._ocean = BlenderOcean.of(Settings(Sea(), grid, Framing(), material, Ripples(), Foam(), _NONE))
        scene = self._ocean.scene
        render.set_engine(scene, "CYCLES")
        scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
        shot_scene.add_camera(scene, Shot())
        _light(scene)
        self._refresh()

    def set(self, effect: str, word: str) -> "EffectOcean":
        """Turn an effect on or off; returns itself."""
        from ...scene import properties

        with properties.many_changes():
            setattr(self._ocean.ob.ocean_lod.effects, effect, word)
        self._refresh()
        return self

    def _refresh(self):
        from ...scene import ocean_object

        ocean_object.refresh(self._ocean.ob, self._ocean.scene)
        ocean_object.refresh_material(self._ocean.ob, self._ocean.scene)
        self._ocean.evaluate()  # frames read settings from what Blender has evaluated

    def frame(self, name: str) -> Contestant:
        """A frame of the viewport up to the normals that it is shaded with, whoever makes them."""
        return Contestant(name, {"handler": self._ocean.handle, "blender": self._evaluate})

    def _evaluate(self, _time):
        self._ocean.evaluate()
        evaluated = self._ocean.ob.evaluated_get(self._ocean.scene.view_layers[0].depsgraph)
        evaluated.data.corner_normals[0].vector  # noqa: B018 - Blender makes them when they are asked for

    def picture(self, name: str, picture: Picture) -> Contestant:
        """A whole render, with all that comes before its first sample."""
        import bpy

        scene = self._ocean.scene

        def shoot(_time):
            render.set_engine(scene, picture.engine)
            render.set_samples(scene, picture.samples)
            scene.render.resolution_x, scene.render.resolution_y = picture.resolution
            scene.render.resolution_percentage = 100
            bpy.ops.render.render(scene=scene.name)

        return Contestant(name, {picture.engine: shoot})

    def memory(self) -> int:
        """Bytes of the mesh, of images, and of all that NumPy holds for a frame."""
        from ...scene import ocean_object

        self._ocean.handle(0.0)  # what Python keeps of settings is not the effect's
        ocean_object.forget_surfaces()
        arrays = kept_by_building(lambda: self._ocean.handle(1.0))
        return arrays + mesh_bytes(self._ocean.ob.data) + sum(self._image_bytes())

    def _image_bytes(self):
        import bpy

        from ...nodes.material import MATERIAL_KEY
        from ...scene.ripple_images import IMAGE_KEY

        owner = self._ocean.ob.data.materials[0][MATERIAL_KEY]
        for image in bpy.data.images:
            if image.get(IMAGE_KEY, "").rpartition(" ")[0] == owner:
                yield 4 * image.channels * image.size[0] * image.size[1]


def _light(scene):
    """A sun without shadows and a grey sky: what all effects have in common shall not hide what one of them takes.

    A physical sky takes longer to prepare than all of the picture, and so do, for EEVEE without a graphics
    processor, the maps of shadows and a sharp image of the sky.
    """
    import bpy

    scene.world = bpy.data.worlds.new("Grey")
    scene.world.probe_resolution = "128"
    scene.eevee.use_shadows = False
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.rotation_euler = (math.radians(60.0), 0.0, math.radians(-90.0))
    scene.collection.objects.link(sun)


def states_of(effect: str, grid: Grid) -> dict[str, EffectOcean]:
    """New oceans with an effect on, turned on and off again, and without any that ever was on."""
    on, off, absent = (EffectOcean(grid) for _ in range(3))
    on.set(effect, ON)
    off.set(effect, ON)
    off.frame("").parts["handler"](0.0)
    off.set(effect, OFF)
    return {ON: on, OFF: off, ABSENT: absent}
