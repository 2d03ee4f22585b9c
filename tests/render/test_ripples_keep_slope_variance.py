# SPDX-License-Identifier: GPL-3.0-or-later
"""What the shader shows as ripples and what it leaves to the BRDF is always the whole slope variance."""

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.slope_budget import total_slope_variance
from tests.render.flat_ripples import FlatRipples, eevee

pytestmark = pytest.mark.render

SEA = Sea(systems=(WaveSystem(wind_speed=8.0, direction=0.5),), seed=2)
GRID = Grid(cell_size=0.25)
WIDTH, PIXELS = 200.0, 256


@pytest.mark.parametrize(
    ("engine", "shortest", "longest"),
    [("CYCLES", 0.03, 4.0), ("EEVEE", 0.3, 1.0)],  # one image only: without a GPU, EEVEE compiles for long
)
def test_shown_and_left_variance_are_the_whole(engine, shortest, longest, tmp_path):
    """65 536 points, of which waves of 4 m are independent every 4 m or so: their variance, a sixth of what is
    shown, is known to 2 sqrt(2) * 4 / 200 = 6 %, the sum to 1 %. A pixel of 3 m hardly shows ripples."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    whole = total_slope_variance(SEA, discretise(SEA, GRID.shortest_wavelength))
    ripples = Ripples(shortest_wavelength=shortest, longest_wavelength=longest)
    water = FlatRipples(ripples, SEA, GRID, 2.0 * WIDTH, tuple(map(float, whole)), time=3.0)
    water.look_down(WIDTH, PIXELS)
    carried, total = water.bump.tensors[:, :2].sum(), whole[:2].sum()
    shares = []
    for pixel in (0.0, 0.3, 3.0):
        water.set_pixel(0.0, pixel)
        slopes, left = water.render(engine if engine == "CYCLES" else eevee(), tmp_path / "water.exr")
        shown = np.mean(np.sum(slopes**2, axis=-1))
        assert shown + left.mean() == pytest.approx(total, rel=0.02)
        assert left.min() > 0.0
        shares.append(shown / carried)
    assert shares[0] == pytest.approx(1.0, rel=0.03)
    assert 0.1 < shares[1] < 0.7
    assert shares[2] < 0.03
