# SPDX-License-Identifier: GPL-3.0-or-later
"""The Ross BRDF against an independent renderer: Mitsuba 3's rough conductor, distribution Beckmann, F = 1.

Mitsuba multiplies the masking of both directions, G1(v) G1(l), where Ross (and Cycles) use the height-correlated
1/(1 + Lambda_v + Lambda_l). After that known difference what is left is Mitsuba's G1, a rational fit.
"""

import numpy as np
import pytest

from ocean_lod_addon.core.optics import ross
from tests.core.optics_helpers import OPS, direction, exact_slopes

mitsuba = pytest.importorskip("mitsuba")


def mitsuba_beckmann(alpha_x, alpha_y, view, light):
    """BRDF cos theta_l of Mitsuba's closure for arrays of directions."""
    mitsuba.set_variant("scalar_rgb")
    closure = mitsuba.load_dict(
        {
            "type": "roughconductor",
            "distribution": "beckmann",
            "material": "none",
            "alpha_u": float(alpha_x),
            "alpha_v": float(alpha_y),
        }
    )
    context, point = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()
    values = []
    for v, w in zip(np.transpose(view), np.transpose(light), strict=True):
        point.wi = v
        values.append(closure.eval(context, point, mitsuba.Vector3f(*w))[0])
    return np.array(values)


@pytest.mark.parametrize("variances", [(0.0316, 0.0222), (0.1, 0.06), (0.005, 0.045)])
def test_mitsubas_beckmann_within_its_own_fit(variances):
    rng = np.random.default_rng(7)
    theta_v, theta_l = np.radians(rng.uniform(0.0, 88.5, (2, 3000)))
    phi_v = rng.uniform(-np.pi, np.pi, 3000)
    phi_l = phi_v + np.pi + rng.normal(0.0, 0.5, 3000)
    view, light = np.array(direction(theta_v, phi_v)), np.array(direction(theta_l, phi_l))
    slopes = exact_slopes(*variances)
    lobe = ross.reflection_lobe(OPS, view, light, ross.half_vector(OPS, view, light), slopes)
    Lambda_v, Lambda_l = (slopes.masked_area(OPS, w) / w[2] for w in (view, light))
    separable = (1.0 + Lambda_v + Lambda_l) / ((1.0 + Lambda_v) * (1.0 + Lambda_l))
    theirs = mitsuba_beckmann(*np.sqrt(2.0 * np.array(variances)), view, light)
    compared = lobe > 1e-8
    assert compared.sum() > 1000
    np.testing.assert_allclose(theirs[compared], (lobe * separable)[compared], rtol=0.007)
