# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of ripples in Blender are those of the scene's instant, and of nothing else."""

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.ocean import Surface
from ocean_lod_addon.scene import ocean_object, planning
from ocean_lod_addon.scene.ripple_images import IMAGE_KEY
from tests.fresh_ocean import fresh_ocean
from tests.render.exr import read_pixels

FRAMES_PER_SECOND = 2
INSTANTS = ((10, 0.5), (10, 0.0), (-3, 0.75))


@pytest.fixture
def ocean():
    ocean, scene = fresh_ocean(cells=16, levels=3, cell_size=0.5)
    ocean.ocean_lod.ripples.resolution, ocean.ocean_lod.ripples.shortest_wavelength = "256", 0.05
    scene.render.fps, scene.render.fps_base = FRAMES_PER_SECOND, 1.0
    yield ocean
    ocean_lod_addon.unregister()


def ripple_images():
    """The images of the ocean's ripples, from long waves to short."""
    return sorted((image for image in bpy.data.images if IMAGE_KEY in image), key=lambda image: image[IMAGE_KEY])


def pixels_of(image):
    pixels = np.empty((*image.size, 4), np.float32)
    image.pixels.foreach_get(pixels.ravel())
    return pixels


def shown_at(frame, subframe):
    bpy.context.scene.frame_set(frame, subframe=subframe)
    return [pixels_of(image) for image in ripple_images()]


class Core:
    """The images as core makes them, of a surface of its own."""

    def __init__(self, ocean):
        self.bump = Surface(planning.PlannedOcean(ocean, bpy.context.scene).ocean).bump

    def at(self, frame):
        made = []
        for number, tile in enumerate(self.bump.layout.tiles):
            pixels = np.empty((tile.texels, tile.texels, 4), np.float32)
            self.bump.image(number, frame / FRAMES_PER_SECOND, pixels)
            made.append(pixels)
        return made


def test_images_of_a_sub_frame_are_cores_images_of_that_instant(ocean):
    """Truth: time is (frame + sub-frame) / frame rate, exact here, and an image is a function of time alone: bit
    for bit, and in any order of frames."""
    forwards = {instant: shown_at(*instant) for instant in INSTANTS}
    assert ocean_object.problem(ocean) == ""
    core = Core(ocean)
    for (frame, subframe), shown in forwards.items():
        expected = core.at(frame + subframe)
        assert len(shown) == len(expected) > 1
        assert all(np.array_equal(*pair) for pair in zip(shown, expected, strict=True))
    assert not np.array_equal(forwards[10, 0.5][0], forwards[10, 0.0][0])
    for instant in reversed(INSTANTS):
        shown_at(500, 0.0)
        again = shown_at(*instant)
        assert all(a.tobytes() == b.tobytes() for a, b in zip(again, forwards[instant], strict=True))


def show_image(image, path):
    """A camera that sees nothing but an image, each of its pixels in one of the picture's, plus 1."""
    scene = bpy.context.scene
    mesh = bpy.data.meshes.new("Screen")
    corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
    mesh.from_pydata([(*corner, 50.0) for corner in corners], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new().data.foreach_set("uv", (0.5 * np.array(corners) + 0.5).ravel())
    material = bpy.data.materials.new("Screen")
    if material.node_tree is None:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    kinds = ("TexImage", "VectorMath", "Emission", "OutputMaterial")
    texture, shift, emission, output = (nodes.new(f"ShaderNode{kind}") for kind in kinds)
    texture.image, texture.interpolation = image, "Closest"
    shift.inputs[1].default_value = (1.0, 1.0, 1.0)  # nothing below 0 is shown
    for source, target in ((texture, shift), (shift, emission), (emission, output)):
        links.new(source.outputs[0], target.inputs[0])
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("Screen", mesh))
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale, camera.location.z = "ORTHO", 2.0, 60.0
    scene.collection.objects.link(camera)
    scene.camera = camera
    render = scene.render
    render.resolution_x, render.resolution_y = image.size
    render.filter_size = scene.cycles.filter_width = 0.01
    scene.cycles.samples, scene.cycles.use_denoising = 1, False
    scene.view_settings.view_transform = "Raw"
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = str(path)


@pytest.mark.render
def test_cycles_shows_the_images_of_the_frame_whatever_of_its_shutter_it_evaluates(ocean, tmp_path):
    """Truth: the picture of an image is core's image of frame 10, to the rounding of float32, and so is the image
    afterwards; before, Cycles has asked for the instants at which its shutter opens and closes."""
    scene = bpy.context.scene
    show_image(ripple_images()[0], tmp_path / "image.exr")
    scene.render.engine = "CYCLES"
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    scene.frame_set(10)
    instants = set()
    bpy.app.handlers.frame_change_post.append(lambda scene, *_: instants.add(scene.frame_current_final))
    bpy.ops.render.render(write_still=True)
    bpy.app.handlers.frame_change_post.pop()
    assert instants == {9.5, 10.0, 10.5}
    seen = read_pixels(tmp_path / "image.exr")[..., :2] - 1.0
    expected = Core(ocean).at(10)[0]
    assert seen == pytest.approx(expected[..., :2], abs=1e-6)
    assert np.array_equal(pixels_of(ripple_images()[0]), expected)
