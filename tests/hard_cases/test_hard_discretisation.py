# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of the number of waves and of the tails of spectra."""

import numpy as np

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise, integrate_bins, representative_waves
from ocean_lod_addon.core.dispersion import DEEP_WATER, angular_frequency
from ocean_lod_addon.core.sea import Sea
from ocean_lod_addon.core.special import exponential_integral_e1
from ocean_lod_addon.core.spectra.pierson_moskowitz import PHILLIPS_ALPHA, pierson_moskowitz_from_wind
from ocean_lod_addon.core.spreading.cos2 import cosine_squared
from ocean_lod_addon.core.waves import TWO_PI
from ocean_lod_addon.core.wind import PIERSON_MOSKOWITZ_HEIGHT, wind_at_height
from tests.hard_cases.catalogue import FLOAT64_ROUNDING, hard_case

SHORTEST = 0.4
CUTOFF = float(angular_frequency(TWO_PI / SHORTEST))
U = wind_at_height(10.0, PIERSON_MOSKOWITZ_HEIGHT)
B = 0.74 * (GRAVITY / U) ** 4
HEIGHT_VARIANCE = PHILLIPS_ALPHA * GRAVITY**2 / (4.0 * B) * np.exp(-B / CUTOFF**4)
"""m0 of a Pierson-Moskowitz sea at 10 m/s up to the cut-off, closed form."""
SLOPE_VARIANCE = 0.25 * PHILLIPS_ALPHA * float(exponential_integral_e1(B / CUTOFF**4))
"""Its slope variance, (alpha / 4) E1(B / omega_c^4)."""

QUADRATURE = 1000 * FLOAT64_ROUNDING
QUADRATURE_BECAUSE = "Gauss-Legendre panels of 0.05 in ln omega converge to rounding; sums of some hundred terms"


def variances(waves):
    return np.array([0.5 * np.sum(waves.amplitude**2), 0.5 * np.sum((waves.amplitude * waves.wavenumber) ** 2)])


def errors_with(count):
    """The larger relative error of height and slope variance: equal-energy waves, and ours."""
    truth = np.array([HEIGHT_VARIANCE, SLOPE_VARIANCE])
    share = (np.arange(count) + 0.5) / count
    omega = (B / -np.log(share)) ** 0.25
    k = omega**2 / GRAVITY
    energy = PHILLIPS_ALPHA * GRAVITY**2 / (4.0 * B) / count
    naive = np.array([energy * count, energy * np.sum(k * k)])
    ours = variances(discretise(Sea(wave_count=count), SHORTEST))
    return tuple(float(np.abs(values / truth - 1.0).max()) for values in (naive, ours))


def case_of(count, named):
    return {
        "title": f"a sea of {named}",
        "truth": "m0 and the slope variance of the spectrum, closed form",
        "naive": "waves of equal energy",
        "error": "variance, relative",
        "bound": QUADRATURE,
        "because": QUADRATURE_BECAUSE,
    }


@hard_case(**case_of(1, "one wave"))
def test_one_wave():
    return errors_with(1)


@hard_case(**case_of(2, "two waves"))
def test_two_waves():
    return errors_with(2)


@hard_case(**case_of(4096, "4096 waves"))
def test_the_most_waves():
    return errors_with(4096)


@hard_case(
    title="a cut-off below the peak: bins without energy",
    truth="a bin without energy has a wave without height",
    naive="k^2 = int k^2 S / int S",
    error="waves that are no number, share",
    bound=0.0,
    because="an empty bin takes its middle frequency",
)
def test_bins_without_energy():
    spectrum = pierson_moskowitz_from_wind(10.0)
    edges = np.geomspace(0.02, 0.2, 33) * spectrum.peak_frequency
    bins = integrate_bins(spectrum, cosine_squared(), np.pi, DEEP_WATER, edges)
    with np.errstate(invalid="ignore"):
        naive = np.sqrt(bins.slope_variance / bins.energy)
    k, omega = representative_waves(bins, DEEP_WATER, 0.0)
    ours = ~(np.isfinite(k) & np.isfinite(omega) & (k > 0.0))
    return float(np.isnan(naive).mean()), float(ours.mean())


@hard_case(
    title="waves of identical frequency in 8 directions",
    truth="the sea is as rough in one place as in another, over time",
    naive="a table of frequencies times directions",
    error="pairs of waves that stand still against each other, share",
    bound=0.0,
    because="every wave has a bin of its own",
)
def test_no_two_waves_share_a_frequency():
    waves = discretise(Sea(wave_count=128, directions=8), SHORTEST)
    pairs = len(waves) * (len(waves) - 1) / 2
    naive = 16 * 8 * 7 / 2 / pairs
    same = np.triu(waves.angular_frequency[:, None] == waves.angular_frequency, 1).sum() / pairs
    return float(naive), float(same)


@hard_case(
    title="the slope variance diverges with the cut-off (here 1 mm)",
    truth="(alpha / 4) E1(B / omega_c^4)",
    naive="64 equal steps of frequency up to the cut-off",
    error="slope variance, relative",
    bound=QUADRATURE,
    because=QUADRATURE_BECAUSE,
)
def test_a_spectrum_whose_slopes_diverge():
    cutoff = float(angular_frequency(TWO_PI / 1e-3))
    truth = 0.25 * PHILLIPS_ALPHA * float(exponential_integral_e1(B / cutoff**4))
    edges = np.linspace(0.0, cutoff, 65)
    w = 0.5 * (edges[1:] + edges[:-1])
    k = w * w / GRAVITY
    naive = np.sum(k * k * pierson_moskowitz_from_wind(U).density(w) * np.diff(edges))
    ours = variances(discretise(Sea(), 1e-3))[1]
    return float(abs(naive / truth - 1.0)), float(abs(ours / truth - 1.0))


@hard_case(
    title="a loop of 2 s: long waves move to other frequencies",
    truth="dispersion holds for the waves that are left",
    naive="the frequency is rounded, the wavenumber kept",
    error="omega^2 / (g k), less 1",
    bound=8 * FLOAT64_ROUNDING,
    because="k follows from the rounded frequency: two operations, and two for the test",
)
def test_a_short_loop_keeps_dispersion():
    free, looped = (discretise(Sea(loop_period=period), SHORTEST) for period in (0.0, 2.0))
    naive = np.abs(looped.angular_frequency**2 / (GRAVITY * free.wavenumber) - 1.0).max()
    ours = np.abs(looped.angular_frequency**2 / (GRAVITY * looped.wavenumber) - 1.0).max()
    return float(naive), float(ours)


@hard_case(
    title="long shots: 64 waves of equally spaced frequency repeat after 34 s",
    truth="the correlation of the sea with itself half a minute later is that of the spectrum",
    naive="64 equal steps of frequency from 0.3 to 12 rad/s",
    error="correlation after 34 s",
    bound=0.4,
    because="n waves of random phase: 3 sqrt(sum E^2 / 2) / m0 = 0.4 for the energies of 128 waves",
)
def test_the_sea_does_not_repeat():
    edges = np.linspace(0.3, 12.0, 65)
    w = 0.5 * (edges[1:] + edges[:-1])
    energy = pierson_moskowitz_from_wind(U).density(w)
    period = TWO_PI / (w[1] - w[0])
    waves = discretise(Sea(), SHORTEST)

    def correlation(omega, energy):
        turned = np.exp(1j * omega * period)
        return float(abs(np.sum(energy * turned)) / np.sum(energy))

    return correlation(w, energy), correlation(waves.angular_frequency, waves.amplitude**2)
