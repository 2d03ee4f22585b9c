# SPDX-License-Identifier: GPL-3.0-or-later
"""An ocean in Blender: its vertices after frame changes, and what the handler does when something is wrong."""

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.waves import WaveSet
from ocean_lod_addon.core.windows import window, window_reach
from ocean_lod_addon.scene import mesh as mesh_arrays
from ocean_lod_addon.scene import ocean_object
from tests.core.plane_tiles import tiles

CELLS, LEVELS = 64, 5


@pytest.fixture
def ocean():
    """An ocean added through the operator, in an otherwise empty scene."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    added = bpy.ops.mesh.ocean_lod_add(preset="moderate", cells=CELLS, levels=LEVELS, cell_size=0.25)
    assert added == {"FINISHED"}
    yield bpy.context.object
    ocean_lod_addon.unregister()


def surface_of(ob):
    return ocean_object._surface(ocean_object.read_ocean(ob, bpy.context.scene))


def vertices_by_api(ob):
    """Vertex positions through Blender's ordinary, slow interface."""
    return np.array([vertex.co for vertex in ob.data.vertices], dtype=np.float64)


def expected_positions(ob, time):
    """The direct float64 sum (core.gerstner) at some vertices of every tile, and those vertices' numbers."""
    surface = surface_of(ob)
    grid, waves = surface.ocean.grid, surface.waves
    reach = window_reach(grid, waves.wavelength)
    numbers, expected = [], []
    for _, tile in tiles(grid):
        lines = grid.lines(tile.level)
        rows, columns = tile.shape
        for row, column in ((0, 0), (rows // 2, columns // 3), (rows - 1, columns - 1)):
            x, y = lines[tile.row_start + row], lines[tile.column_start + column]
            here = WaveSet(
                waves.amplitude * window(abs(x), reach) * window(abs(y), reach),
                waves.wavenumber,
                waves.angular_frequency,
                waves.direction,
                waves.phase,
                waves.orbit_ratio,
                waves.system,
            )
            numbers.append(tile.first_vertex + row * tile.stride + column)
            expected.append(surface_points(here, x, y, time).position)
    return np.array(numbers), np.array(expected)


@pytest.mark.parametrize(("frame", "subframe"), [(1, 0.0), (7, 0.5), (24, 0.25), (-500, 0.0), (1_000_000, 0.0)])
def test_vertices_equal_the_direct_sum_at_every_level(ocean, frame, subframe):
    """Sea time is frame / fps. The tolerance is 2e-6 of the significant height, and five float32
    roundings of a coordinate, which tests/core/test_kernel.py explains.
    """
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = 24, 1.0
    scene.frame_set(frame, subframe=subframe)
    numbers, expected = expected_positions(ocean, (frame + subframe) / 24.0)
    waves = surface_of(ocean).waves
    significant_height = 4 * np.sqrt(0.5 * np.sum(waves.amplitude**2))
    rounding = 5 * 0.5 * np.spacing(np.abs(expected).astype(np.float32))
    error = np.abs(vertices_by_api(ocean)[numbers] - expected)
    assert (error <= 2e-6 * significant_height + rounding).all()


def test_frame_rate_and_time_remapping_set_the_clock(ocean):
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = 30, 1.001
    scene.render.frame_map_old, scene.render.frame_map_new = 100, 200
    scene.frame_set(60)
    numbers, expected = expected_positions(ocean, 60 * 0.5 * 1.001 / 30)
    assert np.abs(vertices_by_api(ocean)[numbers] - expected).max() < 1e-4


def test_keyed_settings_are_followed(ocean):
    scene = bpy.context.scene
    clock = ocean.ocean_lod.time
    clock.source = "KEYED"
    for frame, time in ((1, 0.0), (11, 50.0)):
        clock.time = time
        clock.keyframe_insert("time", frame=frame)
    scene.frame_set(11)
    numbers, expected = expected_positions(ocean, 50.0)
    assert np.abs(vertices_by_api(ocean)[numbers] - expected).max() < 1e-4


def test_the_mesh_is_valid_and_smooth(ocean):
    assert not ocean.data.validate(verbose=True), "Blender found something to repair"
    assert all(polygon.use_smooth for polygon in ocean.data.polygons)


def test_add_operator_can_be_undone_and_redone(ocean):
    bpy.ops.ed.undo_push(message="before")
    count = len(bpy.data.objects)
    bpy.ops.mesh.ocean_lod_add(preset="calm", cells=16, levels=2)
    bpy.ops.ed.undo_push(message="added")
    assert len(bpy.data.objects) == count + 1
    bpy.ops.ed.undo()
    assert len(bpy.data.objects) == count
    bpy.ops.ed.redo()
    assert len(bpy.data.objects) == count + 1


def _set_wind(ob):
    ob.ocean_lod.sea.systems[0].wind_speed = 14.0


def _set_direction(ob):
    ob.ocean_lod.sea.systems[0].direction = 1.0


def _set_time(ob):
    ob.ocean_lod.time.source, ob.ocean_lod.time.time = "KEYED", 100.0


@pytest.mark.parametrize("change", [_set_wind, _set_direction, _set_time])
def test_settings_rebuild_only_what_they_change(ocean, monkeypatch, change):
    """Wind, its direction and the time move the vertices of a mesh that stays; time leaves the waves, too."""
    built = []
    monkeypatch.setattr(mesh_arrays, "build_topology", lambda *_: built.append("mesh"))
    polygons_before, surface = ocean.data.polygons[0].as_pointer(), surface_of(ocean)
    vertices_before = mesh_arrays.read_positions(ocean.data)
    change(ocean)
    assert not built
    assert ocean.data.polygons[0].as_pointer() == polygons_before, "the same mesh"
    assert not np.array_equal(mesh_arrays.read_positions(ocean.data), vertices_before)
    assert (surface_of(ocean) is surface) == (change is _set_time)


def test_another_plane_is_another_mesh(ocean):
    vertices_before = len(ocean.data.vertices)
    ocean.ocean_lod.grid.levels = LEVELS + 1
    assert len(ocean.data.vertices) == surface_of(ocean).vertex_count > vertices_before


def test_hidden_oceans_are_not_evaluated(ocean):
    scene = bpy.context.scene
    scene.frame_set(1)
    before = mesh_arrays.read_positions(ocean.data)
    ocean.hide_viewport = True
    scene.frame_set(50)
    assert np.array_equal(mesh_arrays.read_positions(ocean.data), before)
    ocean.hide_viewport = False
    scene.frame_set(51)
    assert not np.array_equal(mesh_arrays.read_positions(ocean.data), before)


def test_a_broken_ocean_reports_once_stays_still_and_stops_no_other(ocean, capfd):
    scene = bpy.context.scene
    bpy.ops.mesh.ocean_lod_add(preset="calm", cells=16, levels=2)
    sound = bpy.context.object
    broken = ocean
    broken.data.clear_geometry()
    for frame in (10, 11, 12):
        scene.frame_set(frame)
    assert capfd.readouterr().err.count(f"Ocean LOD: {broken.name} stays still") == 1
    assert "0 vertices" in ocean_object.problem(broken)
    numbers, expected = expected_positions(sound, 12 / 24)
    assert np.abs(vertices_by_api(sound)[numbers] - expected).max() < 1e-4
    broken.ocean_lod.sea.seed = 5
    assert ocean_object.problem(broken) == ""
    assert len(broken.data.vertices) == surface_of(broken).vertex_count


def test_the_handler_survives_loading_a_file_and_goes_with_the_extension(ocean, tmp_path):
    path = str(tmp_path / "ocean.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    ob = next(ob for ob in bpy.data.objects if ocean_object.is_ocean(ob))
    bpy.context.scene.frame_set(33)
    numbers, expected = expected_positions(ob, 33 / 24)
    assert np.abs(vertices_by_api(ob)[numbers] - expected).max() < 1e-4
    ours = [handler for handler in bpy.app.handlers.frame_change_post if "ocean_lod" in handler.__module__]
    assert len(ours) == 1
    ocean_lod_addon.unregister()
    assert not [h for h in bpy.app.handlers.frame_change_post if "ocean_lod" in h.__module__]
    ocean_lod_addon.register()
