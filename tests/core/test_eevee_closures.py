# SPDX-License-Identifier: GPL-3.0-or-later
"""The normal with which EEVEE looks where it is meant to."""

import numpy as np
import pytest

from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics.eevee_closures import COS_VIEW_MIN, alpha_of_spread, normal_towards

OPS = NumpyOps()


def eevee_direction(n, v, alpha):
    """Where EEVEE looks for a reflection: (1 - f) n + f R."""
    f = (1.0 - alpha) * (np.sqrt(1.0 - alpha) + alpha)
    direction = (1.0 - f) * n + f * (2.0 * (n @ v) * n - v)
    return direction / np.linalg.norm(direction)


@pytest.mark.parametrize("alpha", [0.001, 0.1, 0.2, 0.3, 1.0])
def test_eevee_looks_at_the_source(alpha):
    """Truth: EEVEE's rule, undone to first order: within 2 degrees, exact for a mirror and for the roughest."""
    for view_degrees in (0.5, 3.0, 15.0, 40.0, 70.0, 89.0):
        for source_degrees in (view_degrees, view_degrees + 12.0, view_degrees - 3.0):
            e, z = np.radians(view_degrees), np.sin(np.radians(np.clip(source_degrees, 0.5, 89.9)))
            v, source = np.array([-np.cos(e), 0.0, np.sin(e)]), np.array([np.sqrt(1.0 - z * z), 0.0, z])
            p, q = normal_towards(OPS, v[2], z, alpha)
            n = np.array([0.0, 0.0, p]) + q * v
            looked = eevee_direction(n / np.linalg.norm(n), v, alpha)
            error = np.degrees(np.arccos(min(1.0, looked @ source)))
            assert error < (0.05 if alpha in (0.001, 1.0) else 2.0)


def test_alpha_gives_the_measured_spread():
    variance = np.array([0.05, 0.1, 0.2])
    alpha = alpha_of_spread(OPS, variance)
    assert 2.0 * alpha**2 / (1.0 + 1.3 * alpha) == pytest.approx(variance, rel=1e-12)


def test_normals_are_numbers_in_float32_everywhere():
    ops, rng = NumpyOps(np.float32), np.random.default_rng(4)
    c = np.concatenate([rng.uniform(COS_VIEW_MIN, 1.0, 20000), [COS_VIEW_MIN, 1.0]]).astype(np.float32)
    z = np.concatenate([rng.uniform(0.0, 1.0, 20000), [COS_VIEW_MIN, 1.0]]).astype(np.float32)
    alpha = rng.uniform(7e-4, 1.0, c.size).astype(np.float32)
    p, q = normal_towards(ops, c, z, alpha)
    length = np.sqrt(p * p + q * q + 2.0 * p * q * c)
    assert np.all(np.isfinite(length))
    assert np.all(length > 1e-5)
