# SPDX-License-Identifier: GPL-3.0-or-later
"""A second of measurements that finds the prices of the stages which NumPy does by itself."""

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
    (64, 6, 96, _BOTH, 16),
    (80, 9, 112, _BOTH, 4),
    (208, 6, 96, (POSITION,), 16),
    (256, 6, 128, (POSITION,), 4),
    (272, 5, 56, _BOTH, 8),
    (384, 1, 192, _BOTH, 4),
)
"""(cells, levels, waves, columns, instants of foam): together they tell the prices of arithmetic, of memory and of
calls apart. All have products enough for threads: smaller frames, which one makes, nobody waits for."""

_ROUNDS = 5
_PATIENCE, _LEAST = 0.01, 2
"""s, rounds; what has taken this long in all sits out the rounds that are left after this many."""

_FRAME = 1.0 / 24.0

_RIPPLES = (("256", 4), ("512", 2), ("1024", 2))
"""(texels, images at most): several, as those of a frame push each other out of the caches."""

_NO_RIPPLES = Ripples(kind="off")

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
    return {
        "factors": [(surface.work, surface.form_factors) for surface in surfaces],
        "products": [(surface.work, surface.multiply) for surface in surfaces],
        "normals": [(surface.work, surface.find_normals) for surface in surfaces if surface.work.normals],
        "foam_products": [(surface.work, surface.multiply_past) for surface in surfaces],
        "foam": [(surface.work, surface.find_foam) for surface in surfaces],
    }


def ripple_cases(show=None) -> list:
    """What tells the price of ripples; `show`(texels) gives a function that each frame's image is handed to."""
    return [_ripples_case(Ripples(resolution=texels), most, show) for texels, most in _RIPPLES]


def measured_prices(cases: dict[str, list]) -> dict[str, tuple[float, ...]]:
    """The prices of stages from cases (work, run) of each, all measured in turns.

    From small to large, stage after stage, so that each finds the caches about as a frame of its size leaves them.
    """
    everything = [(stage, work, run) for stage, pairs in cases.items() for work, run in pairs]
    everything.sort(key=lambda case: _size(case[1]))
    seconds = typical_seconds([run for _, _, run in everything])
    prices = {}
    for stage in cases:
        own = [(work, taken) for (name, work, _), taken in zip(everything, seconds, strict=True) if name == stage]
        prices[stage] = fit_prices(stage, [work for work, _ in own], [taken for _, taken in own])
    return prices


def _size(work):
    """About as the bytes that a case touches."""
    return work.vertices + work.normals + work.texels + work.shared_texels


class _Surface:
    """A plane with waves and whitecaps, and the parts of its frame."""

    def __init__(self, contraction, cells, levels, count, blocks, instants):
        grid, settings = Grid(cell_size=0.1, cells=cells, levels=levels), Foam(memory_steps=instants)
        ocean = Ocean(Sea(wave_count=count), grid, ripples=_NO_RIPPLES, foam=settings)
        waves = discretise(ocean.sea, grid.shortest_wavelength)
        self._kernel = FrameKernel(grid, waves, contraction)
        # Of no coverage: what foam begins at need not be found, and to look for it takes as long.
        self._whitecaps = Whitecaps(replace(settings, coverage=0.0), ocean.sea, grid, waves)
        self._multiply = CONTRACTIONS[contraction].multiply
        self._anchors = np.zeros((levels, 2))
        past = self._whitecaps.block
        self._outputs = {
            block: np.zeros((grid.vertex_count, block.columns), np.float32) for block in (*blocks, past)
        }
        self._columns, self._past = self._outputs[past], (past,)
        self._present = blocks
        self._foam = np.zeros(grid.vertex_count, np.float32)
        self._normals = np.zeros((grid.vertex_count, 3), np.float32)
        self.work = work_of(ocean, waves, blocks, contraction)
        self.form_factors(0.0)

    def form_factors(self, time):
        """The part of a frame that depends on time."""
        self._kernel.fill_factors(time, self._anchors, self._outputs)

    def multiply(self, _time):
        """The columns of the waves."""
        self._fill(self._present)

    def find_normals(self, _time):
        """Those of the columns of tangents."""
        surface_normals(self._outputs[TANGENTS], self._normals)

    def multiply_past(self, _time):
        """Those of all instants of foam."""
        self._fill(self._past)

    def _fill(self, blocks):
        self._multiply([p for block in blocks for p in self._kernel.products(self._outputs[block], block=block)])

    def find_foam(self, _time):
        """The foam in them."""
        self._whitecaps.foam(self._columns, self._foam)


def _ripples_case(ripples, most, show):
    ocean = Ocean(ripples=ripples)
    images = bump_layout(ripples, ocean.grid.shortest_wavelength).tiles[:most]
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
