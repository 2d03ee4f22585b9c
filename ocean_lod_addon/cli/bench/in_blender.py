# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured in Blender: our frame update up to the evaluated object, and Blender's own Ocean modifier.

Each object has a scene of its own, so that evaluating its view layer evaluates nothing else.
"""

import importlib.util
from dataclasses import dataclass

import numpy as np

from ...core.lod import Grid, undisturbed_positions
from ...core.material_settings import MaterialSettings
from ...core.sea import Sea
from .timing import FRAMES_PER_SECOND, Contestant
from .workloads import Frame

DEPSGRAPH = "depsgraph"
"""The part of a frame in which Blender evaluates the object."""

WRITE = "write"
"""The part of a frame that puts the positions into the mesh."""

# Side of the plane in cells -> (resolution, repeats) of an Ocean modifier that generates as many vertices.
GENERATE_SETTINGS = {128: (8, 2), 256: (16, 1), 512: (16, 2), 1024: (32, 1), 2048: (32, 2)}

DISPLACE_CELLS, _DISPLACE_RESOLUTION = 1024, 32
"""Side of a plane in cells, and the resolution of an Ocean modifier with one sample for each of its vertices."""


def is_available() -> bool:
    """Whether this Python has Blender's module."""
    return importlib.util.find_spec("bpy") is not None


def version() -> str:
    """Blender's version."""
    import bpy

    return bpy.app.version_string


@dataclass(frozen=True)
class _InScene:
    """An object alone in a scene."""

    ob: object
    scene: object

    def evaluate(self, _time=None):
        """Let Blender evaluate what has changed."""
        self.scene.view_layers[0].update()

    def evaluated_vertices(self):
        """Number of vertices after the modifiers."""
        depsgraph = self.scene.view_layers[0].depsgraph
        return len(self.ob.evaluated_get(depsgraph).data.vertices)


def fresh_data():
    """A context: what is made in Blender within it is removed after it."""
    from ...scene.fresh_data import fresh_data as context

    return context()


def _new_ocean(sea, grid):
    import bpy

    from ... import register
    from ...scene import ocean_object

    if not hasattr(bpy.types.Object, "ocean_lod"):
        register()
    scene = bpy.data.scenes.new("bench")
    ob = ocean_object.create(scene, sea, grid, MaterialSettings())
    scene.collection.objects.link(ob)
    return _InScene(ob, scene)


_BYTES_OF_ELEMENT = {
    "BOOLEAN": 1,
    "INT": 4,
    "FLOAT": 4,
    "INT32_2D": 8,
    "FLOAT2": 8,
    "FLOAT_VECTOR": 12,
    "FLOAT_COLOR": 16,
}


def mesh_bytes(mesh) -> int:
    """Bytes of a mesh: its topology, positions and attributes."""
    elements = sum(len(a.data) * _BYTES_OF_ELEMENT[a.data_type] for a in mesh.attributes)
    return elements + 4 * (len(mesh.polygons) + 1)  # where each face's corners begin


class OurObject:
    """The object that the extension makes for a grid, whose mesh takes the positions of any kernel on it."""

    def __init__(self, grid: Grid):
        self._placed = _new_ocean(Sea(wave_count=1), grid)

    def frame_parts(self, frame: Frame) -> dict:
        """Surface, writing into the mesh and Blender's evaluation of the object, as parts of a contestant."""
        from ...scene import mesh as mesh_arrays

        mesh = self._placed.ob.data
        return {
            "surface": frame.evaluate,
            WRITE: lambda _: mesh_arrays.write_positions(mesh, frame.positions),
            DEPSGRAPH: self._placed.evaluate,
        }

    def mesh_bytes(self) -> int:
        """Bytes of the mesh: its topology, positions and attributes."""
        return mesh_bytes(self._placed.ob.data)


def menu_ocean() -> Contestant:
    """The ocean that Add > Mesh makes, moved by the function that the frame-change handler calls."""
    from ...scene import ocean_object

    placed = _new_ocean(Sea(), Grid())
    placed.evaluate()
    scene = placed.scene
    depsgraph = scene.view_layers[0].depsgraph

    def handler(time):
        # The number of the frame alone: frame_set would call the handlers of every ocean, and time them here.
        scene.frame_current = round(FRAMES_PER_SECOND * time)
        ocean_object.update(placed.ob, scene, depsgraph)

    return Contestant("menu ocean", {"handler": handler, DEPSGRAPH: placed.evaluate})


def writing_images(contestant: Contestant, pixels: list[np.ndarray]) -> Contestant:
    """The contestant, whose result `pixels` is written into images of Blender as well."""
    import bpy

    sides = [len(each) for each in pixels]
    images = [bpy.data.images.new("bench", side, side, alpha=True, float_buffer=True) for side in sides]

    def write(_time):
        for image, each in zip(images, pixels, strict=True):
            image.pixels.foreach_set(each.ravel())
            image.update_tag()

    return Contestant(contestant.name, {**contestant.parts, WRITE: write})


def ocean_modifier(name: str, mode: str, cells: int) -> Contestant:
    """Blender's Ocean modifier with (cells + 1)^2 vertices; `mode` is GENERATE or DISPLACE."""
    import bpy

    mesh = bpy.data.meshes.new("bench")
    if mode == "DISPLACE":
        resolution, repeats = _DISPLACE_RESOLUTION, 1
        _build_flat_plane(mesh, cells)
    else:
        resolution, repeats = GENERATE_SETTINGS[cells]
    scene = bpy.data.scenes.new("bench")
    placed = _InScene(bpy.data.objects.new("bench", mesh), scene)
    scene.collection.objects.link(placed.ob)
    modifier = placed.ob.modifiers.new("bench", "OCEAN")
    modifier.geometry_mode = mode
    modifier.resolution = modifier.viewport_resolution = resolution
    modifier.repeat_x = modifier.repeat_y = repeats
    placed.evaluate()
    vertices = placed.evaluated_vertices()
    if vertices != (cells + 1) ** 2:
        raise RuntimeError(f"the Ocean modifier has {vertices} vertices instead of {(cells + 1) ** 2}")

    def evaluate(time):
        modifier.time = time
        placed.evaluate()

    return Contestant(name, {"modifier": evaluate})


def _build_flat_plane(mesh, cells):
    """A plane as large as the modifier's own sea, 50 m."""
    from ...scene import mesh as mesh_arrays

    grid = Grid(cell_size=50.0 / cells, cells=cells, levels=1)
    mesh_arrays.build_topology(mesh, grid)
    flat = np.zeros((grid.vertex_count, 3), np.float32)
    flat[:, :2] = undisturbed_positions(grid, np.zeros((1, 2)))
    mesh_arrays.write_positions(mesh, flat)
