# SPDX-License-Identifier: GPL-3.0-or-later
"""The width of the glitter path follows the wind as Cox and Munk measured."""

import math

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.optics.cox_munk import slope_variance_across, slope_variance_along
from ocean_lod_addon.nodes.material import ensure_material
from tests.render.flat_sea import FlatSea, direction

pytestmark = pytest.mark.render

WINDS = np.array([2.0, 5.0, 10.0, 15.0])

ELEVATION = 20.0

AZIMUTHS = np.linspace(0.0, 60.0, 31)


def facet_slopes(azimuth_degrees):
    """(along, across) of the facets that mirror a sun at an azimuth beside the view, both at `ELEVATION`."""
    e, a = math.radians(ELEVATION), np.radians(azimuth_degrees)
    return (1.0 - np.cos(a)) / (2.0 * np.tan(e)), np.sin(a) / (2.0 * np.tan(e))


def half_width(azimuths, radiance):
    """The azimuth at which the radiance has fallen to half."""
    return np.interp(-0.5, -radiance / radiance[0], azimuths)


def test_width_follows_the_wind(tmp_path):
    """Truth: the path ends where the slopes it needs become rare, half the density of level facets at ln 2 =
    zeta_x^2/(2 sigma_x^2) + zeta_y^2/(2 sigma_y^2), with the secant^4 and the Fresnel reflectance of the tilted
    facets widening it: by 1 % at 2 m/s, 3 % at 15 m/s.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    along, across = slope_variance_along(WINDS), slope_variance_across(WINDS)
    material = ensure_material("Ocean", MaterialSettings(tint_red=0.0, tint_green=0.0, tint_blue=0.0))
    sea = FlatSea(material, list(zip(along, across, np.zeros(len(WINDS)), strict=True)))
    sea.look_along_x(ELEVATION)
    pictures = []
    for azimuth in AZIMUTHS:
        sea.shine(direction(ELEVATION, azimuth), 1.0)
        pictures.append(sea.render_cycles(tmp_path / "sea.exr")[:, 1])
    widths = [half_width(AZIMUTHS, column) for column in np.transpose(pictures)]

    slope_x, slope_y = facet_slopes(AZIMUTHS)
    predicted = [
        half_width(AZIMUTHS, np.exp(-0.5 * (slope_x**2 / x + slope_y**2 / y)))
        for x, y in zip(along, across, strict=True)
    ]
    assert widths == pytest.approx(predicted, rel=0.05)
    assert np.all(np.diff(widths) > 0.0)
    assert widths[-1] / widths[0] == pytest.approx(predicted[-1] / predicted[0], rel=0.05)
