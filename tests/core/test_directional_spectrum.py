# SPDX-License-Identifier: GPL-3.0-or-later
"""The elevation spectrum over the wavenumber plane."""

import math

import numpy as np
import pytest

from ocean_lod_addon.core.directional import elevation_spectrum, system_elevation_spectrum
from ocean_lod_addon.core.readback import theoretical_statistics
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectra.table import SPECTRA
from ocean_lod_addon.core.spreading.table import SPREADINGS


def polar_integrals(sea, low, high):
    """m0 and slope tensor (xx, yy, xy) from low to high in rad/m: Gauss-Legendre in ln k, sums over directions."""
    nodes, weights = np.polynomial.legendre.leggauss(300)
    half = 0.5 * math.log(high / low)
    k = np.exp(math.log(low) + half * (nodes + 1.0))[:, None]
    n = 360
    theta = (np.arange(n) + 0.5) * (2.0 * np.pi / n)
    kx, ky = k * np.cos(theta), k * np.sin(theta)
    density = elevation_spectrum(sea, kx, ky) * k * k * (half * weights)[:, None] * (2.0 * np.pi / n)
    return [float(np.sum(density * factor)) for factor in (1.0, kx * kx, ky * ky, kx * ky)]


@pytest.mark.parametrize("key", SPECTRA)
@pytest.mark.parametrize("spreading", SPREADINGS)
def test_its_integral_is_the_variance(key, spreading):
    """Truth: int Psi dk = m0 = Hs^2 / 16. 1e-4: the sum over directions, in steps of one degree."""
    system = WaveSystem(spectrum=key, spreading=spreading, direction=math.radians(20.0))
    sea = Sea((system,), finite_depth=True, depth=30.0)
    m0 = theoretical_statistics(sea, 0.0).significant_wave_height ** 2 / 16.0
    assert polar_integrals(sea, 2e-3, 50.0)[0] == pytest.approx(m0, rel=1e-4)


def test_systems_add_and_slopes_have_their_directions():
    """Truth: slope tensor of the plane = slope variances of the read-back, along and across the axis.

    1e-4: the sum over directions, in steps of one degree; waves shorter than 17 mm are left out on both sides.
    """
    axis = math.radians(20.0)
    systems = (WaveSystem(direction=axis), WaveSystem(wind_speed=5.0, direction=math.radians(85.0), seed=4))
    sea = Sea(systems)
    _, xx, yy, xy = polar_integrals(sea, 1e-3, 2.0 * np.pi / 0.017)
    c, s = math.cos(axis), math.sin(axis)
    along = xx * c * c + 2.0 * xy * c * s + yy * s * s
    theory = theoretical_statistics(sea, axis)
    assert along == pytest.approx(theory.slope_variance_along, rel=1e-4)
    assert xx + yy - along == pytest.approx(theory.slope_variance_across, rel=1e-4)
    kx, ky = np.array([0.05, 0.3]), np.array([0.02, -0.1])
    parts = system_elevation_spectrum(sea, 0, kx, ky) + system_elevation_spectrum(sea, 1, kx, ky)
    np.testing.assert_array_equal(elevation_spectrum(sea, kx, ky), parts)


def test_cut_off_and_origin():
    """Truth: nothing beyond the cut-off, nothing at k = 0, all the energy within."""
    sea = Sea((WaveSystem(directional_cutoff=math.radians(17.0)),))
    angle = np.radians([0.0, 16.9, -16.9, 17.1, 180.0])
    density = elevation_spectrum(sea, 0.1 * np.cos(angle), 0.1 * np.sin(angle))
    np.testing.assert_array_equal(density > 0.0, [True, True, True, False, False])
    assert elevation_spectrum(sea, 0.0, 0.0) == 0.0
    narrow, wide = (polar_integrals(s, 2e-3, 50.0)[0] for s in (sea, Sea()))
    assert narrow == pytest.approx(wide, rel=1e-4)


def test_no_wind_no_spectrum():
    assert np.all(elevation_spectrum(Sea((WaveSystem(wind_speed=0.0),)), np.ones(3), np.zeros(3)) == 0.0)
