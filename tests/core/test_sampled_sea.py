# SPDX-License-Identifier: GPL-3.0-or-later
"""The waves that stand for a sea have its height, its slope variance, its periods; loops close; corners hold."""

import math
from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest
import scipy.integrate

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.dispersion import DEEP_WATER, Water, wavenumber
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectra.elfouhaily import upwind_crosswind_ratio
from ocean_lod_addon.core.spectra.table import SPECTRA, spectrum_of
from ocean_lod_addon.core.spreading.cos2s import mitsuyasu_exponent
from ocean_lod_addon.core.spreading.swop import swop_coefficients
from ocean_lod_addon.core.spreading.table import SPREADINGS
from ocean_lod_addon.core.waves import TWO_PI
from ocean_lod_addon.core.wind import SWOP_HEIGHT, wind_at_height

SHORTEST = 0.5
FREQUENCIES = 64
U10 = 10.0
SEEDS = (0, 1, 77)


def closed_mean_cos2(spreading, omega, peak, water):
    """<cos^2 theta> of each law as published, THEORY section 3."""
    match spreading:
        case "swop":
            p, _ = swop_coefficients(omega * wind_at_height(U10, SWOP_HEIGHT) / GRAVITY)
            return (1.0 + 0.5 * p) / 2.0
        case "mitsuyasu":
            s = mitsuyasu_exponent(omega, U10, peak)
            return 0.5 * (1.0 + s * (s - 1.0) / ((s + 1.0) * (s + 2.0)))
        case "cos2s":
            return 0.5 * (1.0 + 10.0 * 9.0 / (11.0 * 12.0))
        case "cos2":
            return 0.75
        case "elfouhaily":
            peak_k = float(wavenumber(peak, water))
            return 0.5 + 0.25 * upwind_crosswind_ratio(wavenumber(omega, water), U10, peak_k)
    raise AssertionError(f"no closed form for {spreading}")


def quadrature(spectrum, spreading, depth):
    """m0 and the slope variances along and across the wind, by SciPy over k, for waves longer than SHORTEST."""
    peak = spectrum.peak_frequency

    def omega_of(k):
        return math.sqrt(GRAVITY * k * math.tanh(min(k * depth, 50.0)))

    def slope_of_omega(k):
        t = math.tanh(min(k * depth, 50.0))
        return GRAVITY * (t + min(k * depth, 50.0) * (1.0 - t * t)) / (2.0 * omega_of(k))

    def integrand(ln_k, power, weighted):
        k = math.exp(ln_k)
        omega = omega_of(k)
        weight = closed_mean_cos2(spreading, omega, peak, Water(depth)) if weighted else 1.0
        return float(k**power * spectrum.density(np.float64(omega)) * weight * slope_of_omega(k) * k)

    peak_k = float(wavenumber(peak, Water(depth)))
    pieces = [math.log(0.03 * peak_k), math.log(peak_k), math.log(TWO_PI / SHORTEST)]
    m0, total, along = (
        sum(
            scipy.integrate.quad(integrand, *piece, args=args, limit=200, epsabs=0.0, epsrel=1e-9)[0]
            for piece in pairwise(pieces)
        )
        for args in ((0, False), (2, False), (2, True))
    )
    return m0, along, total - along


def moments(waves, direction):
    energy = 0.5 * waves.amplitude**2
    slope = energy * waves.wavenumber**2
    along = np.sum(slope * np.cos(waves.direction - direction) ** 2)
    return np.sum(energy), along, np.sum(slope) - along


