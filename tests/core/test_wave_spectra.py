# SPDX-License-Identifier: GPL-3.0-or-later
"""The wave spectra: closed forms, independent implementations, published laws, extremes."""

import math

import numpy as np
import pytest
import scipy.integrate

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.dispersion import DEEP_WATER, Water, group_speed
from ocean_lod_addon.core.optics.cox_munk import slope_variance_across, slope_variance_along
from ocean_lod_addon.core.sea import WaveSystem
from ocean_lod_addon.core.spectra.elfouhaily import elfouhaily_from_wind, upwind_crosswind_ratio
from ocean_lod_addon.core.spectra.jonswap import jonswap_from_height, jonswap_from_wind, peak_frequency_of_period
from ocean_lod_addon.core.spectra.moments import (
    mean_period,
    significant_wave_height,
    spectrum_moments,
    zero_crossing_period,
)
from ocean_lod_addon.core.spectra.neumann import Neumann
from ocean_lod_addon.core.spectra.pierson_moskowitz import pierson_moskowitz_from_wind
from ocean_lod_addon.core.spectra.table import SPECTRA, spectrum_of
from ocean_lod_addon.core.spectra.tma import Tma, kitaigorodskii_factor
from ocean_lod_addon.core.waves import TWO_PI
from ocean_lod_addon.core.wind import COX_MUNK_HEIGHT, wind_at_height

HZ = TWO_PI
"""S(f) = 2 pi S(omega)."""


def test_quadrature_gives_the_closed_moments():
    """Truth: moments of Pierson-Moskowitz and the variance of Neumann are closed forms.

    1e-13 where the quadrature covers everything; m1 and m2 leave out the tail beyond 1e4 peak frequencies.
    """
    pm = pierson_moskowitz_from_wind(12.0)
    m0, m1, m2 = spectrum_moments(pm)
    assert m0 == pytest.approx(pm.moment(0), rel=1e-13)
    assert m1 == pytest.approx(pm.moment(1), rel=1e-11)
    assert m2 == pytest.approx(pm.moment(2), rel=1e-7)
    assert spectrum_moments(Neumann(9.0))[0] == pytest.approx(Neumann(9.0).variance, rel=1e-13)


@pytest.mark.parametrize("key", SPECTRA)
@pytest.mark.parametrize("height", [0.1, 3.0, 12.0])
def test_a_height_that_is_given_is_made(key, height):
    """Truth: Hs = 4 sqrt(m0) is what was asked for. 1e-9: Elfouhaily's wind is found by bisection to 1e-12."""
    system = WaveSystem(spectrum=key, sized_by="height", significant_wave_height=height, period=9.0)
    m0 = spectrum_moments(spectrum_of(system, Water(15.0)))[0]
    assert significant_wave_height(m0) == pytest.approx(height, rel=1e-9)


@pytest.mark.parametrize("key", ["jonswap", "two_parameter"])
@pytest.mark.parametrize("gamma", [1.0, 3.3, 20.0])
def test_a_period_that_is_given_is_made(key, gamma):
    """Truth: T1 = 2 pi m0/m1 and Tz = 2 pi sqrt(m0/m2) are what was asked for; 1e-7: the tail of m2."""
    for kind in ("mean", "zero_crossing"):
        system = WaveSystem(spectrum=key, sized_by="height", period=7.0, period_kind=kind, peak_enhancement=gamma)
        m0, m1, m2 = spectrum_moments(spectrum_of(system, DEEP_WATER))
        made = mean_period(m0, m1) if kind == "mean" else zero_crossing_period(m0, m2)
        assert made == pytest.approx(7.0, rel=1e-7)
    assert peak_frequency_of_period(7.0, "peak", gamma) == pytest.approx(TWO_PI / 7.0, rel=1e-15)


@pytest.mark.parametrize("key", SPECTRA)
def test_the_peak_is_where_it_is_said_to_be(key):
    """Truth: S is largest at the peak frequency; 5 %: Elfouhaily's peak is one of the spectrum over k."""
    spectrum = spectrum_of(WaveSystem(spectrum=key), DEEP_WATER)
    omega = np.geomspace(0.3, 3.0, 4001) * spectrum.peak_frequency
    assert omega[np.argmax(spectrum.density(omega))] == pytest.approx(spectrum.peak_frequency, rel=0.05)


def test_tma_is_jonswap_in_deep_water_and_less_in_shallow():
    """Truth: phi is 1 for kh -> inf and (kh)^2 / 2 for kh -> 0."""
    deep = jonswap_from_wind(10.0, 1e5, 3.3)
    omega = np.geomspace(0.5, 5.0, 50)
    np.testing.assert_array_equal(Tma(deep, DEEP_WATER).density(omega), deep.density(omega))
    h = 0.05
    slow = 0.01 * np.sqrt(GRAVITY / h)  # kh = 0.01: relative error of the limit is (kh)^2
    phi = Tma(deep, Water(h)).density(slow * 50.0) / deep.density(slow * 50.0)
    assert 0.0 < phi < 1.0
    assert kitaigorodskii_factor(slow, Water(h)) == pytest.approx(0.5 * 0.01**2, rel=1e-3)


def test_fetch_beyond_a_fully_developed_sea_changes_nothing():
    """Truth: the wind cannot drive waves that outrun it; below that fetch the JONSWAP laws hold."""
    longest, long, short = (
        spectrum_of(WaveSystem(spectrum="jonswap", fetch=fetch), DEEP_WATER) for fetch in (1e7, 1e6, 1e5)
    )
    assert longest == long
    assert short == jonswap_from_wind(10.0, 1e5, 3.3)
    fully = spectrum_of(WaveSystem(), DEEP_WATER).peak_frequency
    assert longest.peak_frequency == pytest.approx(fully, rel=1e-12)


