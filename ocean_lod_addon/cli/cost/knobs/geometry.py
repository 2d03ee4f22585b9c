# SPDX-License-Identifier: GPL-3.0-or-later
"""Knobs of the moving mesh: number of waves, mesh density, width of the windows, precision of the sum."""

import functools
import math

import numpy as np

from ....core.contraction import fastest_contraction
from ....core.discretise import discretise
from ....core.gerstner import surface_points
from ....core.kernel import FrameKernel
from ....core.lod import Grid, level_anchors, undisturbed_positions
from ....core.ocean import Ocean, Surface
from ....core.sea import Sea
from ....core.swim import heights_of_mesh, windowed_heights
from ....core.windows import FADE_START, window
from ...bench.workloads import DirectSum, square
from .knob import Knob, Step

MILLIMETRES = 1e3

_GRID = Grid(cell_size=0.1, cells=192, levels=10)
"""The plane that these knobs are timed on: 277 k vertices out to 5 km."""


def _kernel_frame(grid, waves):
    """A frame of a plane that stands still: a function of the sea's time."""
    kernel = FrameKernel(grid, waves, fastest_contraction())
    out = np.empty((kernel.vertex_count, 3), np.float32)
    anchors = np.zeros((grid.levels, 2))
    return lambda time: kernel.evaluate(time, anchors, out)


# ------------------------------------------------------------------------------------------- number of waves

_RARE = 1e-3
_BISECTIONS = 60
_NODES = 96  # of the mean over a circle that J0 is; exact to rounding up to arguments of 60
_LONGEST_FREQUENCY, _FREQUENCIES = 16.0, 801  # over the standard deviation: a Gaussian's has fallen to 1e-55


def bessel_j0(x) -> np.ndarray:
    """J0(x) = mean of cos(x sin theta), by the trapezoidal rule: exact to rounding for |x| < 60, any shape."""
    theta = (np.arange(_NODES) + 0.5) * (np.pi / _NODES)
    result = np.zeros(np.shape(x))
    for sine in np.sin(theta):
        result += np.cos(np.multiply(x, sine))
    return result / _NODES


def rare_crest(amplitudes: np.ndarray, share: float = _RARE) -> float:
    """The height that a sum of cosines of these amplitudes and random phases exceeds with probability `share`.

    The sum has the characteristic function prod J0(A_i s), so P(Z > z) = 1/2 - int sin(s z)/s prod J0 ds / pi.
    """
    sigma = math.sqrt(0.5 * float(np.sum(amplitudes**2)))
    s = np.linspace(0.0, _LONGEST_FREQUENCY / sigma, _FREQUENCIES)
    characteristic = np.ones(len(s))
    for amplitude in amplitudes:
        characteristic *= bessel_j0(amplitude * s)
    weights = np.full(len(s), s[1])
    weights[[0, -1]] *= 0.5

    def exceeded(z):
        return 0.5 - np.sum(weights * characteristic * z * np.sinc(s * z / np.pi)) / np.pi

    low, high = 0.0, 6.0 * sigma
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if exceeded(middle) > share else (low, middle)
    return 0.5 * (low + high)


_GAUSSIAN_DEVIATIONS = 3.090232306167813
"""What a Gaussian exceeds with probability 1e-3, in standard deviations."""


def _missing_crest(count):
    amplitudes = discretise(Sea(wave_count=count), _GRID.shortest_wavelength).amplitude
    sigma = math.sqrt(0.5 * float(np.sum(amplitudes**2)))
    return MILLIMETRES * (_GAUSSIAN_DEVIATIONS * sigma - rare_crest(amplitudes))


WAVE_COUNT = Knob(
    "wave_count",
    "Number of waves",
    "How irregular the sea is: how high its rare crests are, how seldom groups of waves come back",
    "How much lower the crests are that one point in a thousand reaches",
    "mm",
    "Infinitely many waves: a Gaussian sea (wind 10 m/s, Hs 2.6 m)",
    f"positions of a plane of {_GRID.vertex_count} vertices",
    tuple(
        Step(
            str(count),
            functools.partial(_missing_crest, count),
            lambda count=count: _kernel_frame(_GRID, discretise(Sea(wave_count=count), _GRID.shortest_wavelength)),
        )
        for count in (16, 32, 64, 128, 256, 512)
    ),
)

# ---------------------------------------------------------------------------------------------- mesh density

_SHORTEST = 0.4  # m, whatever the density: the waves are the same
_CELLS_PER_SAMPLE = 32
_POINTS, _NEAR, _FAR = 4000, 1.0, 1000.0  # m
_TIME = 7.0  # s


def _density_grid(samples):
    return Grid(
        cell_size=_SHORTEST / samples,
        cells=_CELLS_PER_SAMPLE * samples,
        levels=9,
        samples_per_wavelength=float(samples),
    )


def scattered_points(count: int, near: float, far: float) -> tuple[np.ndarray, np.ndarray]:
    """Points around the origin, as many in each octave of distance from `near` to `far` m; always the same."""
    random = np.random.Generator(np.random.PCG64(0))
    distance = np.exp(random.uniform(np.log(near), np.log(far), count))
    bearing = random.uniform(-np.pi, np.pi, count)
    return distance * np.cos(bearing), distance * np.sin(bearing)


