# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of steepness: waves at and beyond the steepest trochoid, folds, no choppiness and too much."""

import numpy as np

from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.foam.whitecap_law import whitecap_coverage
from ocean_lod_addon.core.foam_settings import Foam
from ocean_lod_addon.core.gerstner import SMALLEST_JACOBIAN, sum_steepness, surface_points
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.lod import Grid, level_anchors, undisturbed_positions
from ocean_lod_addon.core.ocean import Ocean, Surface
from ocean_lod_addon.core.optics.trochoid_slopes import mean_square_slope
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.waves import TWO_PI, WaveSet
from tests.hard_cases.catalogue import FLOAT32_ROUNDING, FLOAT64_ROUNDING, hard_case


def one_wave(steepness, wavenumber=0.1, orbit_ratio=1.0):
    omega = np.sqrt(GRAVITY * wavenumber)
    return WaveSet(steepness / wavenumber, wavenumber, omega, 0.0, 0.0, orbit_ratio, 0)


def along_one_wave(waves, points=2001):
    """The surface over exactly one wavelength, both crests included."""
    return surface_points(waves, np.linspace(0.0, waves.wavelength[0], points), 0.0, 0.0)


def storm():
    return discretise(Sea(systems=(WaveSystem(wind_speed=40.0),), choppiness=2.0, wave_count=256), 0.1)


def storm_points():
    x, y = np.random.default_rng(1).uniform(-500.0, 500.0, (2, 20_000))
    return surface_points(storm(), x, y, 3.0)


@hard_case(
    title="one wave of kA = 0.99",
    truth="its mean square slope per horizontal area is 1 - sqrt(1 - 0.99^2)",
    naive="(kA)^2 / 2, as for a sinusoid",
    error="slope variance, relative",
    bound=24 * FLOAT64_ROUNDING,
    because="1 - e is exact, its root halves errors, 1 + e and five operations: 12 u at this e, twice that",
)
def test_slope_variance_of_an_almost_breaking_wave():
    e = 0.99
    truth = 0.8589326402033412  # 1 - sqrt(1 - 0.99^2)
    return abs(0.5 * e * e / truth - 1.0), abs(float(mean_square_slope(e)) / truth - 1.0)


@hard_case(
    title="one wave of kA = 1.5, a loop",
    truth="a looping trochoid counts as the steepest one that does not: 1",
    naive="1 - sqrt(1 - e^2), Eq. 26",
    error="slope variance",
    bound=2 * FLOAT64_ROUNDING,
    because="limited before the root, never after it",
)
def test_slope_variance_of_a_looping_wave():
    with np.errstate(invalid="ignore"):
        naive = 1.0 - np.sqrt(1.0 - np.float64(1.5) ** 2)
    return float(abs(naive - 1.0)), abs(float(mean_square_slope(1.5)) - 1.0)


@hard_case(
    title="a 100 m swell of 4 m amplitude in Eq. 26 as printed",
    truth="f(kA), kA = 0.25",
    naive="1 - sqrt(1 - k^2 A^4), the printed dimension",
    error="slope variance, relative",
    bound=8 * FLOAT64_ROUNDING,
    because="four operations",
)
def test_the_printed_slope_variance_of_a_swell():
    k, A = TWO_PI / 100.0, 4.0
    e = k * A
    truth = 0.03209787073639098  # 1 - sqrt(1 - (0.08 pi)^2)
    with np.errstate(invalid="ignore"):
        naive = 1.0 - np.sqrt(1.0 - np.float64(k * A * A) ** 2)
    return float(abs(naive / truth - 1.0)), abs(float(mean_square_slope(e)) / truth - 1.0)


@hard_case(
    title="ripples of kA = 2e-4 in float32",
    truth="f(e) = e^2 / 2 to eight digits",
    naive="1 - sqrt(1 - e^2)",
    error="slope variance, relative",
    bound=6 * FLOAT32_ROUNDING,
    because="six operations",
)
def test_slope_variance_of_ripples_in_float32():
    e = np.float32(2e-4)
    one = np.float32(1.0)
    truth = 0.5 * float(e) ** 2
    naive, ours = one - np.sqrt(one - e * e), mean_square_slope(e, one)
    return abs(float(naive) / truth - 1.0), abs(float(ours) / truth - 1.0)


@hard_case(
    title="choppiness 0",
    truth="f_Q(e) tends to e^2 / 2",
    naive="[1 - sqrt(1 - (Q e)^2)] / Q^2",
    error="slope variance, relative",
    bound=4 * FLOAT64_ROUNDING,
    because="four operations",
)
def test_slope_variance_without_choppiness():
    e, Q = 0.3, np.float64(0.0)
    with np.errstate(invalid="ignore"):
        naive = (1.0 - np.sqrt(1.0 - (Q * e) ** 2)) / Q**2
    return float(abs(naive / 0.045 - 1.0)), abs(float(mean_square_slope(e, Q)) / 0.045 - 1.0)


@hard_case(
    title="the cusp of a wave of C k A = 1",
    truth="every normal has length 1",
    naive="the cross product over its length",
    error="length of the normal, less 1",
    bound=8 * FLOAT64_ROUNDING,
    because="three squares, a sum, a root and a quotient",
)
def test_normals_at_a_cusp():
    points = along_one_wave(one_wave(1.0))
    cross = np.cross(points.tangent_x, points.tangent_y)
    with np.errstate(invalid="ignore"):
        naive = cross / np.linalg.norm(cross, axis=-1, keepdims=True)
    lengths = [np.linalg.norm(normal, axis=-1) for normal in (naive, points.normal)]
    return tuple(float(np.abs(length - 1.0).max()) for length in lengths)


