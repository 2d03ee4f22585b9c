# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera sees of the sea, for every kind of camera and place."""

import math

import numpy as np
import pytest

from ocean_lod_addon.core.camera_view import (
    CameraView,
    frame_planes,
    looks_down,
    nearest_visible_water,
    plane_centre,
    visible_tiles,
)
from ocean_lod_addon.core.carried import Carried
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.framing import Framing
from ocean_lod_addon.core.lod import Grid, level_anchors, tile_sizes
from ocean_lod_addon.core.placement import place
from ocean_lod_addon.core.sea import Sea

from .cameras import camera, projected_inside
from .plane_tiles import tiles

GRID = Grid(cell_size=0.1, cells=128, levels=9)


def seen(view, margin=0.0, grid=GRID):
    anchors = level_anchors(grid, plane_centre(grid, view))
    return visible_tiles(grid, anchors, frame_planes(view, margin), anywhere(2.0, grid)), anchors


def anywhere(height, grid):
    """Waves of this height, wherever they are."""
    return Carried(np.zeros((0, 1, 1, 3)), np.full(grid.levels, height), 1.0)


VIEWS = {
    "standing": camera(),
    "looking down from 10 km": camera(10e3, pitch=math.pi / 2 - 1e-9),
    "8 mm": camera(3.0, pitch=0.2, lens=8.0),
    "1200 mm": camera(10.0, pitch=0.01, lens=1200.0),
    "under water": camera(-3.0, pitch=-0.3),
    "inside a wave": camera(0.3, pitch=0.0, heading=2.0),
    "orthographic": camera(50.0, pitch=0.6, lens=40.0, kind="ORTHO", at=(70.0, -30.0)),
    "far away": camera(5.0, pitch=0.05, heading=1.0, at=(1e5, -1e5)),
}


def widened(view, margin):
    """The camera with `margin` rad more on each side of its frame."""
    return CameraView(view.position, view.axes, tuple(np.tan(np.arctan(view.extent) + _SIDES * margin)), view.kind)


_SIDES = np.array([-1, 1, -1, 1])


@pytest.mark.parametrize("margin", [0.0, 0.2])
@pytest.mark.parametrize("name", VIEWS)
def test_no_visible_water_is_left_out(name, margin):
    """Every vertex of the sea, anywhere between its highest and lowest, that projects into the frame widened by
    the margin is in a tile that counts as visible."""
    view = VIEWS[name]
    visible, anchors = seen(view, margin)
    view = view if view.kind == "ORTHO" else widened(view, margin)
    for number, tile in tiles(GRID):
        if visible[number]:
            continue
        lines = GRID.lines(tile.level)
        x, y, z = np.meshgrid(
            lines[tile.row_start : tile.row_stop : 8] + anchors[tile.level, 0],
            lines[tile.column_start : tile.column_stop : 8] + anchors[tile.level, 1],
            [-2.0, 0.0, 2.0],
        )
        points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=-1)
        assert not projected_inside(view, points).any()


def test_most_of_the_plane_is_out_of_frame_for_a_normal_lens():
    """35 mm at eye height sees 54 degrees of 360; tiles and margin make it a third of the vertices at most."""
    grid = Grid(cell_size=0.05, cells=512, levels=9)
    visible, _ = seen(VIEWS["standing"], Framing().view_margin, grid)
    sizes = tile_sizes(grid.cells, grid.levels)
    assert sizes[visible].sum() < sizes.sum() / 3


def test_a_camera_that_looks_up_sees_no_water():
    visible, _ = seen(camera(height=30.0, pitch=-1.0))
    assert not visible.any()


def test_panoramic_cameras_see_everything():
    visible, _ = seen(camera(kind="PANO"))
    assert visible[tile_sizes(GRID.cells, GRID.levels) > 0].all()


def test_nearest_water_ahead_of_a_level_camera():
    """The lowest ray of a frame with half height t sinks t per unit: it meets the water height / t ahead."""
    view = camera(height=2.0)
    assert nearest_visible_water(view) == pytest.approx([2.0 / (18.0 / 35.0 / (16 / 9)), 0.0], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", ["looking down from 10 km", "under water"])
def test_plane_is_centred_below_a_camera_that_sees_below_itself_or_none(name):
    assert plane_centre(GRID, VIEWS[name]) == pytest.approx(VIEWS[name].position[:2])


def test_a_long_lens_has_its_fine_cells_where_it_looks():
    view = VIEWS["1200 mm"]
    nearest = nearest_visible_water(view)
    assert nearest[0] > 300.0
    assert np.abs(plane_centre(GRID, view) - nearest).max() <= GRID.spacing(0) * GRID.cells / 4


def test_placement_culls_only_final_pictures_that_allow_it():
    waves = discretise(Sea(), GRID.shortest_wavelength)
    view = VIEWS["standing"]
    assert place(GRID, Framing(), waves, view, final=False).visible is None
    assert place(GRID, Framing(only_in_view=False), waves, view, final=True).visible is None
    assert place(GRID, Framing(), waves, None, final=True).visible is None
    assert not place(GRID, Framing(), waves, view, final=True).visible.all()
    assert not place(GRID, Framing(), waves, camera(30.0, pitch=-1.4), final=True).sees_water
    assert (place(GRID, Framing(centre="PINNED"), waves, VIEWS["far away"], final=False).anchors == 0.0).all()


def test_the_viewport_shows_its_share_of_waves_and_pictures_all():
    waves = discretise(Sea(), GRID.shortest_wavelength)
    quarter = Framing(viewport_share=0.25)
    assert place(GRID, quarter, waves, None, final=False).wave_limit == -(-len(waves) // 4)
    assert place(GRID, quarter, waves, None, final=True).wave_limit is None


def test_who_does_not_look_down_has_no_water_in_frame():
    """Points of 2 m waves all around, projected; and a camera that sees the sky alone does not look down."""
    random = np.random.default_rng(3)
    points = random.uniform((-500.0, -500.0, -2.0), (500.0, 500.0, 2.0), (20_000, 3))
    answers = set()
    for pitch in np.linspace(-1.5, 1.5, 31):
        view = camera(height=5.0, pitch=float(pitch), heading=0.7)
        answers.add(looks_down(view, 0.0, 2.0))
        assert looks_down(view, 0.0, 2.0) or not projected_inside(view, points).any()
        assert looks_down(view, 0.3, 2.0) >= looks_down(view, 0.0, 2.0)
    assert answers == {True, False}
    half_height = math.atan(18.0 / 35.0 * 9 / 16)
    assert looks_down(camera(height=5.0, pitch=-half_height + 0.01), 0.0, 2.0)
    assert not looks_down(camera(height=5.0, pitch=-half_height - 0.01), 0.0, 2.0)
    assert looks_down(camera(height=1.0, pitch=-1.0), 0.0, 2.0), "a crest may be higher than the camera"
    assert looks_down(camera(height=5.0, pitch=-1.0, kind="PANO"), 0.0, 2.0)
