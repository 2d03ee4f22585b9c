# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectrum of the ripples: together with the longer waves it has the slope variance that the wind makes."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.ripples.spectrum import (
    CORRECTED_BELOW,
    FULL_ABOVE,
    correction_share,
    levels_for,
    ripple_spectrum,
    slope_tensor_between,
    wind_ripples,
)
from ocean_lod_addon.core.roughness import along_across, cox_munk_along_across, tensor_of_axes
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.slope_budget import total_slope_variance, wave_tensors
from ocean_lod_addon.core.spectra.table import SHORTEST_RIPPLE
from ocean_lod_addon.core.waves import TWO_PI

SPLIT = 1.0
"""m; above FULL_ABOVE, so that nothing longer is corrected."""


def sea_of(wind, spectrum="pierson_moskowitz", spreading="swop", direction=0.0):
    system = WaveSystem(wind_speed=wind, spectrum=spectrum, spreading=spreading, direction=direction)
    return Sea(systems=(system,), wave_count=512)


def tensor_of_whole_spectrum(sea):
    """Longer waves from their discretisation, which is exact; the rest by quadrature, octave by octave."""
    long_waves = wave_tensors(discretise(sea, SPLIT)).sum(axis=0)
    density = ripple_spectrum(sea, SPLIT).density
    edges = np.geomspace(SPLIT, SHORTEST_RIPPLE, 13)
    return long_waves + sum(slope_tensor_between(density, low, high) for high, low in itertools.pairwise(edges))


@pytest.mark.parametrize("wind", [6.0, 10.0, 20.0])
@pytest.mark.parametrize(
    ("spectrum", "spreading"),
    [("pierson_moskowitz", "swop"), ("jonswap", "mitsuyasu"), ("neumann", "cos2"), ("elfouhaily", "elfouhaily")],
)
def test_all_waves_together_have_cox_and_munks_slope_variances(wind, spectrum, spreading):
    """Truth: Eqs. 9 and 10 along and across the wind. 1 %: trochoids of the long waves against sinusoids, and
    directions of the long waves by draws."""
    sea = sea_of(wind, spectrum, spreading, math.radians(30.0))
    along, across = along_across(tensor_of_whole_spectrum(sea), math.radians(30.0))
    assert (along, across) == pytest.approx(cox_munk_along_across(sea.systems[0]), rel=0.01)


@pytest.mark.parametrize("wind", [1.0, 2.0, 3.0])
def test_in_a_light_wind_the_sea_has_what_its_waves_carry(wind):
    """Pierson and Moskowitz's long waves alone are steeper than the measured mean, within its error of 0.004."""
    sea = sea_of(wind)
    along, across = along_across(tensor_of_whole_spectrum(sea), 0.0)
    total_along, total_across = along_across(total_slope_variance(sea, discretise(sea, SPLIT)), 0.0)
    assert total_along == pytest.approx(along, rel=0.01)
    assert along > cox_munk_along_across(sea.systems[0])[0]
    assert along - cox_munk_along_across(sea.systems[0])[0] < 0.004
    assert across <= total_across * 1.01


def test_the_total_does_not_depend_on_the_mesh():
    """As long as the mesh shows no waves that are corrected, the spectrum alone decides along and across the wind.

    The covariance of the two is that of the waves drawn, so that no negative variance is left where all show.
    """
    lengths = (FULL_ABOVE, 1.0, 5.0)
    totals = [total_slope_variance(sea_of(3.0), discretise(sea_of(3.0), length))[:2] for length in lengths]
    assert totals[0] == pytest.approx(totals[1], rel=1e-12)
    assert totals[1] == pytest.approx(totals[2], rel=1e-12)


def test_turning_the_wind_turns_the_slopes():
    angle = math.radians(77.0)
    straight = slope_tensor_between(ripple_spectrum(sea_of(8.0), SPLIT).density, 0.01, 0.5)
    turned = slope_tensor_between(ripple_spectrum(sea_of(8.0, direction=angle), SPLIT).density, 0.01, 0.5)
    along, across = along_across(straight, 0.0)
    # the quadrature has nodes one degree apart: the edge of the half plane falls between them
    assert turned == pytest.approx(tensor_of_axes(along, across, angle), rel=0.01, abs=1e-5)


def test_long_waves_keep_their_level_and_short_ones_are_corrected():
    k = TWO_PI / np.array([10.0, FULL_ABOVE, 0.1, CORRECTED_BELOW, 0.001])
    share = correction_share(k)
    assert share[:2].tolist() == [0.0, 0.0]
    assert share[2] == pytest.approx(math.log(3.0) / math.log(10.0))
    assert share[3:] == pytest.approx([1.0, 1.0])


def test_a_mirror_without_wind_has_no_ripples():
    calm = sea_of(0.0)
    assert slope_tensor_between(ripple_spectrum(calm, SPLIT).density, 0.001, 0.02).tolist() == [0.0, 0.0, 0.0]
    assert wind_ripples(calm, 0).along == 0.0


def test_a_swell_ends_where_the_mesh_does():
    """The tail of a swell's spectrum is no ripple: what roughens the sea is the local wind."""
    wind_sea = sea_of(8.0)
    swell = WaveSystem(
        spectrum="jonswap", sized_by="height", significant_wave_height=3.0, period=12.0, direction=1.0
    )
    both = replace(wind_sea, systems=(*wind_sea.systems, swell))
    alone, together = (ripple_spectrum(sea, 0.4).density for sea in (wind_sea, both))
    below = [slope_tensor_between(density, 0.01, 0.4) for density in (alone, together)]
    assert below[1] == pytest.approx(below[0], rel=1e-9)
    above = [slope_tensor_between(density, 0.4, 4.0) for density in (alone, together)]
    assert above[1][0] > above[0][0]


def test_levels_solve_the_two_equations_or_keep_the_sum():
    moments = np.array([[0.5, 0.125], [0.125, 0.25]])
    assert moments @ levels_for(np.array([0.3, 0.2]), moments) == pytest.approx([0.3, 0.2])
    along, across = levels_for(np.array([-0.1, 0.3]), moments)
    assert along == 0.0
    assert (moments @ (along, across)).sum() == pytest.approx(0.2)
    along, across = levels_for(np.array([0.3, -0.1]), moments)
    assert across == 0.0
    assert (moments @ (along, across)).sum() == pytest.approx(0.2)
    assert levels_for(np.array([-0.3, 0.1]), moments) == (0.0, 0.0)