@pytest.mark.parametrize("key", SPECTRA)
@pytest.mark.parametrize("depth", [math.inf, 6.0])
def test_height_and_slopes_of_every_spectrum_and_spreading(key, depth):
    """Truth: m0 and the slope variances along and across the wind are the integrals of the spectrum.

    At 64 frequencies, for any seed. 1e-4 is asked; 1e-7 holds, which is what SciPy's quadrature and the energy
    below its lower end leave.
    """
    for spreading in SPREADINGS:
        system = WaveSystem(
            spectrum=key, spreading=spreading, wind_speed=U10, fetch=1e5, direction=0.7, spreading_exponent=10.0
        )
        sea = Sea((system,), finite_depth=depth < math.inf, depth=min(depth, 1e5), wave_count=FREQUENCIES)
        expected = quadrature(spectrum_of(system, sea.water), spreading, min(depth, 1e6))
        for seed in SEEDS:
            waves = discretise(replace(sea, seed=seed), SHORTEST)
            assert len(np.unique(waves.angular_frequency)) == FREQUENCIES
            np.testing.assert_allclose(moments(waves, 0.7), expected, rtol=1e-7)


def test_directional_cut_off():
    """Truth: no wave is beyond the cut-off (but for the bend, below 10 %), and the height does not change."""
    narrow = Sea((WaveSystem(directional_cutoff=math.radians(20.0)),))
    waves, wide = discretise(narrow, SHORTEST), discretise(Sea(), SHORTEST)
    angle = np.mod(waves.direction + np.pi, TWO_PI) - np.pi
    assert np.max(np.abs(angle)) < 1.1 * math.radians(20.0)
    assert np.max(np.abs(angle)) > 0.8 * math.radians(20.0)
    np.testing.assert_array_equal(waves.amplitude, wide.amplitude)


def standard_error_in_time(waves, duration):
    """Standard deviation over random phases of the time mean of z^2 at a point, z = sum A cos(w t + e).

    Var = sum over pairs i < j of A_i^2 A_j^2 / 2 [sinc^2((w_i - w_j) T / 2) + sinc^2((w_i + w_j) T / 2)], and the
    squares of single waves.
    """
    A2, w = waves.amplitude**2, waves.angular_frequency
    difference = np.sinc((w[:, None] - w) * duration / TWO_PI) ** 2
    total = np.sinc((w[:, None] + w) * duration / TWO_PI) ** 2
    pairs = 0.5 * A2[:, None] * A2 * (difference + total)
    return math.sqrt(np.sum(np.triu(pairs, 1)) + np.sum(A2**2 * np.diag(total)) / 8.0)


def smoothed_peak(frequency, energy, width=0.1):
    """Where energy per relative bandwidth is largest, in a window of this relative width."""
    ln_f = np.log(frequency)
    grid = np.linspace(ln_f[0], ln_f[-1], 2000)
    cumulative = np.concatenate([[0.0], np.cumsum(energy)])
    index = np.searchsorted(ln_f, [grid - 0.5 * width, grid + 0.5 * width])
    return math.exp(grid[np.argmax((cumulative[index[1]] - cumulative[index[0]]) / np.exp(grid))])


@pytest.mark.parametrize("key", ["pierson_moskowitz", "jonswap"])
def test_time_series_at_a_point_gives_back_height_and_period(key):
    """Truth: Hs and Tp of a 2 h record are the sea's.

    Hs within 4 standard errors of a record of this length (computed, below 2 %), Tp within half the 10 %
    bandwidth of the periodogram's smoothing.
    """
    sea = Sea((WaveSystem(spectrum=key, fetch=1e5),), choppiness=0.0, wave_count=512, seed=5)
    waves = discretise(sea, 4.0)
    duration, step = 7200.0, 0.5
    time = np.arange(0.0, duration, step)
    z = np.zeros_like(time)
    phase = waves.phase + waves.wavenumber * (30.0 * np.cos(waves.direction) - 55.0 * np.sin(waves.direction))
    for A, omega, eps in zip(waves.amplitude, waves.angular_frequency, phase, strict=True):
        z += A * np.cos(eps - omega * time)
    some = [surface_points(waves, 30.0, -55.0, t).position[2] for t in time[[0, 77, -1]]]
    np.testing.assert_allclose(z[[0, 77, -1]], some, atol=1e-9)
    m0 = 0.5 * np.sum(waves.amplitude**2)
    error = standard_error_in_time(waves, duration)
    assert error < 0.04 * m0
    assert np.mean(z**2) == pytest.approx(m0, abs=4.0 * error)
    periodogram = np.abs(np.fft.rfft(z)) ** 2
    omega = TWO_PI * np.fft.rfftfreq(len(z), step)
    peak = spectrum_of(sea.systems[0], sea.water).peak_frequency
    assert smoothed_peak(omega[1:], periodogram[1:]) == pytest.approx(peak, rel=0.05)


