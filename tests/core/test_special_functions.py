# SPDX-License-Identifier: GPL-3.0-or-later
"""Special functions against SciPy's, over the range the sea needs."""

import numpy as np
import scipy.special

from ocean_lod_addon.core.special import exponential_integral_e1, incomplete_beta, log_gamma


def test_exponential_integral():
    """1e-13: a series of 40 and a continued fraction of 120 terms, each exact to rounding on its side of x = 2."""
    x = np.concatenate([np.geomspace(1e-8, 600.0, 500), [1.999999, 2.0, 2.000001]])
    np.testing.assert_allclose(exponential_integral_e1(x), scipy.special.exp1(x), rtol=1e-13)
    assert exponential_integral_e1(1e4) == 0.0


def test_log_gamma():
    """1e-14 of the largest term that is added: ten logarithms below x = 10, a series to 1e-16 above."""
    x = np.geomspace(1e-3, 1e4, 500)
    expected = scipy.special.gammaln(x)
    np.testing.assert_allclose(log_gamma(x), expected, rtol=1e-14, atol=1e-13)


def test_incomplete_beta():
    """5e-12: exp of a difference of log-gammas near 6000 at the largest b, whose rounding is 1e-12."""
    a, b, x = np.meshgrid([0.5, 1.5, 2.5], np.geomspace(0.5, 1000.5, 25), np.linspace(0.0, 1.0, 101) ** 3)
    np.testing.assert_allclose(incomplete_beta(a, b, x), scipy.special.betainc(a, b, x), rtol=5e-12, atol=1e-300)


def test_incomplete_beta_elements_are_independent():
    """Truth: an element does not depend on which others are computed with it; equal bit for bit."""
    b, x = np.geomspace(0.5, 1000.0, 37), np.linspace(0.01, 0.99, 37)
    together = incomplete_beta(0.5, b, x)
    alone = [incomplete_beta(0.5, b[i : i + 1], x[i : i + 1])[0] for i in range(37)]
    np.testing.assert_array_equal(together, alone)
