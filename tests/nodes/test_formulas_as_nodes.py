# SPDX-License-Identifier: GPL-3.0-or-later
"""The optics formulas of core, built as nodes, compute what they compute on arrays."""

import bpy
import numpy as np
import pytest

from ocean_lod_addon.core.constants import WATER_REFRACTIVE_INDEX
from ocean_lod_addon.core.ops import NumpyOps
from ocean_lod_addon.core.optics import beckmann, ross
from ocean_lod_addon.core.optics.cox_munk import SLOPE_VARIANCE_FLOOR
from ocean_lod_addon.core.optics.eevee_closures import COS_VIEW_MIN, alpha_of_spread, normal_towards
from ocean_lod_addon.core.optics.principal_slopes import principal_slopes
from ocean_lod_addon.core.optics.reflected_share import reflected_share, sine_of_source, source_variance
from ocean_lod_addon.core.optics.slope_density import GaussianSlopes, GramCharlierSlopes
from ocean_lod_addon.nodes.graph import GraphOps
from ocean_lod_addon.nodes.groups import GroupRecipe, Socket, ensure_group
from tests.nodes.tree_interpreter import TreeInterpreter

COUNT = 4000


@pytest.fixture(autouse=True)
def _empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def as_nodes(formula, arguments: dict, results: int) -> list[np.ndarray]:
    """The values of formula(ops, *arguments) from a node group, in float32."""

    def build(graph):
        with graph.section("Formula"):
            values = formula(GraphOps(graph), *(graph.input(name) for name in arguments))
        for index, value in enumerate(values):
            graph.output(f"Result {index}", value)

    inputs = tuple(Socket(name, "FLOAT", name, 0.0, -1e6, 1e6) for name in arguments)
    outputs = tuple(Socket(f"Result {index}", "FLOAT") for index in range(results))
    tree = ensure_group(GroupRecipe("Formula", "1", inputs, outputs, build))
    interpreter = TreeInterpreter(tree, {name: np.float32(value) for name, value in arguments.items()})
    return [interpreter.output(f"Result {index}") for index in range(results)]


def in_float32(formula, arguments):
    return formula(NumpyOps(np.float32), *(np.float32(value) for value in arguments.values()))


