# SPDX-License-Identifier: GPL-3.0-or-later
"""The accuracy knobs: that none is missing, that their errors are right, and the same whenever they are computed.

No test here asserts how long anything takes.
"""

import math

import numpy as np
import pytest

from ocean_lod_addon.cli.cost.knobs import geometry, misprints, ripples, shading, waves
from ocean_lod_addon.cli.cost.knobs.registry import KNOBS, worth_having
from ocean_lod_addon.core.optics.smith import masked_area_exact

BY_KEY = {knob.key: knob for knob in KNOBS}

EXPECTED = {
    "wave_count": 6,
    "samples_per_wavelength": 6,
    "window_width": 5,
    "precision": 3,
    "discretisation": 4,
    "ripples": 6,
    "fresnel": 2,
    "mean_fresnel": 4,
    "erfc": 3,
    "slopes": 2,
    "slope_variance": 2,
    "anisotropy": 2,
    "equations": 2,
}
"""Every choice of the project between exact and cheap, and how many values it has at least."""

CHEAP = [key for key in EXPECTED if key not in ("wave_count", "samples_per_wavelength", "ripples")]


def errors_of(key):
    return [step.error() for step in BY_KEY[key].steps]


def test_every_choice_is_a_knob():
    assert set(BY_KEY) >= set(EXPECTED)
    assert len(BY_KEY) == len(KNOBS), "two knobs share a name"
    for key, least in EXPECTED.items():
        knob = BY_KEY[key]
        assert len(knob.steps) >= least, key
        assert len({step.value for step in knob.steps}) == len(knob.steps)
        assert all((knob.label, knob.affects, knob.error_of, knob.unit, knob.reference, knob.time_of))


@pytest.mark.parametrize("key", CHEAP)
def test_errors_fall_along_a_ladder(key):
    errors = errors_of(key)
    assert errors == sorted(errors, reverse=True)
    assert len(set(errors)) == len(errors), "a step that changes nothing is none"


@pytest.mark.parametrize("key", CHEAP)
def test_errors_are_the_same_again(key):
    assert errors_of(key) == errors_of(key)


def test_every_piece_of_work_can_be_timed():
    for key in CHEAP:
        for step in BY_KEY[key].steps:
            step.work()(0.0)


# ------------------------------------------------------------------------------------------ number of waves


def test_bessel_function():
    # Abramowitz and Stegun table 9.1, and the first zero.
    np.testing.assert_allclose(
        geometry.bessel_j0(np.array([0.0, 1.0, 10.0, 2.404825557695773])),
        [1.0, 0.7651976866, -0.2459357645, 0.0],
        atol=1e-10,
    )


def test_rare_crest_of_many_waves_is_gaussian():
    # By the central limit theorem; equal waves have an excess kurtosis of -3/(2 N), so that the quantile u = 3.09
    # falls short by 1.5/N (u^3 - 3 u)/24 = 0.00127 for N = 1000, to first order.
    amplitudes = np.full(1000, 0.02)
    sigma = math.sqrt(0.5 * 1000) * 0.02
    assert geometry.rare_crest(amplitudes) / sigma == pytest.approx(3.0902323 - 0.00127, abs=2e-5)


def test_rare_crest_agrees_with_drawing():
    # A million draws: the share beyond is 0.001 within 3.2e-5 (one standard deviation); four of them.
    amplitudes = np.geomspace(1.0, 0.1, 16)
    crest = geometry.rare_crest(amplitudes)
    random = np.random.Generator(np.random.PCG64(3))
    beyond = 0
    for _ in range(10):
        phases = random.uniform(0.0, 2.0 * np.pi, (100_000, 16))
        beyond += int(np.count_nonzero(np.cos(phases) @ amplitudes > crest))
    assert beyond / 1e6 == pytest.approx(1e-3, abs=1.28e-4)


def test_twice_the_waves_halve_the_missing_crest():
    # The excess kurtosis, and with it the missing height, goes with one over the number of waves.
    missing = [BY_KEY["wave_count"].steps[number].error() for number in (1, 2)]
    assert missing[0] / missing[1] == pytest.approx(2.0, rel=0.06)


# ---------------------------------------------------------------------------------------------- mesh


def test_mesh_error_goes_with_the_square_of_the_spacing():
    # Linear interpolation of a wave of theta = k h is off by theta^2 / sqrt(120) of its amplitude's rms.
    steps = {step.value: step for step in BY_KEY["samples_per_wavelength"].steps}
    six, twelve = (steps[f"{samples} a wavelength"].error() for samples in (6, 12))
    assert six / twelve == pytest.approx(4.0, rel=0.05)