def mesh_height_error(grid: Grid, sea: Sea) -> float:
    """Rms difference in m between the height of the mesh and the sum of the waves that its windows keep."""
    surface = Surface(Ocean(sea, grid))
    anchors = level_anchors(grid, (0.0, 0.0))
    positions = np.empty((surface.vertex_count, 3), np.float32)
    surface.positions(_TIME, surface.placement(), positions)
    x, y = scattered_points(_POINTS, _NEAR, min(_FAR, 0.9 * grid.half_extent))
    drawn = heights_of_mesh(grid, anchors, positions[:, 2], x, y)
    error = drawn - windowed_heights(surface, anchors, _TIME, x, y)
    return float(np.sqrt(np.nanmean(error**2)))


MESH_DENSITY = Knob(
    "samples_per_wavelength",
    "Mesh density",
    "How smooth the shortest waves of the mesh are",
    "Height of the mesh between its vertices, rms, 1 m to 1 km from the camera",
    "mm",
    "The same waves (128, down to 0.4 m), summed in float64",
    "positions, with cells so many times smaller and so many times more of them a side",
    tuple(
        Step(
            f"{samples} a wavelength",
            lambda samples=samples: MILLIMETRES * mesh_height_error(_density_grid(samples), Sea()),
            lambda samples=samples: _kernel_frame(_density_grid(samples), discretise(Sea(), _SHORTEST)),
        )
        for samples in (2, 3, 4, 6, 8, 12)
    ),
)

# -------------------------------------------------------------------------------------------- LOD windows

_FADE_POINTS = 20_001


def window_slope_error(fade_start: float, samples_per_wavelength: float, cells: int) -> float:
    """Share of a fading wave's slope variance that is missed by taking its window as locally constant.

    The slope of w(x) cos(k x) is w' cos - w k sin; without w' its variance is off by int w'^2 / int (w k)^2 over
    the stretch where the window falls. k times the reach is pi cells / (2 samples).
    """
    k_reach = 0.5 * np.pi * cells / samples_per_wavelength
    x = np.linspace(fade_start, 1.0, _FADE_POINTS)
    w = window(x, 1.0, fade_start)
    falling = np.gradient(w, x)
    return float(np.sum(falling**2) / np.sum(w**2)) / k_reach**2


def _window_grid(fade_start):
    """The plane whose windows of this width are 1/2 where the usual ones are."""
    samples = _GRID.samples_per_wavelength * (1.0 + fade_start) / (1.0 + FADE_START)
    return Grid(_GRID.cell_size, _GRID.cells, _GRID.levels, samples)


WINDOW_WIDTH = Knob(
    "window_width",
    "Width of the LOD windows",
    "How softly waves fade out of the geometry with distance; wider windows reach further out",
    "Slope variance of a fading wave that is missed by taking its window as constant",
    "% of slope variance",
    "The derivative of the windowed wave",
    f"positions of a plane of {_GRID.vertex_count} vertices, windows half way down at the same distance",
    tuple(
        Step(
            f"last {100.0 * (1.0 - start):.0f} % of the reach",
            lambda start=start: (
                100.0 * window_slope_error(start, _window_grid(start).samples_per_wavelength, _GRID.cells)
            ),
            lambda start=start: _kernel_frame(_window_grid(start), discretise(Sea(), _GRID.shortest_wavelength)),
        )
        for start in (0.9, 0.75, 0.5, 0.25, 0.0)
    ),
)

# ---------------------------------------------------------------------------------------------- precision

_SQUARE = Grid(cell_size=0.5, cells=64, levels=1)
_WHOLE = 4.01 * _SQUARE.shortest_wavelength
"""m; the windows of longer waves are 1 on the whole square, so that the sum of Eq. 2 is the truth."""

_AWAY = (1e5, 1e5)  # m
_LATE = 1e6  # s
_TIMED_SQUARE = (128, 128)  # cells, waves


def _vertices_far_away():
    return undisturbed_positions(_SQUARE, level_anchors(_SQUARE, _AWAY)).T


def _naive_heights():
    """Phases of Eq. 2 formed in float32 from coordinates and time."""
    waves = discretise(Sea(), _WHOLE)
    x, y = _vertices_far_away().astype(np.float32)
    z = np.zeros_like(x)
    columns = (waves.amplitude, waves.wavenumber, waves.direction, waves.angular_frequency, waves.phase)
    for A, k, theta, omega, eps in zip(*(column.astype(np.float32) for column in columns), strict=True):
        z += A * np.cos(k * np.cos(theta) * x + k * np.sin(theta) * y - omega * np.float32(_LATE) + eps)
    return z


def _kernel_heights():
    kernel = FrameKernel(_SQUARE, discretise(Sea(), _WHOLE), fastest_contraction())
    out = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(_LATE, level_anchors(_SQUARE, _AWAY), out)
    return out[:, 2]


def _height_error(heights):
    truth = surface_points(discretise(Sea(), _WHOLE), *_vertices_far_away(), _LATE).position[..., 2]
    return MILLIMETRES * float(np.sqrt(np.mean((heights() - truth) ** 2)))


def _direct_sum(dtype):
    return DirectSum(square(*_TIMED_SQUARE), dtype).evaluate


def _square_frame():
    workload = square(*_TIMED_SQUARE)
    return _kernel_frame(workload.grid, workload.waves)


PRECISION = Knob(
    "precision",
    "Precision of the sum of waves",
    "Where waves are, far from the world's origin and long after time 0",
    "Height at 100 km and 10^6 s, rms",
    "mm",
    "The sum in float64",
    "positions of a square of 16 641 vertices, 128 waves",
    (
        Step(
            "float32 sum, phases as they come",
            lambda: _height_error(_naive_heights),
            lambda: _direct_sum(np.float32),
        ),
        Step("float32 product, phases local in float64", lambda: _height_error(_kernel_heights), _square_frame),
        Step("float64 sum", lambda: 0.0, lambda: _direct_sum(np.float64)),
    ),
)
