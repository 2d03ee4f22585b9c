# SPDX-License-Identifier: GPL-3.0-or-later
"""The colour of water: against Jerlov's measured classes, colour science, and what divers and sailors see."""

import numpy as np
import pytest

from ocean_lod_addon.core.material_settings import MaterialSettings
from ocean_lod_addon.core.optics.color import color_matching, reflectance_to_rec709
from ocean_lod_addon.core.optics.water_types import (
    WATER_TYPES,
    WAVELENGTHS,
    WaterContents,
    absorption,
    backscattering,
    rgb_absorption,
    rgb_backscattering,
    water_leaving_reflectance,
)
from ocean_lod_addon.core.parameters import parameters_of

MEAN_COSINE = 0.9
"""Of daylight under water: K_d is (a + b_b)/0.9 (Morel and Maritorena 2001)."""


@pytest.mark.parametrize(
    ("contents", "at_475", "at_550"),
    [
        (WATER_TYPES["clear_ocean"], 0.025, 0.067),  # class IA
        (WATER_TYPES["ocean"], 0.062, 0.089),  # class II
        (WaterContents(1.5), 0.116, 0.120),  # class III
    ],
)
def test_attenuation_is_that_of_jerlovs_ocean_classes(contents, at_475, at_550):
    """Truth: Jerlov (1976, table XXVII), 1/m. His classes are about 15 % apart where they overlap."""
    K_d = (absorption(contents) + backscattering(contents)) / MEAN_COSINE
    assert np.interp(475.0, WAVELENGTHS, K_d) == pytest.approx(at_475, rel=0.15)
    assert np.interp(550.0, WAVELENGTHS, K_d) == pytest.approx(at_550, rel=0.15)


def test_clear_ocean_reflects_as_measured():
    """Truth: remote-sensing reflectance of the clearest oceans at 440 nm is 0.008 to 0.014 per steradian."""
    R_rs = water_leaving_reflectance(WATER_TYPES["clear_ocean"]) / np.pi
    assert 0.008 < np.interp(440.0, WAVELENGTHS, R_rs) < 0.014


def test_a_grey_reflectance_is_a_grey_color():
    assert reflectance_to_rec709(WAVELENGTHS, np.full(WAVELENGTHS.shape, 0.18)) == pytest.approx(0.18, rel=1e-12)


def test_color_matching_functions_are_the_standard_observer():
    """Truth: the 1931 observer has y = 1 at 555 nm and equal areas, 106.857 for each; the lobes fit to 1 %."""
    w = np.arange(360.0, 831.0)
    assert color_matching(555.0)[1] == pytest.approx(1.0, abs=0.01)
    assert color_matching(w).sum(axis=1) == pytest.approx(106.857, rel=0.01)


def test_colors_are_those_of_the_names():
    red, green, blue = range(3)
    colors = {
        name: reflectance_to_rec709(WAVELENGTHS, water_leaving_reflectance(contents))
        for name, contents in WATER_TYPES.items()
    }
    assert np.argmax(colors["clear_ocean"]) == blue
    assert np.argmax(colors["coastal"]) == green
    assert np.argmax(colors["river"]) == red
    assert colors["clear_ocean"][blue] > colors["ocean"][blue] > colors["coastal"][blue]
    assert all(0.0 <= channel < 0.1 for color in colors.values() for channel in color)


def test_every_water_type_of_the_settings_has_contents():
    options = {option.key for option in parameters_of(MaterialSettings)["water_type"].options}
    assert options == set(WATER_TYPES)


@pytest.mark.parametrize("name", list(WATER_TYPES))
def test_channels_dim_and_scatter_as_the_spectrum_does(name):
    """Truth: the colour of daylight after the length that each channel's absorption is judged by."""
    contents = WATER_TYPES[name]
    a = absorption(contents)
    length = np.log(2.0) / np.mean(a)
    seen = reflectance_to_rec709(WAVELENGTHS, np.exp(-a * length))
    visible = seen > 0.01
    assert np.exp(-rgb_absorption(contents) * length)[visible] == pytest.approx(seen[visible], rel=1e-9)
    b_b = backscattering(contents)
    assert np.all(rgb_backscattering(contents) > 0.5 * b_b.min())
    assert np.all(rgb_backscattering(contents) < 1.5 * b_b.max())
