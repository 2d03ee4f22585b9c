# SPDX-License-Identifier: GPL-3.0-or-later
"""The closure group in Cycles is the Ross BRDF, within what Cycles' own Smith Lambda is good for."""

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.nodes.material import ensure_material
from tests.render.flat_sea import FlatSea, direction, slope_tensor
from tests.render.ross_reference import CLOSURE_FRESNEL, lobe_peak, sun_radiance

pytestmark = pytest.mark.render

TENSORS = [slope_tensor(sigma, sigma) for sigma in (0.02, 0.05, 0.1, 0.2, 0.35, 0.5)]
TENSORS += [slope_tensor(sigma, sigma / 3.0, turn) for sigma in (0.06, 0.15, 0.3) for turn in (0, 90, 30, -55)]

ELEVATIONS = (90.0, 75.0, 60.0, 45.0, 30.0, 20.0, 12.0, 7.0, 4.0, 2.0, 1.0)

SUN_OFFSETS = ((0.0, 0.0), (10.0, 0.0), (-3.0, 15.0), (2.0, -40.0))
"""Elevation above, and azimuth beside, the mirror direction, degrees."""

LAMBDA_TOLERANCE = 0.008
"""Cycles' rational fit to Smith's Lambda is good to 0.7 %; a thousandth for its float32."""

IN_LOBE = 1e-3
"""Share of the peak down to which a lobe is compared: in the far tail a rounding of the exponent shows."""


def black_water(**settings):
    """The material without its body, so that nothing but the surface shows."""
    return ensure_material("Ocean", MaterialSettings(tint_red=0.0, tint_green=0.0, tint_blue=0.0, **settings))


def test_cycles_closure_is_the_ross_brdf(tmp_path):
    """Truth: sun radiance = irradiance times BRDF cos theta_l (Eq. 22), with the Fresnel of this Blender."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    sea = FlatSea(black_water(), TENSORS)
    compared = np.zeros(len(TENSORS), int)
    for elevation in ELEVATIONS:
        to_viewer = sea.look_along_x(elevation)
        for higher, aside in SUN_OFFSETS:
            to_sun = direction(min(max(elevation + higher, 0.5), 90.0), aside)
            sea.shine(to_sun, 1.0)
            picture = sea.render_cycles(tmp_path / "sea.exr")[:, 1]
            truth = np.array([sun_radiance(to_viewer, to_sun, tensor, CLOSURE_FRESNEL) for tensor in TENSORS])
            inside = truth > IN_LOBE * np.array([lobe_peak(to_viewer, tensor) for tensor in TENSORS])
            ratio = picture[inside] / truth[inside]
            message = f"elevation {elevation}, sun {higher:+} {aside:+}: {ratio}"
            assert np.all(np.abs(ratio - 1.0) < LAMBDA_TOLERANCE), message
            compared += inside
    assert np.all(compared >= len(ELEVATIONS)), "every strip was compared at about every elevation"
