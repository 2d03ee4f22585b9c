# SPDX-License-Identifier: GPL-3.0-or-later
"""From high above, where ripples are nearly all that is seen of the sea, their images are not seen to repeat."""

from dataclasses import replace

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
RIPPLES = Ripples(shortest_wavelength=10.0, longest_wavelength=220.0)
"""As *Fit Plane to Shot* has them for such a picture: images of 1790 m and 640 m."""

WIDTH, PIXELS = 2000.0, 256


def correlation_of(sea, path):
    """The slopes along the wind that ripples show of 2 km, and their autocorrelation."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    water = FlatRipples(RIPPLES, sea, Grid(cell_size=55.0), 2.0 * WIDTH, time=3.0)
    water.look_down(WIDTH, PIXELS)
    water.set_pixel(0.0, WIDTH / PIXELS)
    slopes = water.render("CYCLES", path)[0][..., 0]
    return slopes, correlation(slopes, slopes)


def test_no_peak_of_the_autocorrelation_beyond_the_origin(tmp_path):
    """Truth: waves of a wind sea forget each other within a few wavelengths, and what is measured on 2 km of them
    afterwards is chance; a square of them laid side by side gives 1 instead.

    Cells choose their places alike in all seas, so that what they repeat stays in the mean of four, in which
    chance halves: 0.033 is left of cells that see a ninth of an image, and would be 0.049 if they saw a quarter.
    """
    seas = [replace(SEA, seed=seed) for seed in range(4)]
    slopes, correlations = zip(*(correlation_of(sea, tmp_path / "water.exr") for sea in seas), strict=True)
    pixel = WIDTH / PIXELS
    perfect = expected(slope_correlation(SEA, 0.0, PIXELS, pixel), pixel)
    highest = [highest_beyond(each, pixel, perfect.length).value for each in correlations]
    mean = highest_beyond(np.mean(correlations, axis=0), pixel, 2.0 * perfect.length)
    assert 20.0 < perfect.length < 100.0
    assert perfect.chance < 0.06
    assert max(highest) < 0.1
    assert mean.value < 0.8 * perfect.chance
    side = PIXELS // 4
    repeated = np.tile(slopes[0][:side, :side], (4, 4))
    assert highest_beyond(correlation(repeated, repeated), pixel, perfect.length).value > 0.9
