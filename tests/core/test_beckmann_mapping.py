# SPDX-License-Identifier: GPL-3.0-or-later
"""Slope variances through the sockets of Blender's closures and back by the closures' own formulas."""

import numpy as np
import pytest

from ocean_lod_addon.core.optics import beckmann
from tests.core.optics_helpers import OPS

VARIANCES = [
    (0.0316, 0.0222),
    (0.0222, 0.0316),
    (0.03, 0.03),
    (0.0316, 0.0316 / 9.0),
    (1e-4, 9e-4),
    (0.0632, 0.0414),
]


def metallic_alphas(roughness, anisotropy):
    """alpha along and across the Tangent as Cycles' Metallic closure makes them from its sockets."""
    aspect = np.sqrt(1.0 - 0.9 * anisotropy)
    return roughness**2 / aspect, roughness**2 * aspect


def glossy_alphas(roughness, anisotropy):
    """alpha along and across the Tangent as Cycles' Glossy closure makes them from its sockets."""
    if anisotropy < 0.0:
        return roughness**2 / (1.0 + anisotropy), roughness**2 * (1.0 + anisotropy)
    return roughness**2 * (1.0 - anisotropy), roughness**2 / (1.0 - anisotropy)


@pytest.mark.parametrize(("variance_x", "variance_y"), VARIANCES)
def test_the_metallic_closure_gets_the_seas_slopes(variance_x, variance_y):
    sockets = beckmann.metallic_sockets(OPS, variance_x, variance_y)
    along, across = metallic_alphas(sockets.roughness, sockets.anisotropy)
    alpha_x, alpha_y = (along, across) if sockets.along_wind else (across, along)
    assert (alpha_x, alpha_y) == pytest.approx(np.sqrt([2 * variance_x, 2 * variance_y]), rel=1e-12)
    assert 0.0 <= sockets.anisotropy <= 1.0


@pytest.mark.parametrize(("variance_x", "variance_y"), VARIANCES)
def test_the_glossy_closure_gets_the_seas_slopes(variance_x, variance_y):
    sockets = beckmann.glossy_sockets(OPS, variance_x, variance_y)
    alphas = glossy_alphas(sockets.roughness, sockets.anisotropy)
    assert alphas == pytest.approx(np.sqrt([2 * variance_x, 2 * variance_y]), rel=1e-12)


def test_below_2_4_metres_per_second_the_tangent_lies_across_the_wind():
    assert beckmann.metallic_sockets(OPS, 0.00316, 0.00492).along_wind == 0.0
    assert beckmann.metallic_sockets(OPS, 0.0316, 0.0222).along_wind == 1.0


def test_what_the_closures_cannot_hold_is_clamped_to_what_they_can():
    flat = beckmann.metallic_sockets(OPS, np.zeros(1), np.zeros(1))
    assert flat.roughness**2 == pytest.approx(np.sqrt(2.0) * 5e-4, rel=1e-12)
    assert flat.anisotropy == 0.0
    wild = beckmann.metallic_sockets(OPS, np.array([3.0]), np.array([2.0]))
    assert (wild.roughness.item(), wild.anisotropy.item()) == (1.0, 0.0)
    # Sharper than 10:1: the Metallic closure keeps the mean of the two alphas and its greatest anisotropy.
    swell = beckmann.metallic_sockets(OPS, 0.04, 0.04e-3)
    assert swell.anisotropy == pytest.approx(1.0, rel=1e-12)
    assert swell.roughness**4 == pytest.approx(2.0 * 0.04 * np.sqrt(1e-3), rel=1e-12)
    assert abs(beckmann.glossy_sockets(OPS, 0.5, 3e-9).anisotropy) <= 0.99


def test_clamps_hold_for_every_point_of_an_array():
    variances = np.array([0.0, 1e-9, 1e-4, 0.04, 0.6, 9.0])
    x, y = np.meshgrid(variances, variances)
    for sockets in (beckmann.metallic_sockets(OPS, x, y), beckmann.glossy_sockets(OPS, x, y)):
        assert np.all((sockets.roughness > 0.0) & (sockets.roughness <= 1.0))
        assert np.all(np.abs(sockets.anisotropy) <= 1.0)
