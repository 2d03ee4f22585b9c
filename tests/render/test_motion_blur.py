# SPDX-License-Identifier: GPL-3.0-or-later
"""A steep crest that runs past while the shutter is open smears by its speed times that time.

One wave, seen from straight above by an orthographic camera, white where it is above the mean level and black
below: the edge runs with the wave's flank. A pixel on its way is white for the share of the time that the flank
has passed it. Across the crest the white share thus ramps over speed times shutter, and its slope is a box of that
width, with variance width^2 / 12, which adds to that of the picture without blur.
"""

import math

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.scene import ocean_object
from tests.fresh_ocean import fresh_ocean

from .exr import read_pixels

FRAMES_PER_SECOND = 24
SHUTTER = 1.0  # frames
PIXELS, SEEN = 24, 1.2  # m; 0.05 m each, for a smear of 0.4 m
STEPS = 8  # instants that EEVEE renders; between them it smears pictures along the motion


@pytest.fixture
def crest(tmp_path):
    """The scene, the ocean and its one steep wave."""
    ocean, scene = fresh_ocean(cells=32, levels=1, cell_size=0.5)
    settings = ocean.ocean_lod
    settings.ripples.kind, settings.effects.foam = "off", "off"
    system = settings.sea.systems[0]
    settings.sea.wave_count = settings.sea.directions = 1
    system.spectrum, system.sized_by, system.significant_wave_height, system.period = "jonswap", "height", 5.0, 6.0
    asked = ocean_object.read_ocean(ocean, scene)
    waves = discretise(asked.sea, asked.grid.shortest_wavelength)
    assert len(waves) == 1
    assert 0.2 < waves.wavenumber[0] * waves.amplitude[0] < 0.5
    material = bpy.data.materials.new("White")
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    kinds = ("NewGeometry", "SeparateXYZ", "Math", "Emission", "OutputMaterial")
    geometry, separate, above, emission, output = (
        material.node_tree.nodes.new(f"ShaderNode{kind}") for kind in kinds
    )
    above.operation, above.inputs[1].default_value = "GREATER_THAN", 0.0
    links = material.node_tree.links
    links.new(geometry.outputs["Position"], separate.inputs[0])
    links.new(separate.outputs["Z"], above.inputs[0])
    links.new(above.outputs[0], emission.inputs["Strength"])
    links.new(emission.outputs[0], output.inputs["Surface"])
    ocean.data.materials.clear()
    ocean.data.materials.append(material)
    scene.render.fps = FRAMES_PER_SECOND
    scene.render.motion_blur_shutter = SHUTTER
    scene.render.resolution_x, scene.render.resolution_y = PIXELS, 4
    scene.cycles.samples = scene.eevee.taa_render_samples = 32
    scene.cycles.use_denoising = False
    scene.eevee.motion_blur_steps = STEPS
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(tmp_path / "crest.exr")
    _look_at_flank(scene, waves)
    yield scene, ocean, waves
    ocean_lod_addon.unregister()


def _look_at_flank(scene, waves):
    """From above, the picture's x axis along the wave, at the point of the mean level before the crest."""
    k, theta = waves.wavenumber[0], waves.direction[0]
    scene.frame_set(10)
    # Z = A cos(psi), psi = k s + phase, falls through 0 at psi = pi/2; X = s - C A sin(psi) there
    s = math.remainder(math.pi / 2 - waves.phase_at(10 / FRAMES_PER_SECOND)[0], 2.0 * math.pi) / k
    flank = s - waves.orbit_ratio[0] * waves.amplitude[0]
    data = bpy.data.cameras.new("Camera")
    data.type, data.ortho_scale = "ORTHO", SEEN
    camera = bpy.data.objects.new("Camera", data)
    camera.location = (flank * math.cos(theta), flank * math.sin(theta), 20.0)
    camera.rotation_euler = (0.0, 0.0, theta)
    scene.collection.objects.link(camera)
    scene.camera = camera


def edge_variance(scene):
    """Variance in m^2 of the slope of the white share along the picture's middle rows."""
    bpy.ops.render.render(write_still=True)
    white = read_pixels(scene.render.filepath)[1:3, :, 0].mean(axis=0).astype(np.float64)
    assert white.max() == pytest.approx(1.0, abs=0.02)
    assert white.min() == pytest.approx(0.0, abs=0.02)
    slope = np.abs(np.diff(white))
    slope[slope < 0.002] = 0.0  # the noise of what is all white
    x = np.arange(len(slope)) * (SEEN / PIXELS)
    mean = (slope * x).sum() / slope.sum()
    return float((slope * (x - mean) ** 2).sum() / slope.sum())


@pytest.mark.render
@pytest.mark.parametrize(("engine", "velocity"), [("CYCLES", "on"), ("CYCLES", "off"), ("EEVEE", "auto")])
def test_blur_is_speed_times_shutter(crest, engine, velocity):
    """From the water's velocity in Cycles, and from the instants of the shutter in both engines."""
    scene, ocean, waves = crest
    ocean.ocean_lod.effects.velocity = velocity
    if engine == "EEVEE":
        offered = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
        engine = next(name for name in offered if name.startswith("BLENDER_EEVEE"))
    scene.render.engine = engine
    scene.render.use_motion_blur = False
    sharp = edge_variance(scene)
    assert ("velocity" in ocean.data.attributes) == (velocity == "on")
    assert math.sqrt(12.0 * sharp) < 4.0 * SEEN / PIXELS, "nothing is blurred but by the pixel filter"
    scene.render.use_motion_blur = True
    blurred = edge_variance(scene)
    speed = waves.angular_frequency[0] / waves.wavenumber[0]
    width = math.sqrt(12.0 * (blurred - sharp))
    assert width == pytest.approx(speed * SHUTTER / FRAMES_PER_SECOND, rel=0.05)