def test_window_error_of_the_usual_window():
    # core.column_blocks: at most 0.14 % of all slope variance, where fading waves carry half of it at most.
    assert geometry.window_slope_error(0.5, 4.0, 256) < 2 * 0.0014
    # A window twice as wide falls half as steeply: a quarter of the error, at the same k reach, on average over
    # what is left of the wave.
    narrow, wide = (geometry.window_slope_error(start, 4.0, 256) for start in (0.5, 0.0))
    assert narrow / wide == pytest.approx(4.0, rel=1e-3)


# -------------------------------------------------------------------------------------------- discretisation


def test_rules_have_the_errors_of_the_theory():
    # THEORY section 3 for 64 bins to 12 rad/s: equal energies -43 %, geometric middles 0.16 %, ours 0 to rounding.
    errors = dict(zip(("energy", "frequency", "middles", "ours"), errors_of("discretisation"), strict=True))
    assert 35.0 < errors["energy"] < 50.0
    assert 0.1 < errors["middles"] < 0.3
    assert errors["ours"] < 1e-9


def test_equal_energies_are_equal():
    _, amplitude = waves.equal_energy()
    assert np.ptp(amplitude) == 0.0


# ------------------------------------------------------------------------------------------------ ripples


def test_wrong_share_counts_what_is_moved_once():
    wanted = np.array([[0.5, 0.5, 0.0], [0.5, 0.5, 0.0]])
    nothing = np.zeros_like(wanted)
    moved = np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    turned = np.array([[1.0, 0.0, 0.0], [0.5, 0.5, 0.0]])
    assert ripples.wrong_share(wanted, wanted) == 0.0
    assert ripples.wrong_share(nothing, wanted) == 1.0
    assert ripples.wrong_share(moved, wanted) == 0.5  # one of two classes is at the other's length
    assert ripples.wrong_share(turned, wanted) == 0.25  # half of one of two runs across instead of along


def test_spectral_ripples_are_the_spectrum_and_random_ones_are_not():
    steps = {step.value: step for step in BY_KEY["ripples"].steps}
    none, random, spectral = (steps[name].error() for name in ("none", "random, still", "spectral, 256"))
    assert none == 100.0
    assert 30.0 < random < 100.0
    assert spectral < 2.0


# ------------------------------------------------------------------------------------------------ shading


def test_shading_errors_are_those_of_the_theory():
    # THEORY section 7: Schlick is 22.7 % off at 51.2 degrees; section 6: Eq. 19 is 0.058 % off in 1 + Lambda,
    # Abramowitz and Stegun 7e-8; section 8: f(0.3) = 0.04606080, its linear form 0.045.
    assert errors_of("fresnel")[0] == pytest.approx(22.7, abs=0.05)
    eq19, polynomial, _ = errors_of("erfc")
    assert eq19 == pytest.approx(0.058, abs=0.001)
    assert polynomial < 100.0 * 2 * 7.5e-8 * 4
    assert errors_of("slope_variance")[0] == pytest.approx(100.0 * (1.0 - 0.045 / 0.04606079858), abs=1e-6)


def test_equations_in_angles_are_the_stable_form():
    slopes = shading.gaussian_slopes(smith_masked_area=masked_area_exact)
    stable = shading.glitter(slopes)
    angles = misprints.glitter_of_equations(
        shading.glitter_views(), shading.sun(), shading.slope_deviations(shading.WIND)
    )
    np.testing.assert_allclose(angles, stable, rtol=1e-9, atol=1e-12)


def test_misprints_have_the_errors_of_the_theory():
    # THEORY section 1: the height field's normal is 3.1 degrees off at k A = 0.3; every misprint is off.
    errors = {(m.equation, m.printed): m.error() for m in misprints.MISPRINTS}
    assert errors["3-4", "derivatives of the height"] == pytest.approx(3.14, abs=0.01)
    assert all(error > 0.5 for error in errors.values())
    # Directions spread evenly about 0 are on average 45 degrees and their own spread from 45 degrees.
    assert errors["2", "phase k (x0 + y0)"] > 45.0


# ---------------------------------------------------------------------------------------- worth having


def test_a_step_that_costs_more_and_is_no_better_is_left_out():
    errors, times = [4.0, 3.0, 3.5, 1.0, 0.0], [1.0, 2.0, 3.0, 1.5, 9.0]
    assert worth_having(errors, times) == [True, False, False, True, True]


def test_steps_that_tie_stay():
    assert worth_having([1.0, 1.0], [2.0, 2.0]) == [True, True]
    assert worth_having([1.0, 1.0], [2.0, 1.0]) == [False, True]
