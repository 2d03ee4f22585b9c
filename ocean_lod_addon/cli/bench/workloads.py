# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured without Blender: our frame, the matrix products in it, and the plain way to do without."""

import tracemalloc
from dataclasses import dataclass

import numpy as np

from ...core.camera_view import CameraView
from ...core.contraction import CONTRACTIONS, Product
from ...core.discretise import discretise
from ...core.kernel import FrameKernel, ReusedArray
from ...core.lod import Grid, tile_sizes
from ...core.ocean import Ocean, Surface
from ...core.ripples.bump import Bump
from ...core.sea import Sea
from ...core.waves import WaveSet
from .timing import Contestant, Timing

_CELL_SIZE = 0.1

SQUARE, HORIZON = "square", "horizon"


IMAGES = "images"
"""The part that computes the ripple images of a frame."""


def ripple_images(name: str, pixels: list[np.ndarray], bump: Bump) -> Contestant:
    """All images of a frame, written into `pixels`."""

    def compute(time):
        for number, out in enumerate(pixels):
            bump.image(number, time, out)

    return Contestant(name, {IMAGES: compute})


@dataclass(frozen=True, eq=False)
class Workload:
    """A plane, the waves on it and which of the two kinds it is."""

    kind: str
    grid: Grid
    waves: WaveSet


def square(cells: int, count: int) -> Workload:
    """A plane of one level, (cells + 1)^2 vertices, and waves that are geometry out to its edge.

    A window ends at wavelength cells / (4 samples_per_wavelength), the edge is at cells / 2 cell sizes. So no
    vertex is spared a wave, as the windows of a plane in use do in its outer levels.
    """
    grid = Grid(cell_size=_CELL_SIZE, cells=cells, levels=1)
    shortest = 2.0 * grid.samples_per_wavelength * grid.cell_size
    return Workload(SQUARE, grid, discretise(Sea(wave_count=count), 1.01 * shortest))


_HORIZON_LEVELS = 11
_HORIZON_OVER_SQUARE = 11 / 32
"""Cells along a side of a plane of that many levels over those of the square with as many vertices, about."""


def horizon(cells_of_square: int, count: int) -> Workload:
    """A plane to the horizon, as the extension makes it, with about as many vertices as a square."""
    cells = round(_HORIZON_OVER_SQUARE * cells_of_square)
    grid = Grid(cell_size=_CELL_SIZE, cells=cells, levels=_HORIZON_LEVELS)
    return Workload(HORIZON, grid, discretise(Sea(wave_count=count), grid.shortest_wavelength))


def position_buffer(grid: Grid) -> np.ndarray:
    """Room for the positions of a plane's vertices, (vertices, 3) float32."""
    return np.empty((grid.vertex_count, 3), np.float32)


class Frame:
    """Our frame update without Blender: positions of a workload into a buffer that others may share."""

    def __init__(self, workload: Workload, contraction: str, positions: np.ndarray):
        self.positions = positions
        self._kernel = FrameKernel(workload.grid, workload.waves, contraction)
        self._anchors = np.zeros((workload.grid.levels, 2))

    def evaluate(self, time: float) -> None:
        """The surface at `time`, s."""
        self._kernel.evaluate(time, self._anchors, self.positions)

    def products(self) -> list[Product]:
        """The matrix products that `evaluate` contains."""
        self.evaluate(0.0)
        return self._kernel.products(self.positions)


def product_flops(products: list[Product]) -> float:
    """Floating-point operations of some products, an addition and a multiplication counted as two."""
    return sum(product.operations for product in products)


def products_contestant(name: str, products: list[Product], contraction: str) -> Contestant:
    """The products by themselves."""
    multiply = CONTRACTIONS[contraction].multiply
    return Contestant(name, {"products": lambda _: multiply(products)})


_SQUARE_PRODUCT = "square product "


def square_products(contraction: str, sizes) -> list[Contestant]:
    """Products of square matrices, where a library reaches its best rate."""
    generator = np.random.Generator(np.random.PCG64(0))
    result = []
    for size in sizes:
        left, right = (generator.random((size, size), np.float32) for _ in range(2))
        product = Product(left, right, np.empty((size, size), np.float32))
        result.append(products_contestant(f"{_SQUARE_PRODUCT}{size}", [product], contraction))
    return result


