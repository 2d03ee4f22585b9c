# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat water with ripples, and pictures of what the ripples' node group makes of it, without any light."""

import bpy
import numpy as np

from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.plan import REST_POSITION_ATTRIBUTE, RIPPLE_AMPLITUDE_ATTRIBUTE
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.ripples.bump import Bump
from ocean_lod_addon.core.sea import Sea
from ocean_lod_addon.nodes.groups import ensure_group
from ocean_lod_addon.nodes.ripple_parts import PIXEL_PROPERTY
from ocean_lod_addon.nodes.ripples_group import ripples_recipe, variance_socket
from ocean_lod_addon.scene.ripple_images import ensure_images, write_images

SCALE, OFFSET = 2.0, 0.5
"""A picture holds OFFSET + value / SCALE, since EEVEE shows nothing negative."""


class FlatRipples:
    """The scene: a square of flat water `size` m wide that the mesh leaves wholly to the bump."""

    def __init__(self, settings: Ripples, sea: Sea, grid: Grid, size: float, unresolved=(0.0, 0.0, 0.0), time=0.0):
        self.scene = bpy.context.scene
        self.bump = Bump(settings, sea, grid, discretise(sea, grid.shortest_wavelength))
        self.images = ensure_images("Water", self.bump.layout)
        write_images(self.images, self.bump, time)
        self.unresolved = unresolved
        self._add_water(size)
        self._add_material()
        self.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        self.camera.data.clip_end = 1e5
        self.scene.collection.objects.link(self.camera)
        self.scene.camera = self.camera
        self.scene.render.resolution_percentage = 100
        self.scene.view_settings.view_transform = "Raw"

    def _add_water(self, size):
        half = 0.5 * size
        corners = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
        mesh = bpy.data.meshes.new("Water")
        mesh.from_pydata([(*corner, 0.0) for corner in corners], [], [(0, 1, 2, 3)])
        rest = mesh.attributes.new(REST_POSITION_ATTRIBUTE, "FLOAT2", "POINT")
        rest.data.foreach_set("vector", corners.astype(np.float32).ravel())
        for number in range(-(-self.bump.layout.handed_over // 4)):
            amplitude = mesh.attributes.new(f"{RIPPLE_AMPLITUDE_ATTRIBUTE}{number}", "FLOAT_COLOR", "POINT")
            amplitude.data.foreach_set("color", np.ones(16, np.float32))
        self.water = bpy.data.objects.new("Water", mesh)
        self.scene.collection.objects.link(self.water)
        self.set_pixel(0.0, 0.0)

    def set_pixel(self, angle: float, size: float):
        """Width of a pixel: an angle in rad, a size in m."""
        self.water[PIXEL_PROPERTY] = (angle, size, 0.0)
        self.water.update_tag()

    def _add_material(self):
        material = bpy.data.materials.new("Water")
        if material.node_tree is None:
            material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        self.node = tree.nodes.new("ShaderNodeGroup")
        self.node.node_tree = ensure_group(ripples_recipe("Ripples", self.bump.layout, self.images))
        for index, tensor in enumerate(self.bump.tensors):
            self.node.inputs[variance_socket(index).name].default_value = tuple(map(float, tensor))
        self.node.inputs["Slope Variance"].default_value = self.unresolved
        normal = tree.nodes.new("ShaderNodeSeparateXYZ")
        trace = tree.nodes.new("ShaderNodeVectorMath")
        trace.operation = "DOT_PRODUCT"
        trace.inputs[1].default_value = (1.0, 1.0, 0.0)
        shown = tree.nodes.new("ShaderNodeCombineXYZ")
        tree.links.new(self.node.outputs["Normal"], normal.inputs[0])
        tree.links.new(self.node.outputs["Slope Variance"], trace.inputs[0])
        for index, output in enumerate((*normal.outputs[:2], trace.outputs["Value"])):
            tree.links.new(output, shown.inputs[index])
        encode = tree.nodes.new("ShaderNodeVectorMath")
        encode.operation = "MULTIPLY_ADD"
        encode.inputs[1].default_value = (1.0 / SCALE,) * 3
        encode.inputs[2].default_value = (OFFSET,) * 3
        tree.links.new(shown.outputs[0], encode.inputs[0])
        emission = tree.nodes.new("ShaderNodeEmission")
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        tree.links.new(encode.outputs[0], emission.inputs["Color"])
        tree.links.new(emission.outputs[0], output.inputs["Surface"])
        self.water.data.materials.append(material)

    def look_down(self, width: float, pixels: int):
        """From straight above, orthographic, on a square of this width in m."""
        self.camera.data.type, self.camera.data.ortho_scale = "ORTHO", width
        self.camera.location, self.camera.rotation_euler = (0.0, 0.0, 100.0), (0.0, 0.0, 0.0)
        self.scene.render.resolution_x = self.scene.render.resolution_y = pixels

    def render(self, engine: str, path) -> tuple[np.ndarray, np.ndarray]:
        """Slopes (rows, columns, 2), and the trace of the slope variance left to the BRDF, (rows, columns).

        Rows go upwards; each pixel has one sample in its middle.
        """
        scene = self.scene
        scene.render.engine = engine
        scene.cycles.samples, scene.cycles.use_adaptive_sampling, scene.cycles.use_denoising = 1, False, False
        scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 0.01
        scene.eevee.taa_render_samples, scene.render.filter_size = 1, 0.01
        settings = scene.render.image_settings
        settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(str(path))
        pixels = np.empty(image.size[0] * image.size[1] * image.channels, np.float32)
        image.pixels.foreach_get(pixels)
        picture = pixels.reshape(image.size[1], image.size[0], -1)[:, :, :3].astype(np.float64)
        bpy.data.images.remove(image)
        x, y, left = np.moveaxis((picture - OFFSET) * SCALE, -1, 0)
        return np.stack([-x, -y], axis=-1) / np.sqrt(1.0 - x * x - y * y)[..., None], left


def eevee() -> str:
    """EEVEE's name in this Blender."""
    return "BLENDER_EEVEE_NEXT" if bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"
