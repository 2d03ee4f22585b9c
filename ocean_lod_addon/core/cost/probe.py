# SPDX-License-Identifier: GPL-3.0-or-later
"""A few seconds of measurements that find the prices of the stages which NumPy does by itself."""

import time
from dataclasses import fields, replace

import numpy as np

from ..column_blocks import POSITION, TANGENTS
from ..contraction import CONTRACTIONS, fastest_contraction
from ..discretise import discretise
from ..foam.whitecaps import Whitecaps
from ..foam_settings import Foam
from ..kernel import FrameKernel
from ..lod import Grid
from ..normals import surface_normals
from ..ocean import Ocean
from ..ripple_settings import Ripples
from ..ripples.bump import bump_layout
from ..ripples.spectrum import ripple_spectrum
from ..ripples.synthesis import tile_syntheses
from ..sea import Sea
from .model import CostModel, fit_prices
from .work import Work, ripple_work, work_of

_BOTH = (POSITION, TANGENTS)
_PLANES = (
    (96, 11, 48, _BOTH),
    (96, 8, 96, _BOTH),
    (200, 8, 16, _BOTH),
    (128, 8, 224, (POSITION,)),
    (192, 8, 160, _BOTH),
    (256, 8, 64, _BOTH),
    (320, 8, 128, (POSITION,)),
    (512, 1, 24, (POSITION,)),
    (384, 1, 192, _BOTH),
)
"""(cells, levels, waves, columns): together they tell the prices of arithmetic, of memory and of calls apart. All
are large enough for threads: smaller frames, which one thread makes, nobody waits for."""

_ROUNDS = 7
_PATIENCE, _LEAST = 0.04, 3
"""s, rounds; what has taken this long in all sits out the rounds that are left after this many."""

_FRAME = 1.0 / 24.0

_RIPPLES = tuple(Ripples(resolution=texels) for texels in ("256", "512", "1024"))
_NO_RIPPLES = Ripples(kind="off")
_FOAM = (
    (72, 12, 64, 8),
    (112, 8, 64, 4),
    (80, 8, 48, 16),
    (264, 3, 128, 16),
    (160, 6, 160, 8),
    (224, 6, 64, 4),
    (256, 8, 32, 1),
)
"""(cells, levels, waves, instants)"""

_NORMALS = (1 << 13, 1 << 17)

_NOTHING = Work(*[0.0] * len(fields(Work)))


def typical_seconds(runs) -> list[float]:
    """Seconds that each of some functions of the time takes, from some rounds of all in turns.

    In turns, what else the machine does can not hit one of them alone. A first round is not counted.
    """
    for run in runs:
        run(0.0)
    taken = [[] for _ in runs]
    for number in range(1, _ROUNDS + 1):
        for run, times in zip(runs, taken, strict=True):
            if number > _LEAST and sum(times) > _PATIENCE:
                continue
            start = time.perf_counter()
            run(_FRAME * number)
            times.append(time.perf_counter() - start)
    return [typical(times) for times in taken]