@pytest.mark.parametrize("wind_speed", [5.0, 7.0, 10.0, 12.0, 15.0])
def test_elfouhaily_has_the_slopes_cox_and_munk_measured(wind_speed):
    """Truth: mss(U) of Cox and Munk, along 0.00316 U +- 0.004 and across 0.003 + 0.00192 U +- 0.002 at 12.5 m.

    The tolerances are theirs (one standard deviation of the regression). Oracle: SciPy over k, to 1 mm waves.
    """
    spectrum = elfouhaily_from_wind(wind_speed, 1e7, DEEP_WATER)

    def slope(ln_k, sign):
        k = math.exp(ln_k)
        delta = upwind_crosswind_ratio(k, wind_speed, spectrum.peak_wavenumber)
        return k**3 * spectrum.wavenumber_density(k) * (0.5 + sign * 0.25 * delta)

    bounds = math.log(1e-3), math.log(TWO_PI / 1e-3)
    along, across = (scipy.integrate.quad(slope, *bounds, args=(sign,), limit=200)[0] for sign in (1.0, -1.0))
    U = wind_at_height(wind_speed, COX_MUNK_HEIGHT)
    assert along == pytest.approx(slope_variance_along(U), abs=0.004)
    assert across == pytest.approx(slope_variance_across(U), abs=0.004)
    assert along + across == pytest.approx(0.003 + 0.00512 * U, rel=0.10)


@pytest.mark.parametrize("wind_speed", [5.0, 10.0, 20.0])
def test_elfouhaily_has_the_height_of_a_fully_developed_sea(wind_speed):
    """Truth: Hs = 0.26 U10^2 / g to 5 % (their fully developed sea, Omega_c = 0.84), near PM's 0.235."""
    m0 = spectrum_moments(elfouhaily_from_wind(wind_speed, 1e7, DEEP_WATER))[0]
    assert significant_wave_height(m0) == pytest.approx(0.26 * wind_speed**2 / GRAVITY, rel=0.05)


def test_elfouhaily_over_frequency_is_elfouhaily_over_wavenumber():
    """Truth: int S(k) dk = int S(omega) d omega in any water, by SciPy over k. 1e-9: SciPy's own tolerance."""
    for water in (DEEP_WATER, Water(5.0), Water(math.inf, 7.3e-5)):
        spectrum = elfouhaily_from_wind(8.0, 5e4, water)
        k_p = spectrum.peak_wavenumber

        def by_ln_k(ln_k, spectrum=spectrum):
            return math.exp(ln_k) * spectrum.wavenumber_density(math.exp(ln_k))

        ends = math.log(0.1 * k_p), math.log(1e7 * k_p)
        expected = scipy.integrate.quad(by_ln_k, *ends, limit=500, epsrel=1e-11, epsabs=0.0)[0]
        assert spectrum_moments(spectrum)[0] == pytest.approx(expected, rel=1e-9)
        assert spectrum.density(1.0) * group_speed(0.1, water) > 0.0


def test_agrees_with_wavespectra():
    """Truth: an independent, maintained library. 1e-6 asked; it uses g = 9.80665, which alpha takes up exactly."""
    from wavespectra.construct import frequency  # takes seconds to import

    f = np.geomspace(0.03, 1.0, 300)
    alpha = (GRAVITY / scipy.constants.g) ** 2
    pm = pierson_moskowitz_from_wind(15.0)
    theirs = frequency.pierson_moskowitz(freq=f, fp=pm.peak_frequency / HZ, alpha=0.0081 * alpha)
    np.testing.assert_allclose(HZ * pm.density(HZ * f), np.asarray(theirs), rtol=1e-6)
    for gamma in (1.0, 3.3, 7.0):
        jonswap = jonswap_from_wind(15.0, 2e5, gamma)
        theirs = frequency.jonswap(
            freq=f, fp=jonswap.peak_frequency / HZ, alpha=jonswap.alpha * alpha, gamma=gamma
        )
        np.testing.assert_allclose(HZ * jonswap.density(HZ * f), np.asarray(theirs), rtol=1e-6)
    sized = jonswap_from_height(3.0, TWO_PI / 9.0, 3.3)
    dense = np.linspace(0.05, 5.0, 20001)  # theirs is scaled by a sum over its own frequencies
    theirs = frequency.jonswap(freq=dense, fp=1.0 / 9.0, gamma=3.3, hs=3.0)
    np.testing.assert_allclose(HZ * sized.density(HZ * dense), np.asarray(theirs), rtol=1e-6)


@pytest.mark.parametrize("key", SPECTRA)
@pytest.mark.parametrize("wind_speed", [0.3, 60.0, 80.0])
@pytest.mark.parametrize("fetch", [10.0, 1e7])
@pytest.mark.parametrize("gamma", [1.0, 20.0])
@pytest.mark.parametrize("depth", [0.05, math.inf])
def test_extremes_stay_finite(key, wind_speed, fetch, gamma, depth):
    """Truth: a spectrum is finite and not negative, and has energy, in every corner of the allowed settings."""
    system = WaveSystem(spectrum=key, wind_speed=wind_speed, fetch=fetch, peak_enhancement=gamma)
    spectrum = spectrum_of(system, Water(depth))
    S = spectrum.density(np.geomspace(0.15, 1e4, 500) * spectrum.peak_frequency)
    assert np.all(np.isfinite(S))
    assert np.all(S >= 0.0)
    assert S.max() > 0.0
