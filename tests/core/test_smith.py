# SPDX-License-Identifier: GPL-3.0-or-later
"""erfc without scipy, and Smith's masking in the form that survives grazing."""

import math

import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import erf, smith
from tests.core.optics_helpers import OPS, SEAS, direction

GRAZING_TO_ZENITH = np.concatenate([[0.0], np.logspace(-8.0, 8.0, 400)])
"""Ratios w_z/s_w."""


def test_erfc_is_the_standard_librarys():
    x = np.linspace(-6.0, 26.0, 641)
    expected = [math.erfc(value) for value in x]
    # exp(-x^2) rounds x^2 to 1e-16 of itself: 7e-14 at x = 26.
    np.testing.assert_allclose(erf.erfc(x), expected, rtol=1.5e-13)
    inside = np.abs(x) < 2.0
    np.testing.assert_allclose(erf.erfc(x)[inside], np.array(expected)[inside], rtol=2e-15)


def test_erfcx_has_its_series_at_0_and_its_tail_at_infinity():
    x = np.array([0.0, 1e-12, 1e-6])
    np.testing.assert_allclose(erf.erfcx(x), 1.0 - 2.0 * x / math.sqrt(math.pi) + x * x, rtol=3e-16)
    x = np.array([1e4, 1e8, 1e100])
    tail = (1.0 - 0.5 / x / x) / (x * math.sqrt(math.pi))
    np.testing.assert_allclose(erf.erfcx(x), tail, rtol=1e-15)  # next term 3/(4 x^4)
    assert erf.erfcx(np.inf) < 1e-149


def test_erfcx_has_no_step_where_the_pole_term_ends():
    edge = 2.0 * math.pi
    below, above = erf.erfcx(np.nextafter(edge, 0.0)), erf.erfcx(np.nextafter(edge, 7.0))
    assert below == pytest.approx(float(above), rel=1e-15)


def test_the_papers_erfc_is_as_good_as_the_documentation_says():
    x = np.linspace(0.0, 6.0, 6001)
    relative = erf.erfc_eq19(OPS, x) / erf.erfc(x) - 1.0
    assert np.abs(relative).max() == pytest.approx(0.00277, abs=2e-5)


@pytest.mark.parametrize("theta", [0.0, 0.5, 1.2, 1.5, 1.57, math.pi / 2])
@pytest.mark.parametrize("sea", SEAS)
def test_shown_and_masked_area_are_the_mean_of_what_faces_the_direction(sea, theta):
    # Smith: w_z + M is the mean over the slopes of max(w_z - w_xy . zeta, 0), zeta . w_xy normal of deviation s.
    w = direction(theta, 0.7)
    s = float(smith.slope_spread(OPS, w[0], w[1], *np.sqrt(SEAS[sea])))
    nodes, weights = np.polynomial.legendre.leggauss(120)
    reach = min(10.0, w[2] / s)
    T = 0.5 * (reach + 10.0) * nodes + 0.5 * (reach - 10.0)
    mean = 0.5 * (reach + 10.0) * weights @ ((w[2] - s * T) * np.exp(-0.5 * T * T)) / math.sqrt(2.0 * math.pi)
    assert w[2] + smith.masked_area_exact(OPS, w[2], s) == pytest.approx(mean, rel=1e-13)


def test_lambda_and_masked_area_are_the_same_thing():
    theta, phi = np.meshgrid(np.linspace(0.3, 1.57, 40), np.linspace(0.0, 3.0, 7))
    w = direction(theta, phi)
    s = smith.slope_spread(OPS, w[0], w[1], *np.sqrt(SEAS["rough"]))
    Lambda = smith.smith_lambda(smith.a_of_direction(theta, phi, *SEAS["rough"]))
    # Lambda cancels to 1e-13 of what it is made of, at most 1 here.
    np.testing.assert_allclose(smith.masked_area_exact(OPS, w[2], s) / w[2], Lambda, rtol=1e-12, atol=1e-15)


def test_the_affordable_form_keeps_1_plus_lambda_and_the_papers_would_not():
    s = 0.2
    w_z = GRAZING_TO_ZENITH * s
    shown = w_z + smith.masked_area_exact(OPS, w_z, s)
    error = (smith.masked_area(OPS, w_z, s) - smith.masked_area_exact(OPS, w_z, s)) / shown
    assert np.abs(error).max() < 1e-7
    a = GRAZING_TO_ZENITH[1:] / math.sqrt(2.0)
    a = a[a < 8.0]
    error = (smith.smith_lambda_eq19(OPS, a) - smith.smith_lambda(a)) / (1.0 + smith.smith_lambda(a))
    assert np.abs(error).max() == pytest.approx(5.84e-4, abs=1e-5)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_nothing_is_masked_at_the_zenith_and_a_finite_area_at_grazing(dtype):
    ops, sigma = NumpyOps(dtype), np.full(1, 0.2, dtype)
    one, zero = np.ones(1, dtype), np.zeros(1, dtype)
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        zenith = smith.masked_area(ops, one, smith.slope_spread(ops, zero, zero, sigma, sigma))
        grazing = smith.masked_area(ops, zero, smith.slope_spread(ops, one, zero, sigma, sigma))
    assert zenith.item() == 0.0
    assert zenith.dtype == grazing.dtype == dtype
    assert grazing.item() == pytest.approx(0.2 / math.sqrt(2.0 * math.pi), rel=1e-6)


def test_a_is_infinite_and_lambda_0_at_the_zenith():
    a = smith.a_of_direction(0.0, 0.0, 0.03, 0.02)
    assert a == np.inf
    assert smith.smith_lambda(a) == 0.0


def test_lambda_tends_to_its_grazing_series():
    a = np.array([1e-3, 1e-5])
    series = 1.0 / (2.0 * a * math.sqrt(math.pi)) - 0.5 + a / (2.0 * math.sqrt(math.pi))
    # The next term is a^3/12/sqrt(pi), against 1/(2 a sqrt(pi)): a^4/6 relative.
    np.testing.assert_allclose(smith.smith_lambda(a), series, rtol=1e-12)
