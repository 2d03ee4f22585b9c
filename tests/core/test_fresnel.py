# SPDX-License-Identifier: GPL-3.0-or-later
"""The Fresnel factor of one facet of water."""

import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import fresnel

OPS = NumpyOps()
N = 1.333


def test_normal_incidence_reflects_the_square_of_the_index_contrast():
    assert fresnel.exact(OPS, 1.0, N) == pytest.approx((0.333 / 2.333) ** 2, rel=1e-14)
    assert fresnel.schlick(OPS, 1.0, N) == pytest.approx((0.333 / 2.333) ** 2, rel=1e-14)


def test_grazing_incidence_reflects_everything():
    assert fresnel.exact(OPS, 0.0, N) == 1.0
    assert fresnel.schlick(OPS, 0.0, N) == pytest.approx(1.0, rel=1e-15)


def test_at_brewsters_angle_only_the_s_polarised_half_is_reflected():
    # tan theta = n: the p-polarised wave is not reflected, the s-polarised one by ((n^2-1)/(n^2+1))^2.
    cos_brewster = 1.0 / np.sqrt(1.0 + N * N)
    expected = 0.5 * ((N * N - 1.0) / (N * N + 1.0)) ** 2
    assert fresnel.exact(OPS, cos_brewster, N) == pytest.approx(expected, rel=1e-14)


def test_exact_is_fresnels_law_in_angles():
    # sin^2 and tan^2 of difference over sum of the angles of incidence and refraction (Snell).
    theta = np.linspace(0.01, 1.57, 200)
    refracted = np.arcsin(np.sin(theta) / N)
    s = (np.sin(theta - refracted) / np.sin(theta + refracted)) ** 2
    p = (np.tan(theta - refracted) / np.tan(theta + refracted)) ** 2
    # Angles lose digits where they are small and close: 0.01 rad costs two of sixteen.
    np.testing.assert_allclose(fresnel.exact(OPS, np.cos(theta), N), 0.5 * (s + p), rtol=1e-12)


def test_more_is_reflected_the_more_grazing():
    F = fresnel.exact(OPS, np.linspace(0.0, 1.0, 1001), N)
    assert np.all(np.diff(F) < 0.0)


def test_float32_keeps_its_digits_at_every_angle():
    c = np.linspace(0.0, 1.0, 10_001, dtype=np.float32)
    F = fresnel.exact(NumpyOps(np.float32), c, np.full(1, N, np.float32))
    reference = fresnel.exact(OPS, c.astype(np.float64), float(np.float32(N)))
    assert F.dtype == np.float32
    # Eight roundings of 6e-8 and the subtraction n^2 c - G near Brewster's angle, which is squared and added
    # to the larger s-polarised part.
    np.testing.assert_allclose(F, reference, rtol=1e-6)


def test_schlick_is_as_wrong_as_the_documentation_says():
    c = np.cos(np.radians(np.linspace(0.0, 90.0, 9001)))
    exact, schlick = fresnel.exact(OPS, c, N), fresnel.schlick(OPS, c, N)
    relative = schlick / exact - 1.0
    assert relative.min() == pytest.approx(-0.227, abs=0.001)
    assert np.degrees(np.arccos(c[relative.argmin()])) == pytest.approx(51.2, abs=0.5)
    assert (schlick - exact).max() == pytest.approx(0.0592, abs=1e-4)
