# SPDX-License-Identifier: GPL-3.0-or-later
"""The spreading laws: normalisation, cumulative law and its inverse, second moment, cut-off."""

from itertools import pairwise

import numpy as np
import pytest
import scipy.integrate

from ocean_lod_addon.core.dispersion import DEEP_WATER
from ocean_lod_addon.core.sea import WaveSystem
from ocean_lod_addon.core.spectra.table import spectrum_of
from ocean_lod_addon.core.spreading.cos2s import constant_cos2s
from ocean_lod_addon.core.spreading.sampling import direction_at_share, mean_cos2, share_within
from ocean_lod_addon.core.spreading.table import SPREADINGS, fully_developed_wind, spreading_of

OMEGA = np.array([0.4, 0.86, 1.5, 4.0, 12.0])


def law(key, **settings):
    system = WaveSystem(spreading=key, **settings)
    return spreading_of(system, spectrum_of(system, DEEP_WATER), DEEP_WATER)


def integral(function, high):
    """2 int_0^high by SciPy, split where laws that go no further than pi/2 end."""
    ends = [0.0, *([0.5 * np.pi] if high > 0.5 * np.pi else []), high]
    pieces = pairwise(ends)
    return 2.0 * sum(scipy.integrate.quad(function, *piece, limit=400, epsabs=1e-13)[0] for piece in pieces)


@pytest.mark.parametrize("key", SPREADINGS)
@pytest.mark.parametrize("cutoff", [0.3, 1.2, 2.5, np.pi])
def test_cumulative_and_second_moment_are_integrals_of_the_density(key, cutoff):
    """Oracle: SciPy's quadrature of the density. 1e-8: its error at the end point singularity of cos^2s, s < 1."""
    spreading = law(key)
    for omega in OMEGA:
        share = integral(lambda t, omega=omega: float(spreading.density(omega, t)), cutoff)
        cos2 = integral(lambda t, omega=omega: float(spreading.density(omega, t)) * np.cos(t) ** 2, cutoff)
        assert share_within(spreading, omega, cutoff) == pytest.approx(share, rel=1e-8)
        assert mean_cos2(spreading, omega, cutoff) == pytest.approx(cos2 / share, rel=1e-8)


@pytest.mark.parametrize("key", SPREADINGS)
def test_whole_circle(key):
    """Truth: the law integrates to 1, is symmetric and nowhere negative. 1e-14: rounding."""
    spreading = law(key)
    theta = np.linspace(0.0, np.pi, 200)
    assert np.all(spreading.density(OMEGA[:, None], theta) >= 0.0)
    np.testing.assert_array_equal(
        spreading.density(OMEGA[:, None], theta), spreading.density(OMEGA[:, None], -theta)
    )
    np.testing.assert_allclose(share_within(spreading, OMEGA, np.pi), 1.0, rtol=1e-14)


@pytest.mark.parametrize("key", SPREADINGS)
@pytest.mark.parametrize("cutoff", [0.2, np.pi])
def test_inverse(key, cutoff):
    """Truth: the share up to direction_at_share(u) is u.

    The angle must be right to 1e-14 rad (a few roundings of pi), so that the shares just before and just after it
    enclose u; 5e-13 is the rounding of the incomplete beta function.
    """
    spreading = law(key)
    share = np.linspace(0.0, 1.0, 101)
    theta = direction_at_share(spreading, OMEGA[:, None], share, cutoff)
    assert np.all(np.abs(theta) <= cutoff)
    within = share_within(spreading, OMEGA[:, None], cutoff)
    before, after = (
        (spreading.cumulative(OMEGA[:, None], np.clip(theta + step, -cutoff, cutoff)) - 0.5) / within + 0.5
        for step in (-1e-14, 1e-14)
    )
    assert np.all(before <= share + 5e-13)
    assert np.all(share <= after + 5e-13)


def test_inverse_of_a_pair_does_not_depend_on_the_others():
    """Truth: seeding invariance needs each direction to be its own; equal bit for bit."""
    spreading, omega, share = law("mitsuyasu"), np.geomspace(0.3, 12.0, 41), np.linspace(0.01, 0.99, 41)
    together = direction_at_share(spreading, omega, share)
    alone = [direction_at_share(spreading, omega[i : i + 1], share[i : i + 1])[0] for i in range(41)]
    np.testing.assert_array_equal(together, alone)


@pytest.mark.parametrize("s", [0.1, 1.0, 25.0, 1000.0])
def test_cos2s_second_harmonic(s):
    """Truth: <cos 2 theta> = s (s - 1) / ((s + 1)(s + 2)). 1e-12: log-gamma differences at s = 1000."""
    mean = 2.0 * mean_cos2(constant_cos2s(s), np.array([1.0]), np.pi) - 1.0
    np.testing.assert_allclose(mean, s * (s - 1.0) / ((s + 1.0) * (s + 2.0)), rtol=1e-11, atol=1e-12)


def test_cos2s_is_the_cartwright_law_of_wavespectra():
    """Truth: an independent library; it normalises by a sum over directions, exact for these smooth laws. 1e-6."""
    from wavespectra.construct import direction  # takes seconds to import

    degrees = np.arange(0.0, 360.0, 1.0)
    for s in (2.0, 10.0, 40.0):
        dspr = np.degrees(np.sqrt(2.0 / (s + 1.0)))
        theirs = np.asarray(direction.cartwright(dir=degrees, dm=180.0, dspr=dspr)) * np.degrees(1.0)
        ours = constant_cos2s(s).density(1.0, np.radians(degrees - 180.0))
        np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-9)


def test_a_system_sized_by_its_height_gets_the_wind_of_its_peak():
    """Truth: for Pierson-Moskowitz the two ways to size the same sea give the same spreading. 1e-12: rounding."""
    by_wind = WaveSystem(wind_speed=12.0)
    spectrum = spectrum_of(by_wind, DEEP_WATER)
    assert fully_developed_wind(spectrum.peak_frequency) == pytest.approx(12.0, rel=1e-12)
    height = 4.0 * np.sqrt(spectrum.moment(0))
    by_height = WaveSystem(sized_by="height", significant_wave_height=height)
    laws = [spreading_of(s, spectrum_of(s, DEEP_WATER), DEEP_WATER) for s in (by_wind, by_height)]
    np.testing.assert_allclose(laws[0].density(OMEGA, 0.3), laws[1].density(OMEGA, 0.3), rtol=1e-9)
