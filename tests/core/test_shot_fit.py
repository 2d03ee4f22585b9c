# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane is sized from the shot: fine where the camera is close, wide to the horizon, never absurd."""

import math

import numpy as np
import pytest

from ocean_lod_addon.core.camera_view import CameraView
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.errors import OceanError
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea
from ocean_lod_addon.core.shot_fit import curvature_shows, fit, fit_ripples, frame_needs, horizon_distance

RESOLUTION = 1920


def level_view(height, lens=35.0, pitch=0.0, kind="PERSP"):
    half = 18.0 / lens
    forward = np.array([math.cos(pitch), 0.0, -math.sin(pitch)])
    right = np.array([0.0, -1.0, 0.0])
    axes = np.stack([right, np.cross(right, forward), forward])
    return CameraView(np.array([0.0, 0.0, height]), axes, (-half, half, -half * 9 / 16, half * 9 / 16), kind)


def fitted(*views, pixels=8.0, highest=3.0):
    return fit(Grid(), [frame_needs(view, RESOLUTION) for view in views], pixels, highest)


def test_cells_are_so_many_pixels_at_the_nearest_water():
    """A level 35 mm camera at 2 m: nearest water 2 / sin(atan(18/35 * 9/16)) away, a pixel is 36/35/1920 rad."""
    nearest = 2.0 / math.sin(math.atan(18 / 35 * 9 / 16))
    assert fitted(level_view(2.0)).cell_size == pytest.approx(8 * nearest * 36 / 35 / 1920, rel=1e-6)


def test_the_closest_frame_of_a_shot_decides():
    assert fitted(level_view(50.0), level_view(2.0)).cell_size == fitted(level_view(2.0)).cell_size


@pytest.mark.parametrize("height", [0.3, 1.7, 30.0, 1000.0, 10e3])
def test_the_plane_reaches_past_the_true_horizon(height):
    """Beyond sqrt(2 R h) plus the same for the highest crest nothing of a curved sea can be seen."""
    grid = fitted(level_view(height), highest=5.0)
    assert grid.half_extent > horizon_distance(height) + horizon_distance(5.0)


@pytest.mark.parametrize("lens", [8.0, 35.0, 1200.0])
@pytest.mark.parametrize("height", [0.0, 0.3, 10e3])
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO", "PANO"])
def test_every_camera_gets_a_valid_grid(lens, height, kind):
    grid = fitted(level_view(height, lens, pitch=0.1, kind=kind))
    assert grid.cells <= 1024
    assert grid.vertex_count < 20e6


def test_a_long_lens_gets_finer_cells_not_coarser():
    """At the distance that both see, 1200 mm shows more detail per metre than 35 mm."""
    far = 400.0
    wide, long = fitted(level_view(3.0)), fitted(level_view(3.0, lens=1200.0))
    assert long.cell_size < 4.0 * far / wide.cells


def test_more_pixels_per_cell_is_coarser():
    assert fitted(level_view(2.0), pixels=16.0).cell_size == 2 * fitted(level_view(2.0), pixels=8.0).cell_size


def test_curvature_shows_from_a_height_on():
    """At h = 2 m the dip is 0.8 mrad and a flat plane 30 km wide shows 0.07: 1.3 pixels. At 100 m, 10 pixels."""
    assert not curvature_shows([frame_needs(level_view(2.0), RESOLUTION)], 30e3)
    assert curvature_shows([frame_needs(level_view(100.0), RESOLUTION)], 100e3)


def test_a_shot_without_frames_is_refused():
    with pytest.raises(OceanError, match="no frames"):
        fit(Grid(), [], 8.0, 3.0)


def fitted_ripples(*views, kind="spectral"):
    needs = [frame_needs(view, RESOLUTION) for view in views]
    grid = fit(Grid(), needs, 8.0, 3.0)
    return fit_ripples(Ripples(kind=kind), needs, grid.shortest_wavelength, discretise(Sea(), 1.0)), grid


def test_ripples_begin_at_two_pixels_of_the_nearest_water():
    """Shorter waves show less than a third of their slope variance."""
    nearest = 2.0 / math.sin(math.atan(18 / 35 * 9 / 16))
    ripples, _ = fitted_ripples(level_view(2.0), level_view(50.0))
    assert ripples.shortest_wavelength == pytest.approx(2.0 * nearest * 36 / 35 / 1920, rel=1e-6)


def test_ripples_reach_over_what_the_mesh_leaves_out():
    """From 2 m as from 2 km, in any frame of the shot, but no further than the sea's own longest wave."""
    low, _ = fitted_ripples(level_view(2.0))
    assert low.longest_wavelength == pytest.approx(8.0)
    assert fitted_ripples(level_view(2.0), level_view(10.0))[0].longest_wavelength == pytest.approx(40.0)
    high, grid = fitted_ripples(level_view(2000.0, pitch=math.pi / 2))
    longest = 2.0 * math.pi / discretise(Sea(), 1.0).wavenumber.min()
    assert grid.shortest_wavelength < high.longest_wavelength == pytest.approx(longest)


@pytest.mark.parametrize("lens", [8.0, 35.0, 5000.0])
@pytest.mark.parametrize("height", [0.0, 0.3, 10e3])
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO", "PANO"])
def test_every_camera_gets_valid_ripples(lens, height, kind):
    """Settings that are not allowed raise an error; the rest of what the artist chose stays."""
    ripples, _ = fitted_ripples(level_view(height, lens, pitch=0.1, kind=kind), kind="random")
    assert ripples.kind == "random"