def typical(seconds) -> float:
    """A third of the way from the fastest to the slowest: whatever else the machine does only adds to a time."""
    return sorted(seconds)[len(seconds) // 3]


def probe(contraction: str | None = None) -> CostModel:
    """Prices of waves, normals and ripples on this machine, with a contraction of core.contraction or its own."""
    return CostModel(measured_prices(numpy_cases(contraction)))


def numpy_cases(contraction: str | None = None, show=None) -> dict[str, list]:
    """What tells the prices of all that NumPy does by itself; `show` as in `ripple_cases`."""
    return surface_cases(contraction) | {"ripples": ripple_cases(show)}


def surface_cases(contraction: str | None = None) -> dict[str, list]:
    """What tells the prices of waves and normals."""
    contraction = contraction or fastest_contraction()
    surfaces = [_Surface(contraction, *plane) for plane in _PLANES]
    foamy = [_FoamSurface(contraction, *plane) for plane in _FOAM]
    return {
        "factors": [(surface.work, surface.form_factors) for surface in surfaces],
        "products": [(surface.work, surface.multiply) for surface in surfaces],
        "normals": [_normals_case(count) for count in _NORMALS],
        "foam_products": [(surface.work, surface.multiply) for surface in foamy if surface.work.foam_products],
        "foam": [(surface.work, surface.find) for surface in foamy],
    }


def ripple_cases(show=None) -> list:
    """What tells the price of ripples; `show`(texels) gives a function that each frame's image is handed to."""
    return [_ripples_case(ripples, show) for ripples in _RIPPLES]


def measured_prices(cases: dict[str, list]) -> dict[str, tuple[float, ...]]:
    """The prices of stages from cases (work, run) of each, all measured in turns."""
    everything = [(stage, work, run) for stage, pairs in cases.items() for work, run in pairs]
    seconds = typical_seconds([run for _, _, run in everything])
    prices = {}
    for stage in cases:
        own = [(work, taken) for (name, work, _), taken in zip(everything, seconds, strict=True) if name == stage]
        prices[stage] = fit_prices(stage, [work for work, _ in own], [taken for _, taken in own])
    return prices


class _Surface:
    """A plane with waves, whose factors and products are timed apart."""

    def __init__(self, contraction, cells, levels, count, blocks):
        grid = Grid(cell_size=0.1, cells=cells, levels=levels)
        ocean = Ocean(Sea(wave_count=count), grid, ripples=_NO_RIPPLES)
        waves = discretise(ocean.sea, grid.shortest_wavelength)
        self._kernel = FrameKernel(grid, waves, contraction)
        self._multiply = CONTRACTIONS[contraction].multiply
        self._anchors = np.zeros((levels, 2))
        self._outputs = {
            block: np.empty((self._kernel.vertex_count, block.columns), np.float32) for block in blocks
        }
        self.work = work_of(ocean, waves, blocks, contraction)

    def form_factors(self, time):
        """The part of a frame that depends on time."""
        self._kernel.fill_factors(time, self._anchors, self._outputs)

    def multiply(self, _time):
        """The other part."""
        self._multiply(
            [p for block, out in self._outputs.items() for p in self._kernel.products(out, block=block)]
        )


class _FoamSurface:
    """A plane whose whitecaps are looked for, and the two parts of that."""

    def __init__(self, contraction, cells, levels, count, instants):
        grid, settings = Grid(cell_size=0.1, cells=cells, levels=levels), Foam(memory_steps=instants)
        ocean = Ocean(Sea(wave_count=count), grid, ripples=_NO_RIPPLES, foam=settings)
        waves = discretise(ocean.sea, grid.shortest_wavelength)
        self._kernel = FrameKernel(grid, waves, contraction)
        self._whitecaps = Whitecaps(settings, ocean.sea, grid, waves)
        self._multiply = CONTRACTIONS[contraction].multiply
        self._columns = np.zeros((self._kernel.vertex_count, instants), np.float32)
        self._kernel.fill_factors(0.0, np.zeros((levels, 2)), (self._whitecaps.block,))
        self.work = work_of(ocean, waves, (), contraction)

    def multiply(self, _time):
        """The columns of all instants."""
        self._multiply(self._kernel.products(self._columns, block=self._whitecaps.block))

    def find(self, _time):
        """The foam in them."""
        self._whitecaps.foam(self._columns, np.zeros(len(self._columns), np.float32))


def _normals_case(count):
    tangents = np.random.Generator(np.random.PCG64(0)).random((count, TANGENTS.columns), np.float32)
    out = np.empty((count, 3), np.float32)
    return replace(_NOTHING, normals=float(count)), lambda _time: surface_normals(tangents, out)


def _ripples_case(ripples, show):
    """All images of a frame, one after the other: together they push each other out of the caches, which one alone
    does if it is large."""
    ocean = Ocean(ripples=ripples)
    images = bump_layout(ripples, ocean.grid.shortest_wavelength).tiles
    if ripple_work(images)["far_texels"]:
        images = images[:1]
    density = ripple_spectrum(ocean.sea, ocean.grid.shortest_wavelength).density
    syntheses = tile_syntheses(density, ocean.sea, images)
    shows = [show and show(image.texels) for image in images]

    def run(time):
        for image, synthesis, show_this in zip(images, syntheses, shows, strict=True):
            out = np.empty((image.texels, image.texels, 4), np.float32)
            synthesis.image(time, out)
            if show_this is not None:
                show_this(out)

    return replace(_NOTHING, **ripple_work(images)), run
