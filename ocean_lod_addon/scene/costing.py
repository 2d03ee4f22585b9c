# SPDX-License-Identifier: GPL-3.0-or-later
"""What a frame of an ocean costs on this machine, and the quality that it can afford.

Prices are measured, settings chosen by them are written, once, by operators and the command line; no frame depends
on a time.
"""

import contextlib
from dataclasses import fields, replace

import bpy
import numpy as np

from ..core.cost import probe
from ..core.cost.budget import Choice, choose
from ..core.cost.model import CostModel
from ..core.cost.planned import planned_work
from ..core.cost.quality import QUALITIES, Quality, apply, ladder
from ..core.cost.work import Work
from ..core.errors import OceanError
from ..core.lod import Grid
from ..core.material_settings import MaterialSettings
from ..core.plan import EFFECT_ATTRIBUTES, NORMAL_ATTRIBUTE
from ..core.ripple_settings import Ripples
from ..core.sea import Sea
from . import mesh as mesh_arrays
from . import ocean_object, placing, planning, properties
from .fresh_data import fresh_data
from .ripple_images import IMAGE_KEY, write_pixels

_PROBED = (Grid(cells=64, levels=8), Grid(cells=128, levels=8))
"""The planes of meshes that are measured in Blender, each without normals and with them."""

_PROBED_OCEAN = Grid(cells=64, levels=8)
"""The plane of an ocean that is measured there, with waves to decide about and an image of ripples."""

_NOTHING = Work(*[0.0] * len(fields(Work)))


class _Machine:
    """The prices of this machine, once they were measured."""

    def __init__(self):
        self.model: CostModel | None = None


_machine = _Machine()


def model() -> CostModel | None:
    """The prices of this machine, or None before `measure_machine`."""
    return _machine.model


def measure_machine() -> CostModel:
    """Find the prices of this machine: about a second."""
    with price_cases() as cases:
        _machine.model = CostModel(probe.measured_prices(cases))
    return _machine.model


@contextlib.contextmanager
def price_cases():
    """What tells the prices of all stages, as `probe.measured_prices` takes it; it is gone after the context."""
    with fresh_data():
        yield probe.numpy_cases(show=_shown_image) | _blender_cases()


def _shown_image(texels):
    image = bpy.data.images.new("probe", texels, texels, alpha=True, float_buffer=True, is_data=True)
    return lambda pixels: write_pixels(image, pixels)


def _blender_cases():
    """Objects in scenes of their own: handing positions over, and Blender's evaluation of what has changed."""
    ocean = _ProbedOcean()
    meshes = [mesh for grid in _PROBED for mesh in _probed_meshes(grid)]
    probed = [*(_ProbedMesh(mesh) for mesh in meshes), ocean]
    return {
        "setup": [(ocean.work, ocean.decide)],
        "write": [(one.work, one.write) for one in probed],
        "blender": [(one.work, one.evaluate) for one in probed],
    }


class _Probed:
    """An object whose vertices move without being computed."""

    def __init__(self, scene, ob, image=None):
        scene.collection.objects.link(ob)
        self._scene, self._object, self._image = scene, ob, image
        self.evaluate()
        self._positions = mesh_arrays.read_positions(ob.data)
        self._with_normals = NORMAL_ATTRIBUTE in ob.data.attributes
        vertices = float(len(self._positions))
        self.work = replace(
            _NOTHING,
            vertices=vertices,
            normals=vertices * self._with_normals,
            vectors=1.0 + self._with_normals,
            images=float(image is not None),
        )

    def write(self, _time):
        """Positions, and normals where there are any."""
        mesh = self._object.data
        self._positions[:, 2] += np.float32(1e-3)
        mesh_arrays.write_positions(mesh, self._positions)
        if self._with_normals:
            mesh_arrays.write_vectors(mesh, NORMAL_ATTRIBUTE, self._positions)
        if self._image is not None:
            self._image.update_tag()

    def evaluate(self, _time=0.0):
        """What Blender does about it."""
        self._scene.view_layers[0].update()


def _probed_meshes(grid):
    """A plane, and a copy with normals, which is made sooner than another plane."""
    mesh = bpy.data.meshes.new("probe")
    mesh_arrays.build_topology(mesh, grid)
    with_normals = mesh.copy()
    mesh_arrays.ensure_attributes(with_normals, [NORMAL_ATTRIBUTE], EFFECT_ATTRIBUTES)
    return mesh, with_normals


class _ProbedMesh(_Probed):
    """The mesh of an ocean, which is all that Blender evaluates of it: no material is made."""

    def __init__(self, mesh):
        ob = bpy.data.objects.new("probe", mesh)
        ocean_object.add_pass_through_modifier(ob)
        super().__init__(bpy.data.scenes.new("probe"), ob)


class _ProbedOcean(_Probed):
    """A whole ocean with ripples."""

    def __init__(self):
        scene, ripples = bpy.data.scenes.new("probe"), Ripples(kind="random", resolution="256")
        ob = ocean_object.create(scene, Sea(), _PROBED_OCEAN, MaterialSettings(), ripples=ripples)
        image = next(i for i in bpy.data.images if i.get(IMAGE_KEY, "").startswith(ob.name))
        super().__init__(scene, ob, image)

    def decide(self, time):
        """What a frame decides before it computes."""
        depsgraph = self._scene.view_layers[0].depsgraph
        ocean_object.decide_frame(self._object, self._scene, depsgraph, time)


def predict(ob, scene, settings=None, final: bool = True) -> dict[str, float]:
    """Seconds of each stage of an ocean's frame, for its own settings or others. Raises OceanError.

    Of the picture rendered at the scene's current frame, or, not `final`, of the viewport's. Without prices {}.
    """
    if _machine.model is None:
        return {}
    settings = settings or planning.read_settings(ob, scene)
    view = placing.camera_view(ob, scene)
    facts = planning.scene_facts(ob, scene, settings, view, final)
    return _machine.model.predict(planned_work(facts, settings, view))


def set_quality(ob, scene, name: str, quality: Quality | None = None) -> None:
    """Give an ocean the quality called `name` in core.cost.quality, or one between two of them."""
    sized, _ = properties.sized_plane(ob.ocean_lod)
    settings = replace(planning.read_settings(ob, scene), grid=sized)
    properties.write_quality(ob.ocean_lod, name, sized, apply(quality or QUALITIES[name], settings))
    ocean_object.refresh(ob, scene)


def meet_budget(ob, scene, seconds: float, final: bool = True) -> Choice:
    """Give an ocean the most accurate quality whose frames take `seconds` at most, and say which and why.

    Measures the machine if that has not been done. If even the cheapest is too slow that is chosen, and the choice
    says so. Raises OceanError.
    """
    if seconds <= 0.0:
        raise OceanError(f"the budget is {1e3 * seconds:g} ms, allowed is more than 0 ms")
    if _machine.model is None:
        measure_machine()
    sized, _ = properties.sized_plane(ob.ocean_lod)
    settings = replace(planning.read_settings(ob, scene), grid=sized)

    def predicted(rung):
        return predict(ob, scene, apply(rung.quality, settings), final)

    choice = choose(ladder(sized), predicted, seconds)
    set_quality(ob, scene, choice.rung.name, choice.rung.quality)
    return choice