@hard_case(
    title="slopes at folds of a storm, choppiness 2",
    truth="slope times Jacobian is the horizontal part of the normal, below 10 (sum of kA)",
    naive="slope of the cross product, divided by J",
    error="largest slope",
    bound=10.0 / SMALLEST_JACOBIAN,
    because="J is held at 0.001",
)
def test_slopes_at_folds():
    points = along_one_wave(one_wave(1.0), points=4001)
    cross = np.cross(points.tangent_x, points.tangent_y)
    with np.errstate(all="ignore"):
        naive = np.abs(cross[:, :2] / cross[:, 2:]).max()
    folded = storm_points()
    assert (folded.jacobian < 0.0).any(), "this storm folds somewhere"
    return float(naive), float(max(np.abs(folded.slope).max(), np.abs(points.slope).max()))


@hard_case(
    title="sum of C k A above 1",
    truth="a sea folds where J <= 0: a steep sum alone does not mean that it does",
    naive="fold where the sum of C k A exceeds 1",
    error="area said to fold, share",
    bound=0.0,
    because="J of the analytic derivatives is exact: no point of this sea has J <= 0 (expected share 5e-13)",
)
def test_a_steep_sum_that_does_not_fold():
    waves = discretise(Sea(wave_count=96), 0.4)
    assert sum_steepness(waves) > 1.0
    x, y = np.random.default_rng(2).uniform(-500.0, 500.0, (2, 20_000))
    return 1.0, float((surface_points(waves, x, y, 0.0).jacobian <= 0.0).mean())


def profile_of_kernel(steepness, choppiness):
    """Undisturbed and displaced x of a small plane's vertices with one wave."""
    grid = Grid(cell_size=0.25, cells=64, levels=1)
    kernel = FrameKernel(grid, one_wave(steepness, wavenumber=TWO_PI / 32.0, orbit_ratio=choppiness))
    positions = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(0.0, level_anchors(grid, (0.0, 0.0)), positions)
    return undisturbed_positions(grid, level_anchors(grid, (0.0, 0.0)))[:, 0], positions[:, 0].astype(np.float64)


@hard_case(
    title="choppiness 2 at kA = 0.9: the surface loops over itself",
    truth="X = x - 2 A sin kx, whatever the overlap",
    naive="a height field over X",
    error="X, over the wavelength",
    bound=8 * FLOAT32_ROUNDING,
    because="coordinates up to one wavelength, five roundings of the sum and three of its factors",
)
def test_a_surface_that_loops():
    k, A = TWO_PI / 32.0, 0.9 * 32.0 / TWO_PI
    x, ours = profile_of_kernel(0.9, 2.0)
    truth = x - 2.0 * A * np.sin(k * x)
    order = np.argsort(x, kind="stable")
    naive = np.abs(np.maximum.accumulate(truth[order]) - truth[order]).max() / 32.0
    return float(naive), float(np.abs(ours - truth).max() / 32.0)


def foam_of_kernel(sea, grid, time=3.0):
    """Share of the area around each vertex of a plane that is white."""
    surface = Surface(Ocean(sea, grid, ripples=Ripples(kind="off"), foam=Foam()))
    placement, block = surface.placement(), surface.whitecaps.block
    positions = np.empty((surface.vertex_count, 3), np.float32)
    columns = np.empty((surface.vertex_count, block.columns), np.float32)
    surface.positions(time, placement, positions, {block: columns})
    foam = np.empty(surface.vertex_count, np.float32)
    surface.whitecaps.foam(columns, foam)
    return foam.astype(np.float64)


@hard_case(
    title="foam where a storm of choppiness 2 folds (J near 0 and below)",
    truth="foam is a share of the area: 0 to 1",
    naive="foam by the compression of the surface, 1 / J - 1",
    error="foam outside of 0 to 1",
    bound=3 * FLOAT32_ROUNDING,
    because="at most 1 by its formula, which never divides by J; a product and a sum round",
)
def test_foam_at_folds():
    jacobian = storm_points().jacobian
    naive = 1.0 / np.abs(jacobian) - 1.0
    foam = foam_of_kernel(
        Sea(systems=(WaveSystem(wind_speed=40.0),), choppiness=2.0, wave_count=256), Grid(0.5, 256, 4)
    )
    assert foam.max() > 0.5, "this storm breaks somewhere"
    return tuple(float(max(share.max() - 1.0, -share.min(), 0.0)) for share in (naive, foam))


@hard_case(
    title="foam where no wave is left that could break (compression of deviation 0)",
    truth="the sea is evenly as white as the wind makes it",
    naive="compression less its threshold, over a deviation of 0",
    error="foam, relative",
    bound=2 * FLOAT32_ROUNDING,
    because="the wind's share, rounded once",
)
def test_foam_without_a_breaking_wave():
    white = whitecap_coverage(15.0)
    sea = Sea(systems=(WaveSystem(wind_speed=15.0),))
    ours = foam_of_kernel(sea, Grid(cell_size=500.0, cells=16, levels=2))
    still = np.zeros(3)
    with np.errstate(invalid="ignore"):
        naive = (still - still) / still.std()
    return tuple(float(np.abs(foam / white - 1.0).max()) for foam in (naive, ours))