def upward_directions(rng, count):
    """Unit vectors with elevations down to a hundredth of a degree."""
    z = np.concatenate([rng.uniform(0.0, 1.0, count // 2), 10.0 ** rng.uniform(-3.7, 0.0, count - count // 2)])
    azimuth = rng.uniform(0.0, 2.0 * np.pi, count)
    r = np.sqrt(1.0 - z * z)
    return r * np.cos(azimuth), r * np.sin(azimuth), z


def tensors(rng, count):
    """(xx, yy, xy) of random positive tensors, the last ones isotropic or zero."""
    major, minor = 10.0 ** rng.uniform(-5.0, -0.7, (2, count))
    angle = rng.uniform(0.0, np.pi, count)
    c, s = np.cos(angle), np.sin(angle)
    minor[-20:], major[-10:], minor[-10:] = major[-20:], 0.0, 0.0
    return major * c * c + minor * s * s, major * s * s + minor * c * c, (major - minor) * c * s


def test_principal_slopes_are_the_eigenvalues_and_an_eigenvector():
    """Truth: NumPy's symmetric eigenvalue solver, in float64; variances above the floor."""
    xx, yy, xy = tensors(np.random.default_rng(2), COUNT)
    major, minor, x, y = principal_slopes(NumpyOps(), xx, yy, xy)
    eigenvalues = np.linalg.eigvalsh(np.moveaxis(np.array([[xx, xy], [xy, yy]]), -1, 0))
    assert major == pytest.approx(np.maximum(eigenvalues[:, 1], SLOPE_VARIANCE_FLOOR), rel=1e-12)
    assert minor == pytest.approx(np.maximum(eigenvalues[:, 0], SLOPE_VARIANCE_FLOOR), rel=1e-9)  # a difference
    assert x * x + y * y == pytest.approx(1.0, rel=1e-14)
    # an eigenvector: the tensor turns it by nothing
    assert (xx * x + xy * y) * y == pytest.approx((xy * x + yy * y) * x, abs=1e-16)
    along = xx * x * x + 2.0 * xy * x * y + yy * y * y
    assert along == pytest.approx(eigenvalues[:, 1], rel=1e-12, abs=1e-16)


def test_principal_slopes_as_nodes():
    """The same operations in the same order and precision: what differs is a fused multiply at most."""
    xx, yy, xy = tensors(np.random.default_rng(3), COUNT)
    arguments = {"xx": xx, "yy": yy, "xy": xy}
    for node, array in zip(
        as_nodes(principal_slopes, arguments, 4), in_float32(principal_slopes, arguments), strict=True
    ):
        assert node == pytest.approx(array, rel=1e-5, abs=1e-7)


def test_closure_sockets_as_nodes():
    rng = np.random.default_rng(4)
    major = 10.0 ** rng.uniform(-6.0, 0.3, COUNT)
    arguments = {"major": major, "minor": major * rng.uniform(1e-3, 1.0, COUNT)}
    for node, array in zip(
        as_nodes(lambda ops, *a: beckmann.metallic_sockets(ops, *a)[:2], arguments, 2),
        in_float32(beckmann.metallic_sockets, arguments)[:2],
        strict=True,
    ):
        assert node == pytest.approx(array, rel=1e-5, abs=1e-6)


def test_reflected_light_as_nodes():
    rng = np.random.default_rng(5)
    arguments = {"cos": rng.uniform(0.0, 1.0, COUNT), "spread": rng.uniform(1e-10, 0.4, COUNT)}

    def formula(ops, cos_view, spread):
        sine = sine_of_source(ops, cos_view, spread)
        alpha = alpha_of_spread(ops, source_variance(ops, cos_view, spread * spread))
        share = reflected_share(ops, cos_view, spread, WATER_REFRACTIVE_INDEX)
        return share, sine, *normal_towards(ops, ops.maximum(cos_view, COS_VIEW_MIN), sine, alpha)

    for node, array in zip(as_nodes(formula, arguments, 4), in_float32(formula, arguments), strict=True):
        assert node == pytest.approx(array, rel=1e-5, abs=1e-4)  # what is left of 1 - rho near a mirror


def _gaussian(ops, sigma_x, sigma_y):
    return GaussianSlopes(sigma_x, sigma_y)


def _gram_charlier(ops, sigma_x, sigma_y):
    return GramCharlierSlopes(sigma_x, sigma_y, wind_speed=10.0)


@pytest.mark.parametrize("distribution", [_gaussian, _gram_charlier])
def test_sun_reflection_as_nodes(distribution):
    """Nodes in float32 against arrays in float64, within the lobe; outside it, where a rounding of the exponent
    shows, against the lobe's peak."""
    rng = np.random.default_rng(6)
    view = upward_directions(rng, COUNT)
    slopes = rng.normal(0.0, 0.15, (2, COUNT))
    normal = np.array([-slopes[0], -slopes[1], np.ones(COUNT)]) / np.sqrt(1.0 + np.sum(slopes**2, axis=0))
    light = 2.0 * np.sum(normal * np.array(view), axis=0) * normal - np.array(view)
    above = light[2] > 1e-4
    sigma = rng.uniform(0.05, 0.4, (2, COUNT))
    tilt = rng.normal(0.0, 0.05, (2, COUNT))
    names = ("vx", "vy", "vz", "lx", "ly", "lz", "sx", "sy", "tx", "ty")
    arguments = dict(zip(names, (values[above] for values in (*view, *light, *sigma, *tilt)), strict=True))

    def formula(ops, vx, vy, vz, lx, ly, lz, sx, sy, tx, ty):
        slopes = distribution(ops, sx, sy)
        tilt = (tx, ty)
        return (
            ross.sun_radiance_factor(ops, (vx, vy, vz), (lx, ly, lz), slopes, WATER_REFRACTIVE_INDEX, tilt),
        )

    (node,) = as_nodes(formula, arguments, 1)
    (array,) = formula(NumpyOps(), *(np.float64(np.float32(value)) for value in arguments.values()))
    assert above.sum() > COUNT // 2
    assert np.all(np.isfinite(node))
    # exponents up to 40 times a float32 rounding of a few 1e-7 each
    assert node == pytest.approx(array, rel=1e-4, abs=1e-5 * np.max(array))
    bright = array > 1e-3
    assert np.median(np.abs(node[bright] / array[bright] - 1.0)) < 2e-6
