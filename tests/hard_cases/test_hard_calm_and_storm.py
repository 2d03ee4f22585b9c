# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of no wind, a breath and a hurricane."""

import numpy as np

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.lod import Grid
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics.cox_munk import skewness_c03, skewness_c21, slope_variance_across
from ocean_lod_addon.core.optics.mean_fresnel import mean_over_visible_slopes
from ocean_lod_addon.core.optics.slope_density import (
    GaussianSlopes,
    GramCharlierSlopes,
    gaussian,
    gram_charlier_factor,
    slope_deviation,
)
from ocean_lod_addon.core.optics.smith import masked_area_exact
from ocean_lod_addon.core.roughness import cox_munk_along_across
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.slope_budget import resolved_sums, unresolved_slope_variance, wave_tensors
from ocean_lod_addon.core.spectra.pierson_moskowitz import pierson_moskowitz_from_wind
from ocean_lod_addon.core.wind import PIERSON_MOSKOWITZ_HEIGHT, wind_at_height
from tests.hard_cases.catalogue import FLOAT32_ROUNDING, hard_case

OPS = NumpyOps()

QUADRATURE = 1e-12
QUADRATURE_BECAUSE = "64 x 64 Gauss points on 9 standard deviations converge to 1e-13"


def significant_height(waves):
    return 4.0 * np.sqrt(0.5 * np.sum(waves.amplitude**2))


def naive_waves(wind_speed):
    """64 equal steps of frequency from 0.3 to 12 rad/s, which suits a wind of 10 m/s."""
    U = np.float64(wind_at_height(wind_speed, PIERSON_MOSKOWITZ_HEIGHT))
    edges = np.linspace(0.3, 12.0, 65)
    w = 0.5 * (edges[1:] + edges[:-1])
    with np.errstate(all="ignore"):
        S = 8.1e-3 * GRAVITY**2 * w**-5 * np.exp(-0.74 * (GRAVITY / (U * w)) ** 4)
        return np.sqrt(2.0 * S * np.diff(edges))


def height_of_a_wind(wind_speed, shortest_wavelength):
    """Relative errors of the significant height, naive and ours, against the closed form."""
    U = wind_at_height(wind_speed, PIERSON_MOSKOWITZ_HEIGHT)
    truth = 2.0 * np.sqrt(8.1e-3 / 0.74) * U * U / GRAVITY
    ours = significant_height(discretise(Sea(systems=(WaveSystem(wind_speed=wind_speed),)), shortest_wavelength))
    naive = 4.0 * np.sqrt(0.5 * np.sum(naive_waves(wind_speed) ** 2))
    return float(abs(naive / truth - 1.0)), float(abs(ours / truth - 1.0))


@hard_case(
    title="wind 0: the peak frequency",
    truth="there are no waves",
    naive="g / U, as the spectrum's formulas say",
    error="number of waves that are there, infinite if 1 / 0",
    bound=0.0,
    because="a calm has no spectrum",
)
def test_no_wind():
    with np.errstate(divide="ignore"):
        naive = GRAVITY / np.float64(0.0)
    return float(naive), float(len(discretise(Sea(systems=(WaveSystem(wind_speed=0.0),)), 0.01)))


@hard_case(
    title="wind 10^-30 m/s, as a slider that is dragged to 0 may leave it",
    truth="there are no waves",
    naive="the spectrum's closed forms",
    error="number of waves that are there, no number if 0 / 0",
    bound=0.0,
    because="powers of so small a size underflow; below 10^-6 is calm",
)
def test_next_to_no_wind():
    U = np.float64(1e-100)
    with np.errstate(all="ignore"):
        naive = U**4 / (U**4 * U**0)
    return float(naive), float(len(discretise(Sea(systems=(WaveSystem(wind_speed=1e-100),)), 0.01)))


@hard_case(
    title="wind 0.1 m/s: waves of millimetres",
    truth="Hs = 0.2093 U^2 / g",
    naive="64 frequencies from 0.3 to 12 rad/s",
    error="Hs, relative",
    bound=1e-6,
    because="1.4e-6 of the energy is beyond the cut-off at 31 omega_p, half of that in Hs; the rest is exact",
)
def test_a_breath_of_wind():
    return height_of_a_wind(0.1, 1e-5)


@hard_case(
    title="wind 60 m/s: waves of a kilometre",
    truth="Hs = 0.2093 U^2 / g",
    naive="64 frequencies from 0.3 to 12 rad/s",
    error="Hs, relative",
    bound=1e-6,
    because="1e-8 of the energy lies beyond the tail cut; the rest is exact",
)
def test_a_hurricane():
    return height_of_a_wind(60.0, 0.1)


def visible_area(slopes, view):
    """int q, Eq. 21: 1."""
    return mean_over_visible_slopes(OPS, lambda cosine: np.ones_like(cosine), view, slopes)


def view_at(elevation, azimuth):
    c = np.cos(elevation)
    return c * np.cos(azimuth), c * np.sin(azimuth), np.sin(elevation)


@hard_case(
    title="a mirror: sigma = 0",
    truth="the visible slopes add up to 1 (Eq. 21)",
    naive="sigma as Cox and Munk give it for U = 0",
    error="the sum, less 1",
    bound=QUADRATURE,
    because=QUADRATURE_BECAUSE,
)
def test_a_mirror():
    view = view_at(0.05, 0.4)
    along, across = cox_munk_along_across(WaveSystem(wind_speed=0.0))
    ours = GaussianSlopes(slope_deviation(OPS, along), slope_deviation(OPS, across), masked_area_exact)
    naive = GaussianSlopes(np.float64(0.0), np.sqrt(slope_variance_across(0.0)), masked_area_exact)
    with np.errstate(all="ignore"):
        off = visible_area(naive, view)
    return abs(off - 1.0), abs(visible_area(ours, view) - 1.0)


