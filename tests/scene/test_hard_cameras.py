# SPDX-License-Identifier: GPL-3.0-or-later
"""Every camera that a shot can have: all water in its frame moves, is as fine as the plane can be, and is its own.

The frame is Blender's own `world_to_camera_view`, which knows nothing of tiles and planes; where the water should
be is what the same ocean does when every tile of it moves.
"""

import math

import bpy
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

import ocean_lod_addon
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene import ocean_object, placing

CELL = 0.5
ALL_AROUND = None


@pytest.fixture
def shot():
    """An ocean that reaches 4 km, and a camera over it that looks along x."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    bpy.ops.mesh.ocean_lod_add(preset="moderate", cells=128, levels=8, cell_size=CELL)
    ocean, scene = bpy.context.object, bpy.context.scene
    ocean.ocean_lod.ripples.kind = "off"
    ocean.ocean_lod.effects.analytic_normals = "off"
    camera = new_camera(scene, "Camera")
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.render.resolution_x, scene.render.resolution_y = 32, 18
    scene.frame_set(10)
    yield ocean, camera, scene
    ocean_lod_addon.unregister()


def new_camera(scene, name, x=0.0, height=5.0, pitch=10.0):
    """A camera at (x, 0, height) that looks along x, `pitch` degrees down."""
    camera = bpy.data.objects.new(name, bpy.data.cameras.new(name))
    camera.location = (x, 0.0, height)
    camera.data.clip_end = 1e5
    look(camera, pitch)
    scene.collection.objects.link(camera)
    return camera


def look(camera, pitch):
    camera.rotation_euler = (math.radians(90.0 - pitch), 0.0, math.radians(-90.0))


def rendered(ocean, scene, **animation):
    """Vertices as a picture of the current frame was rendered with them."""
    seen = []

    def watch(*_):
        seen.append(mesh_arrays.read_positions(ocean.data))

    bpy.app.handlers.render_post.append(watch)
    try:
        bpy.ops.render.render(**animation)
    finally:
        bpy.app.handlers.render_post.remove(watch)
    return seen[-1]


def rendered_whole(ocean, scene):
    """The same with every tile moving."""
    ocean.ocean_lod.framing.only_in_view = False
    try:
        return rendered(ocean, scene)
    finally:
        ocean.ocean_lod.framing.only_in_view = True


def in_frame(ocean, scene, camera, positions):
    """Which vertices Blender's own projection puts into the camera's frame."""
    if camera.data.type == "PANO":
        return np.ones(len(positions), bool)
    bpy.context.view_layer.update()
    matrix = ocean.matrix_world
    views = np.array([world_to_camera_view(scene, camera, matrix @ Vector(point)) for point in positions])
    inside = (views[:, :2] >= 0.0).all(axis=1) & (views[:, :2] <= 1.0).all(axis=1)
    return inside & (views[:, 2] > 0.0) if camera.data.type == "PERSP" else inside


def lens(millimetres):
    return lambda camera: setattr(camera.data, "lens", millimetres)


def orthographic(camera):
    camera.data.type, camera.data.ortho_scale = "ORTHO", 60.0


def panoramic(camera):
    camera.data.type = "PANO"


CAMERAS = {
    "standing": (5.0, 10.0, lens(35.0)),
    "under water, looking up": (-6.0, -30.0, lens(35.0)),
    "under water, looking along": (-6.0, 0.0, lens(35.0)),
    "inside a wave": (0.2, 0.0, lens(35.0)),
    "straight down from 10 km": (10e3, 90.0, lens(50.0)),
    "8 mm": (5.0, 10.0, lens(8.0)),
    "1200 mm": (20.0, 1.5, lens(1200.0)),
    "orthographic": (40.0, 35.0, orthographic),
    "orthographic, straight down": (40.0, 90.0, orthographic),
    "panoramic": (5.0, 0.0, panoramic),
    "tilted beyond the horizon": (5.0, -5.0, lens(20.0)),
}


@pytest.mark.parametrize("name", CAMERAS)
def test_all_water_in_the_frame_moves(shot, name):
    """Culled and whole renders agree in every vertex in frame, to the rounding of a BLAS that may add up small
    products in another order. A tile that was left flat by mistake would miss by the height of its waves."""
    ocean, camera, scene = shot
    height, pitch, kind = CAMERAS[name]
    camera.location.z = height
    look(camera, pitch)
    kind(camera)
    culled, whole = rendered(ocean, scene), rendered_whole(ocean, scene)
    assert ocean_object.problem(ocean) == ""
    inside = in_frame(ocean, scene, camera, whole)
    assert inside.sum() > 20
    rounding = 5 * np.spacing(np.abs(whole[inside]).astype(np.float32)) + 1e-5
    assert (np.abs(culled[inside] - whole[inside]) <= rounding).all()


@pytest.mark.parametrize("kind", [lens(35.0), orthographic], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("metres_per_unit", [0.01, 1000.0])
def test_all_water_in_the_frame_moves_in_other_units(shot, metres_per_unit, kind):
    """The same shot in centimetres and in kilometres: the ocean's object is scaled, its mesh is not.

    The plane stands under the camera, 300 m along x, and the same vertices move as in metres.
    """
    ocean, camera, scene = shot
    camera.location = (300.0, 0.0, 40.0)
    look(camera, 35.0)
    kind(camera)
    in_metres = rendered(ocean, scene)
    scene.unit_settings.scale_length = metres_per_unit
    ocean.scale = (1.0 / metres_per_unit,) * 3
    camera.location /= metres_per_unit
    camera.data.ortho_scale /= metres_per_unit
    found = rendered(ocean, scene)
    assert ocean_object.problem(ocean) == ""
    assert 0.2 < np.mean(in_metres[:, 2] == 0.0) < 0.95, "culling leaves some of it flat"
    assert np.array_equal(found[:, 2] == 0.0, in_metres[:, 2] == 0.0)
    assert np.abs(found - in_metres).max() < 1e-3


def test_a_long_lens_neither_flattens_nor_coarsens_the_waves(shot):
    """1200 mm, 20 m up, looks at water 750 m away. There a plane centred below the camera has cells of 16 m and
    waves over 64 m; centred where the lens looks it has its finest cells and all of its waves."""
    ocean, camera, scene = shot
    camera.location.z = 20.0
    look(camera, 1.5)
    camera.data.lens = 1200.0
    positions = rendered(ocean, scene)
    inside = in_frame(ocean, scene, camera, positions)
    seen = positions[inside]
    assert 600.0 < seen[:, 0].mean() < 1200.0
    across = np.sort(seen[np.abs(seen[:, 0] - np.median(seen[:, 0])) < CELL, 1])
    assert np.median(np.diff(across)) < 2.0 * CELL
    waves = ocean_object._surface(ocean_object.read_ocean(ocean, scene)).waves
    deviation = math.sqrt(0.5 * float(np.sum(waves.amplitude**2)))
    assert seen[:, 2].std() > 0.5 * deviation, "a patch a few waves wide has most of their height"


def middle_of(positions):
    """x of the middle of the plane, m."""
    return float(0.5 * (positions[:, 0].min() + positions[:, 0].max()))


def test_a_cut_moves_the_plane_to_the_other_camera_in_its_own_frame(shot):
    """Markers cut from a camera at the origin to one 2 km away in frame 11.

    In any order of frames the plane stands under the frame's own camera: in the viewport, where Blender switches
    cameras after the handlers have run, and in renders with motion blur, at all instants of a shutter that reaches
    from the last frame before the cut into the first one after it.
    """
    ocean, camera, scene = shot
    other = new_camera(scene, "Other", x=2000.0)
    scene.timeline_markers.new("First", frame=1).camera = camera
    scene.timeline_markers.new("Cut", frame=11).camera = other
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    scene.render.motion_blur_position = "START"
    seen = {}

    def watch(scene, _depsgraph):
        seen[scene.frame_current + scene.frame_subframe] = middle_of(mesh_arrays.read_positions(ocean.data))

    outermost = CELL * 2**7
    for frame, expected in ((10, 0.0), (11, 2000.0), (10, 0.0), (0, 0.0)):
        scene.frame_set(frame)
        assert abs(middle_of(mesh_arrays.read_positions(ocean.data)) - expected) <= outermost
        bpy.app.handlers.frame_change_post.append(watch)
        middle = middle_of(rendered(ocean, scene))
        bpy.app.handlers.frame_change_post.remove(watch)
        assert abs(middle - expected) <= outermost
        assert {float(frame), frame + 0.5, frame + 1.0} <= seen.keys()
        assert max(abs(x - expected) for x in seen.values()) <= outermost
        seen.clear()


def test_an_animated_focal_length_is_followed(shot):
    """A zoom from 20 mm to 1200 mm: during a render only the evaluated camera has the lens of its frame."""
    ocean, camera, scene = shot
    camera.location.z = 20.0
    look(camera, 1.5)
    for frame, millimetres in ((1, 20.0), (2, 1200.0)):
        camera.data.lens = millimetres
        camera.data.keyframe_insert("lens", frame=frame)
    middles = []
    for frame in (1, 2):
        scene.frame_start = scene.frame_end = frame
        scene.frame_set(7)
        middles.append(middle_of(rendered(ocean, scene, animation=True)))
    assert middles[0] < 200.0, "a wide lens sees the water near the camera"
    assert middles[1] > 500.0, "a long one the water far away"


def test_scenes_keep_to_their_own_frames(shot):
    """Two scenes, an ocean each: a frame change in one leaves the other as it is."""
    ocean, _, scene = shot
    before = mesh_arrays.read_positions(ocean.data)
    second = bpy.data.scenes.new("Second")
    with bpy.context.temp_override(scene=second, view_layer=second.view_layers[0]):
        bpy.ops.mesh.ocean_lod_add(preset="calm", cells=16, levels=2)
    (other,) = (ob for ob in second.collection.all_objects if ocean_object.is_ocean(ob))
    first_frame = mesh_arrays.read_positions(other.data)
    second.frame_set(40)
    assert np.array_equal(mesh_arrays.read_positions(ocean.data), before)
    moved = mesh_arrays.read_positions(other.data)
    assert not np.array_equal(moved, first_frame)
    scene.frame_set(12)
    assert np.array_equal(mesh_arrays.read_positions(other.data), moved)
    assert not np.array_equal(mesh_arrays.read_positions(ocean.data), before)


def test_every_view_layer_shows_the_frame_s_surface(shot):
    """Of two view layers only the second shows the ocean: rendering both still moves it to the frame."""
    ocean, _, scene = shot
    for collection in list(ocean.users_collection):
        collection.objects.unlink(ocean)
    water = bpy.data.collections.new("Water")
    scene.collection.children.link(water)
    water.objects.link(ocean)
    first = scene.view_layers[0]
    second = scene.view_layers.new("Water only")
    first.layer_collection.children["Water"].exclude = True
    second.layer_collection.children["Water"].exclude = False
    ocean.ocean_lod.framing.only_in_view = False
    scene.frame_start = scene.frame_end = 33
    found = rendered(ocean, scene, animation=True)
    expected = np.empty_like(found)
    surface = ocean_object._surface(ocean_object.read_ocean(ocean, scene))
    view = placing.camera_view(ocean, scene)
    surface.positions(33 / 24, surface.placement(view, final=True), expected)
    assert np.array_equal(found, expected)
