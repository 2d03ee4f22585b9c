# SPDX-License-Identifier: GPL-3.0-or-later
"""A flat sea of strips under a sun and a black sky, seen by an orthographic camera.

Each strip has a slope variance of its own and fills one column of the picture; all pixels share one direction of
view, and the sun is a point. What a pixel must show is then a formula of a few numbers, without sampling noise.
"""

import itertools
import math

import bpy
import numpy as np

from ocean_lod_addon.nodes.material import SLOPE_VARIANCE_ATTRIBUTE

STRIP_LENGTH = 2000.0
"""Long enough to fill the picture at one degree above the horizon."""


def direction(elevation_degrees: float, azimuth_degrees: float = 0.0) -> np.ndarray:
    """The unit vector at an elevation and an azimuth (counter-clockwise from +x)."""
    e, a = math.radians(elevation_degrees), math.radians(azimuth_degrees)
    return np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])


def slope_tensor(sigma_major: float, sigma_minor: float, degrees: float = 0.0) -> tuple[float, float, float]:
    """(xx, yy, xy) of slope deviations along and across an axis `degrees` from +x."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    major, minor = sigma_major**2, sigma_minor**2
    return major * c * c + minor * s * s, major * s * s + minor * c * c, (major - minor) * c * s


def mesh_with_variances(material, polygons, tensors):
    """A mesh of separate polygons, each with one slope variance tensor."""
    corners, faces, values = [], [], []
    for polygon, tensor in zip(polygons, tensors, strict=True):
        faces.append(range(len(corners), len(corners) + len(polygon)))
        corners += polygon
        values += list(tensor) * len(polygon)
    mesh = bpy.data.meshes.new("Sea")
    mesh.from_pydata(corners, [], faces)
    attribute = mesh.attributes.new(SLOPE_VARIANCE_ATTRIBUTE, "FLOAT_VECTOR", "POINT")
    attribute.data.foreach_set("vector", np.array(values, np.float32))
    mesh.materials.append(material)
    return mesh


class FlatSea:
    """The scene: strips of a material, one per slope variance tensor, and the picture of them."""

    def __init__(self, material, tensors):
        bpy.context.scene.world = bpy.data.worlds.new("Black")
        self.scene, self.columns = bpy.context.scene, len(tensors)
        self._set_world()
        self._add_strips(material, tensors)
        self.sun = None
        self.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        self.camera.data.type, self.camera.data.clip_end = "ORTHO", 1e4
        self.camera.data.sensor_fit, self.camera.data.ortho_scale = "HORIZONTAL", float(self.columns)
        self.scene.collection.objects.link(self.camera)
        self.scene.camera = self.camera
        self.scene.render.resolution_x, self.scene.render.resolution_y = self.columns, 4
        self.scene.render.resolution_percentage = 100

    def _set_world(self):
        world = self.scene.world
        if world.node_tree is None:
            world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0

    def set_sky(self, radiance: float, falloff: float | None = None):
        """A uniform sky; or one of radiance (1 - falloff sin(elevation)), black below the horizon."""
        tree = self.scene.world.node_tree
        background = tree.nodes["Background"]
        background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        background.inputs["Strength"].default_value = radiance
        if falloff is None:
            return
        coordinates, separate = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
        above, fall, product = (tree.nodes.new("ShaderNodeMath") for _ in range(3))
        above.operation, fall.operation, product.operation = "GREATER_THAN", "MULTIPLY_ADD", "MULTIPLY"
        above.inputs[1].default_value = 0.0
        fall.inputs[1].default_value, fall.inputs[2].default_value = -falloff, 1.0
        tree.links.new(coordinates.outputs["Generated"], separate.inputs[0])
        for node in (above, fall):
            tree.links.new(separate.outputs["Z"], node.inputs[0])
        for index, node in enumerate((above, fall)):
            tree.links.new(node.outputs[0], product.inputs[index])
        tree.links.new(product.outputs[0], background.inputs["Color"])

    def set_physical_sky(self, elevation_degrees: float):
        """Blender's own sky with a sun in front of the camera, the disc itself left out."""
        tree = self.scene.world.node_tree
        background, sky = tree.nodes["Background"], tree.nodes.new("ShaderNodeTexSky")
        sky.sun_disc, sky.sun_elevation = False, math.radians(elevation_degrees)
        sky.sun_rotation = math.radians(90.0)
        tree.links.new(sky.outputs[0], background.inputs["Color"])
        background.inputs["Strength"].default_value = 1.0

    def _add_strips(self, material, tensors):
        edges = 0.5 * len(tensors) - np.arange(len(tensors) + 1)  # from left to right in the picture
        strips = [
            [(x * STRIP_LENGTH, y, 0.0) for x, y in ((-1, left), (-1, right), (1, right), (1, left))]
            for left, right in itertools.pairwise(edges)
        ]
        self.sea = bpy.data.objects.new("Sea", mesh_with_variances(material, strips, tensors))
        self.scene.collection.objects.link(self.sea)

    def look_along_x(self, elevation_degrees: float) -> np.ndarray:
        """See the sea from an elevation, looking along +x; returns the direction to the viewer."""
        to_viewer = direction(elevation_degrees, 180.0)
        self.camera.location = 100.0 * to_viewer
        self.camera.rotation_euler = (math.radians(90.0 - elevation_degrees), 0.0, -math.pi / 2)
        return to_viewer

    def shine(self, to_sun, irradiance: float = 1.0):
        """A point sun in the given direction."""
        if self.sun is None:
            self.sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
            self.sun.data.angle = 0.0
            self.scene.collection.objects.link(self.sun)
        self.sun.data.energy = irradiance
        self.sun.rotation_euler = (0.0, math.acos(to_sun[2]), math.atan2(to_sun[1], to_sun[0]))

    def render_cycles(self, path, samples=1, bounces=1) -> np.ndarray:
        """Linear RGB of each column, shape (columns, 3)."""
        return self.picture_of_cycles(path, samples, bounces).mean(axis=0)

    def render_eevee(self, path, samples=1) -> np.ndarray:
        """Linear RGB of each column, shape (columns, 3)."""
        return self.picture_of_eevee(path, samples).mean(axis=0)

    def picture_of_cycles(self, path, samples=1, bounces=1) -> np.ndarray:
        """Linear RGB of each pixel, shape (rows from below, columns, 3)."""
        cycles = self.scene.cycles
        self.scene.render.engine = "CYCLES"
        cycles.samples, cycles.max_bounces = samples, bounces
        cycles.use_adaptive_sampling = cycles.use_denoising = False
        cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01
        return self._render(path)

    def picture_of_eevee(self, path, samples=1) -> np.ndarray:
        """Linear RGB of each pixel, shape (rows from below, columns, 3)."""
        self.scene.render.engine = "BLENDER_EEVEE_NEXT" if bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"
        self.scene.eevee.taa_render_samples = samples
        self.scene.render.filter_size = 0.01
        return self._render(path)

    def _render(self, path):
        settings = self.scene.render.image_settings
        settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
        self.scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(str(path))
        pixels = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
        image.pixels.foreach_get(pixels)
        picture = pixels.reshape(image.size[1], image.size[0], -1)[:, :, :3].astype(np.float64)
        bpy.data.images.remove(image)
        return picture