def best_rate(timings: dict[str, Timing]) -> tuple[float, float]:
    """The best rate among the square products in some timings, FLOP/s: (of medians, of fastest runs)."""
    measured = [
        (int(name.removeprefix(_SQUARE_PRODUCT)), timing)
        for name, timing in timings.items()
        if name.startswith(_SQUARE_PRODUCT)
    ]
    return (
        max(2.0 * size**3 / timing.median() for size, timing in measured),
        max(2.0 * size**3 / timing.minimum() for size, timing in measured),
    )


class DirectSum:
    """The obvious way in NumPy for a square: every wave on all vertices at once, and the waves added up."""

    def __init__(self, workload: Workload, dtype):
        lines = workload.grid.lines(0).astype(dtype)
        self._x, self._y = (np.ascontiguousarray(axis) for axis in np.meshgrid(lines, lines, indexing="ij"))
        self._waves = workload.waves
        self.positions = np.empty((*self._x.shape, 3), dtype)

    def evaluate(self, time: float) -> None:
        """The corrected Eq. 2 of the paper (THEORY section 2) at `time`, s."""
        waves, out = self._waves, self.positions
        out[..., 0], out[..., 1], out[..., 2] = self._x, self._y, 0.0
        columns = (waves.amplitude, waves.wavenumber, waves.direction, waves.orbit_ratio, waves.phase_at(time))
        for A, k, theta, C, phase in zip(*(column.tolist() for column in columns), strict=True):
            kx, ky = float(np.cos(theta)), float(np.sin(theta))
            psi = (k * kx) * self._x + (k * ky) * self._y + phase
            s = np.sin(psi)
            out[..., 0] -= (C * A * kx) * s
            out[..., 1] -= (C * A * ky) * s
            out[..., 2] += A * np.cos(psi)


def allocated_while_running(parts) -> int:
    """The most bytes that Python and NumPy hold while some parts run, on top of what they held before."""

    def run(time):
        for part in parts:
            part(time)

    run(0.0)  # what is made once and kept is no cost of a frame
    tracemalloc.start()
    try:
        run(1.0)
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        run(2.0)
        return max(tracemalloc.get_traced_memory()[1] - before, 0)
    finally:
        tracemalloc.stop()


def kept_by_building(build) -> int:
    """Bytes that Python and NumPy hold for what `build()` returns."""
    tracemalloc.start()
    try:
        built = build()
        kept = tracemalloc.get_traced_memory()[0]
        del built
        return kept
    finally:
        tracemalloc.stop()


WHOLE, MOVING, IN_VIEW = "whole plane", "whole plane, camera moving", "only what is in view"


@dataclass(frozen=True)
class ViewCase:
    """The plane as a shot uses it: levels out to the horizon, under a camera."""

    surface: Surface
    contestants: list[Contestant]
    share_in_view: float
    """Share of the vertices that move after leaving out what the camera does not see."""


_CAMERA_HEIGHT = 1.7
_CAMERA_SPEED = 20.0  # m/s; the finest levels step in every frame


def view_case(grid: Grid, sea: Sea, contraction: str) -> ViewCase:
    """The plane under a 35 mm lens at eye height: all of it, with the camera moving, and only what it sees."""
    surface = Surface(Ocean(sea, grid), contraction)
    out = ReusedArray(position_buffer(grid))
    still = surface.placement(level_camera(0.0))

    def in_view(time):
        return surface.placement(level_camera(0.0), final=True, moment=time)

    def moving(time):
        surface.positions(time, surface.placement(level_camera(_CAMERA_SPEED * time)), out)

    contestants = [
        Contestant(WHOLE, {"surface": lambda time: surface.positions(time, still, out)}),
        Contestant(MOVING, {"surface": moving}),
        Contestant(IN_VIEW, {"surface": lambda time: surface.positions(time, in_view(time), out)}),
    ]
    return ViewCase(surface, contestants, _share_of_vertices(grid, in_view(0.0).visible))


def _share_of_vertices(grid, visible):
    sizes = tile_sizes(grid.cells, grid.levels)
    return float(sizes[visible].sum() / sizes.sum())


def level_camera(x: float) -> CameraView:
    """A 35 mm lens (36 mm wide sensor, 16:9) at eye height above (x, 0), looking along +x, level."""
    right, up, forward = (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    half_width = 18.0 / 35.0
    half_height = half_width * 9.0 / 16.0
    return CameraView(
        np.array([x, 0.0, _CAMERA_HEIGHT]),
        np.array([right, up, forward]),
        (-half_width, half_width, -half_height, half_height),
    )