@hard_case(
    title="anisotropy 1000:1",
    truth="the visible slopes add up to 1 (Eq. 21)",
    naive="cos^2 phi as 1 / (1 + phi^2), as one shader does",
    error="the sum, less 1",
    bound=QUADRATURE,
    because=QUADRATURE_BECAUSE,
)
def test_a_thousandfold_anisotropy():
    naive = ours = 0.0
    for azimuth in (0.0, 0.3, 0.8, np.pi / 2):
        view = view_at(0.05, azimuth)
        slopes = GaussianSlopes(0.3, 3e-4, masked_area_exact)
        total = visible_area(slopes, view)
        ours = max(ours, abs(total - 1.0))
        s_v = slopes.sigma_x * np.cos(0.05) / np.sqrt(1.0 + azimuth**2)
        shown = view[2] + masked_area_exact(OPS, view[2], s_v)
        naive = max(naive, abs(total * (view[2] + slopes.masked_area(OPS, view)) / shown - 1.0))
    return float(naive), float(ours)


def widest_negative(wind_speed):
    """The most negative density, over the Gaussian's peak, of the series as printed and as we clamp it."""
    X, Y = np.meshgrid(np.linspace(-8.0, 8.0, 401), np.linspace(-8.0, 8.0, 401))
    p0 = gaussian(OPS, X, Y, 1.0, 1.0)
    printed = p0 * gram_charlier_factor(OPS, X, Y, skewness_c21(wind_speed), skewness_c03(wind_speed))
    ours = GramCharlierSlopes(1.0, 1.0, wind_speed=wind_speed).density(OPS, X, Y)
    return float(-printed.min() / p0.max()), float(-ours.min() / p0.max())


@hard_case(
    title="Gram-Charlier series in a wind of 30 m/s",
    truth="no slope has a negative probability",
    naive="Eq. 8 as printed",
    error="largest negative density, over the peak",
    bound=0.0,
    because="clamped at 0, skewness held at 15 m/s",
)
def test_the_series_in_a_storm():
    return widest_negative(30.0)


@hard_case(
    title="Gram-Charlier series of 30 m/s, clamped",
    truth="all slopes together have probability 1",
    naive="clamped, not divided by what is then too much",
    error="total, less 1",
    bound=1.5e-6,
    because="the fit to the clamped mass is within 1e-6; 5e-7 for the sum over a grid with a kink",
)
def test_the_clamped_series_in_a_storm():
    axis = np.linspace(-9.0, 9.0, 1801)
    X, Y = np.meshgrid(axis, axis)
    cell = (axis[1] - axis[0]) ** 2
    p0 = gaussian(OPS, X, Y, 1.0, 1.0)
    clamped = p0 * np.maximum(gram_charlier_factor(OPS, X, Y, skewness_c21(30.0), skewness_c03(30.0)), 0.0)
    ours = GramCharlierSlopes(1.0, 1.0, wind_speed=30.0).density(OPS, X, Y)
    return float(abs(clamped.sum() * cell - 1.0)), float(abs(ours.sum() * cell - 1.0))


@hard_case(
    title="wind 3 m/s: the mesh shows more slope than Cox and Munk allow",
    truth="what is left to shading is no negative variance",
    naive="Cox-Munk variance, less what the mesh shows",
    error="most negative variance left, over the total",
    bound=8 * FLOAT32_ROUNDING,
    because="no less than the spectrum carries; float32 sum of fractions, and the larger eigenvalue's rounding",
)
def test_a_budget_smaller_than_what_is_resolved():
    sea = Sea(systems=(WaveSystem(wind_speed=3.0),), wave_count=256)
    grid = Grid(cell_size=2.5e-3, cells=64, levels=4)
    waves = discretise(sea, grid.shortest_wavelength)
    along, across = cox_munk_along_across(sea.systems[0])
    shown = resolved_sums(grid, waves, wave_tensors(waves)).astype(np.float64)
    left = unresolved_slope_variance(sea, grid, waves).astype(np.float64)
    mean, half = 0.5 * (left[:, 0] + left[:, 1]), 0.5 * (left[:, 0] - left[:, 1])
    smallest = (mean - np.hypot(half, left[:, 2])).min()
    naive = min((along - shown[:, 0]).min(), (across - shown[:, 1]).min())
    return float(max(-naive, 0.0) / (along + across)), float(max(-smallest, 0.0) / (along + across))


@hard_case(
    title="energy below the first bin in a hurricane",
    truth="S(omega) -> 0 faster than any power as omega -> 0",
    naive="alpha g^2 omega^-5 exp(-B / omega^4) at omega = 0",
    error="S(0)",
    bound=0.0,
    because="bins start at 0.15 omega_p, where exp(-B / omega^4) underflows to 0",
)
def test_the_spectrum_at_no_frequency():
    spectrum = pierson_moskowitz_from_wind(60.0)
    with np.errstate(all="ignore"):
        naive = spectrum.density(np.float64(0.0))
    return float(naive), float(spectrum.density(np.float64(0.15 * spectrum.peak_frequency)))