def test_spatial_field_gives_back_height_and_period():
    """Truth: Hs and Tp of a still picture of the sea are the sea's.

    A field of L = 4000 m is 43 peak wavelengths wide. Its mean square has a standard error that is computed from
    the waves (Var = sum over pairs of A_i^2 A_j^2 / 2 sinc^2 of both wave number differences), below 2 %; 4 of
    those. Tp within 7.5 %, half the bandwidth of the smoothing: the picture resolves wave numbers to 2 pi / L,
    2.3 % of the peak's.
    """
    sea = Sea(choppiness=0.0, wave_count=512, seed=2)
    waves = discretise(sea, 24.0)
    L, n = 4000.0, 360
    x = np.arange(n) * (L / n)
    A2 = waves.amplitude**2
    kx, ky = (waves.wavenumber * f(waves.direction) for f in (np.cos, np.sin))
    rows = waves.amplitude * np.exp(1j * (np.outer(x, kx) + waves.phase_at(100.0)))
    z = (rows @ np.exp(1j * np.outer(ky, x))).real
    some = np.array([[0, 0], [17, 300], [359, 200]])
    points = surface_points(waves, x[some[:, 0]], x[some[:, 1]], 100.0)
    np.testing.assert_allclose(z[some[:, 0], some[:, 1]], points.position[:, 2], atol=1e-9)
    difference = np.sinc((kx[:, None] - kx) * L / TWO_PI) ** 2 * np.sinc((ky[:, None] - ky) * L / TWO_PI) ** 2
    error = math.sqrt(np.sum(np.triu(0.5 * A2[:, None] * A2 * difference, 1)))
    m0 = 0.5 * np.sum(A2)
    assert error < 0.02 * m0
    assert np.mean(z**2) == pytest.approx(m0, abs=4.0 * error)
    window = np.hanning(n)
    power = np.abs(np.fft.fft2(z * window[:, None] * window)) ** 2
    k_axis = TWO_PI * np.fft.fftfreq(n, L / n)
    k = np.hypot(k_axis[:, None], k_axis).ravel()
    order = np.argsort(k)[1:]
    peak = smoothed_peak(np.sqrt(GRAVITY * k[order]), power.ravel()[order], 0.15)
    expected = spectrum_of(sea.systems[0], DEEP_WATER).peak_frequency
    assert peak == pytest.approx(expected, rel=0.075)


@pytest.mark.parametrize("rate", [24.0, 25.0, 30.0, 30000.0 / 1001.0])
@pytest.mark.parametrize("frames", [48, 100, 250, 1001])
def test_a_loop_closes_bit_for_bit(rate, frames):
    """Truth: frame f and frame f + N are the same moment, although f / rate is rounded; also with sub-frames."""
    period = frames / rate
    waves = discretise(Sea(loop_period=period), SHORTEST)
    for frame in (*range(-3, 40), 17.25, 33.5, frames - 1):
        first = waves.phase_at(frame / rate)
        for turns in (1, -1, 40):
            np.testing.assert_array_equal(waves.phase_at((frame + turns * frames) / rate), first)
    one, other = (surface_points(waves, [3.0, -900.0], [5.0, 70.0], f / rate) for f in (1, frames + 1))
    np.testing.assert_array_equal(one.position, other.position)
    np.testing.assert_array_equal(one.velocity, other.velocity)


def test_a_loop_is_the_sea_in_between():
    """Truth: within a loop, phases run as omega t. 1e-6 rad: a loop has 2^36 moments, and under 1000 cycles."""
    waves = discretise(Sea(loop_period=20.0), SHORTEST)
    free = replace(waves, loop_period=0.0)
    for time in (0.0, 1.7, 13.77, 19.9999):
        difference = np.mod(waves.phase_at(time) - free.phase_at(time) + np.pi, TWO_PI) - np.pi
        np.testing.assert_allclose(difference, 0.0, atol=1e-6)


