# SPDX-License-Identifier: GPL-3.0-or-later
"""From high above, where ripples are nearly all that is seen of the sea, their images are not seen to repeat."""

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem
from tests.render.flat_ripples import FlatRipples
from tools.sea_checks.correlation import correlation, expected, highest_beyond, slope_correlation

pytestmark = pytest.mark.render

SEA = Sea(systems=(WaveSystem(wind_speed=8.0),))
RIPPLES = Ripples(shortest_wavelength=10.0, longest_wavelength=80.0, resolution="256")
WIDTH, PIXELS = 2000.0, 256


def test_no_peak_of_the_autocorrelation_beyond_the_origin(tmp_path):
    """Truth: waves of a wind sea forget each other within a few wavelengths, and what is measured on 2 km of them
    afterwards is chance, up to 0.05; the images, 640 m and smaller, laid side by side give 1 instead."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    water = FlatRipples(RIPPLES, SEA, Grid(cell_size=25.0), 2.0 * WIDTH, time=3.0)
    water.look_down(WIDTH, PIXELS)
    slopes, _ = water.render("CYCLES", tmp_path / "water.exr")
    pixel = WIDTH / PIXELS
    perfect = expected(slope_correlation(SEA, 0.0, PIXELS, pixel), pixel)
    assert 20.0 < perfect.length < 100.0
    assert perfect.chance < 0.06
    assert highest_beyond(correlation(slopes[..., 0], slopes[..., 0]), pixel, perfect.length).value < 0.1
    tile = water.bump.layout.tiles[0]
    assert 0.5 * WIDTH > tile.size > 4.0 * perfect.length
    image = np.empty((tile.texels, tile.texels, 4), np.float32)
    water.bump.image(0, 3.0, image)
    texel = ((np.arange(PIXELS) * pixel) % tile.size / tile.size * tile.texels).astype(int)
    repeated = image[np.ix_(texel, texel)][..., 0].astype(np.float64)
    assert highest_beyond(correlation(repeated, repeated), pixel, perfect.length).value > 0.9
