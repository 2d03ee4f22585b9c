# SPDX-License-Identifier: GPL-3.0-or-later
"""What the ocean's material costs in a render, beside a plain Glossy BSDF on the same mesh.

The time of a sample is what more samples add to a picture: what comes before the first one (the surface, its way
into the renderer, shader compilation) is the same for few and many samples and drops out.
"""

import tempfile
from dataclasses import dataclass
from pathlib import Path

from ...core.lod import Grid
from ...core.material_settings import MaterialSettings
from ...core.sea import Sea
from ...core.shot import Shot
from .. import render
from .in_blender import fresh_data
from .timing import Contestant, Timing, measure

GLOSSY, WATER, RIPPLES = "glossy", "water", "water with ripples"

MATERIALS = (GLOSSY, WATER, RIPPLES)
"""What is on the mesh, cheapest first."""

_FEW = 1


@dataclass(frozen=True)
class EnginePlan:
    """How much of an engine is measured: picture, samples of the longer render, what is on the mesh, how often."""

    engine: str  # CYCLES or EEVEE
    resolution: tuple[int, int]  # pixels
    many: int
    materials: tuple[str, ...] = MATERIALS
    rounds: int = 5


QUICK = (
    EnginePlan("CYCLES", (160, 90), 17, rounds=2),
    EnginePlan("EEVEE", (32, 18), 5, (GLOSSY, WATER), rounds=1),
)
FULL = (EnginePlan("CYCLES", (320, 180), 17, rounds=9), EnginePlan("EEVEE", (64, 36), 9, rounds=3))
"""EEVEE may have to do without a graphics processor: it then takes about a second a sample, and compiles its
shaders for every picture, those with ripples longest."""

_GRID = Grid(cell_size=0.4, cells=32)
"""Coarser than the menu's: the mesh is not what is measured."""


@dataclass(frozen=True)
class ShadingResult:
    """Seconds per sample and pixel by engine and material; an engine that does not render here is left out."""

    seconds: dict[str, dict[str, float]]

    def over_glossy(self, engine: str, material: str) -> float:
        """How many times longer a sample takes than with the Glossy BSDF."""
        return self.seconds[engine][material] / self.seconds[engine][GLOSSY]

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            engine: {
                material: {"sample_ns_per_pixel": 1e9 * seconds, "over_glossy": self.over_glossy(engine, material)}
                for material, seconds in by_material.items()
            }
            for engine, by_material in self.seconds.items()
        }


def measure_shading(plans: tuple[EnginePlan, ...]) -> ShadingResult:
    """A default sea in a default shot, with each material of a plan in turn."""
    seconds = {}
    with fresh_data():
        scene, materials = build()
        for plan in plans:
            render.set_engine(scene, plan.engine)
            scene.render.resolution_x, scene.render.resolution_y = plan.resolution
            materials[GLOSSY](None)
            try:
                _render(scene, _FEW)
            except RuntimeError as error:
                print(f"    {plan.engine} does not render here: {str(error).strip()}", flush=True)
                continue
            shown = [name for name in plan.materials if name in materials]
            contestants = [_contestant(scene, name, materials[name], plan.many) for name in shown]
            timings = measure(contestants, plan.rounds)
            width, height = plan.resolution
            seconds[plan.engine] = {
                name: sample_seconds(timing, plan.many) / (width * height) for name, timing in timings.items()
            }
    return ShadingResult(seconds)


def _contestant(scene, name, put_on, many):
    return Contestant(
        name, {"put on": put_on, "few": lambda _: _render(scene, _FEW), "many": lambda _: _render(scene, many)}
    )


def sample_seconds(timing: Timing, many: int) -> float:
    """What a sample adds to a picture, s."""
    return (timing.part("many") - timing.part("few")) / (many - _FEW)


def build():
    """A scene with an ocean, and for each material a function that puts it on."""
    import bpy

    from ... import register
    from ...scene import ocean_object, shot_scene

    if not hasattr(bpy.types.Object, "ocean_lod"):
        register()
    scene = bpy.data.scenes.new("bench")
    scene.render.resolution_x, scene.render.resolution_y = 16, 9
    scene.render.resolution_percentage = 100
    render.set_engine(scene, "CYCLES")
    render.set_samples(scene, _FEW)
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    shot_scene.build(scene, Shot())
    ob = ocean_object.create(scene, Sea(), _GRID, MaterialSettings())
    scene.collection.objects.link(ob)
    materials = _materials(ob)

    def putting_on(material):
        return lambda _: ob.data.materials.__setitem__(0, material)

    return scene, {name: putting_on(material) for name, material in materials.items()}


def _materials(ob):
    """By name: plain Glossy, the ocean's material without its ripples, and as it is, where it shows ripples."""
    import bpy

    from ...nodes.material import MATERIAL_KEY
    from ...nodes.ripples_material import RIPPLES_NODE_NAME, hide_ripples

    (ocean,) = ob.data.materials
    glossy = bpy.data.materials.new("bench")
    if glossy.node_tree is None:
        glossy.use_nodes = True
    tree = glossy.node_tree
    tree.nodes.clear()
    closure, output = tree.nodes.new("ShaderNodeBsdfGlossy"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(closure.outputs[0], output.inputs["Surface"])
    if RIPPLES_NODE_NAME not in ocean.node_tree.nodes:
        return {GLOSSY: glossy, WATER: ocean}
    water = ocean.copy()
    hide_ripples(water)
    del water[MATERIAL_KEY]  # so that the frame leaves it as it is
    return {GLOSSY: glossy, WATER: water, RIPPLES: ocean}


def _render(scene, samples):
    import bpy

    render.set_samples(scene, samples)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "picture.png")
        bpy.ops.render.render(scene=scene.name)