def test_a_loop_keeps_height_and_dispersion_and_moves_frequencies_by_half_a_step():
    """Truth: only whole multiples of 2 pi / T, k by dispersion, at most half a step off; same m0."""
    period = 30.0
    looped, free = discretise(Sea(loop_period=period), SHORTEST), discretise(Sea(), SHORTEST)
    cycles = looped.angular_frequency * period / TWO_PI
    np.testing.assert_allclose(cycles, np.rint(cycles), rtol=1e-14)
    assert np.max(np.abs(looped.angular_frequency - free.angular_frequency)) <= np.pi / period * (1.0 + 1e-12)
    np.testing.assert_allclose(looped.wavenumber, looped.angular_frequency**2 / GRAVITY, rtol=1e-14)
    np.testing.assert_array_equal(looped.amplitude, free.amplitude)


def test_draws_are_the_same_everywhere():
    """Truth: phases are 2 pi times 53-bit fractions: the same bits on every platform and NumPy."""
    phase = discretise(Sea((WaveSystem(seed=7),), seed=42), SHORTEST).phase[:4]
    assert [value.hex() for value in phase.tolist()] == PHASES


PHASES = ["0x1.c72c8e5b96531p+1", "0x1.f9d16d5b2b469p+0", "0x1.23bcafa4cd6d6p+2", "0x1.f93a524ec1ce2p-1"]


CORNERS = list(
    product(
        [0.5, 60.0],  # wind
        [10.0, 1e7],  # fetch
        [1.0, 20.0],  # gamma
        [0.05, math.inf],  # depth
        [1, 2000],  # waves
    )
)


@pytest.mark.parametrize("key", SPECTRA)
def test_corners_of_the_settings(key):
    """Truth: finite waves of positive length, of the height of the spectrum up to the cut-off, in every corner."""
    spreadings = list(SPREADINGS)
    for number, (wind, fetch, gamma, depth, count) in enumerate(CORNERS):
        system = WaveSystem(
            spectrum=key,
            spreading=spreadings[number % len(spreadings)],
            wind_speed=wind,
            fetch=fetch,
            peak_enhancement=gamma,
        )
        finite = depth < math.inf
        sea = Sea((system,), finite_depth=finite, depth=depth if finite else 1.0, wave_count=count)
        waves = discretise(sea, 0.05)
        assert count - sea.directions < len(waves) <= count
        for values in (waves.amplitude, waves.direction, waves.phase, waves.orbit_ratio):
            assert np.all(np.isfinite(values))
        assert np.all(waves.wavenumber > 0.0)
        assert np.all(np.isfinite(waves.wavenumber))
        assert np.all(waves.angular_frequency > 0.0)
        assert np.sum(waves.amplitude**2) > 0.0


def test_a_swell_against_the_wind():
    """Truth: energies add, and the slopes along the common axis too; 1e-12: sums in another order."""
    wind = WaveSystem(wave_share=0.5)
    swell = WaveSystem(
        spectrum="jonswap", sized_by="height", period=14.0, spreading="cos2s", direction=math.pi, wave_share=0.5
    )
    both = moments(discretise(Sea((wind, swell)), SHORTEST), 0.0)
    nothing = replace(wind, enabled=False)
    alone = [moments(discretise(Sea(pair), SHORTEST), 0.0) for pair in ((wind,), (nothing, swell))]
    np.testing.assert_allclose(both, np.sum(alone, axis=0), rtol=1e-12)


def test_one_wave_has_the_height_of_the_sea():
    """Truth: a single wave has all the energy, whatever its length."""
    one, many = discretise(Sea(wave_count=1), SHORTEST), discretise(Sea(), SHORTEST)
    assert len(one) == 1
    assert one.amplitude[0] ** 2 == pytest.approx(np.sum(many.amplitude**2), rel=1e-12)
