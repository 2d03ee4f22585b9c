# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything one ocean is made from, and the surface evaluated from it."""

import functools
import hashlib
from dataclasses import dataclass, field

import numpy as np

from .camera_view import CameraView
from .column_blocks import ColumnBlock
from .discretise import check_wave_height, discretise
from .foam.whitecaps import Whitecaps
from .foam_settings import Foam
from .framing import Framing
from .gusts import gust_factor, gust_waves
from .kernel import FrameKernel, ReusedArray
from .lod import Grid, undisturbed_positions
from .placement import Placement, place
from .ripple_settings import Ripples
from .ripples.bump import Bump
from .sea import Sea
from .slope_budget import total_slope_variance, unresolved_slope_variance, wave_tensors
from .waves import WaveSet


@dataclass(frozen=True)
class Ocean:
    """The settings that the surface of one ocean depends on, time aside."""

    sea: Sea = field(default_factory=Sea)
    grid: Grid = field(default_factory=Grid)
    framing: Framing = field(default_factory=Framing)
    ripples: Ripples = field(default_factory=Ripples)
    foam: Foam | None = None

    @property
    def fingerprint(self) -> str:
        """A short text that two oceans share exactly if their settings are equal, on every machine."""
        return hashlib.blake2b(repr(self).encode(), digest_size=12).hexdigest()


class Surface:
    """The surface of an ocean: what is static once, what moves at any time. Raises OceanError if none can be."""

    def __init__(self, ocean: Ocean, contraction: str | None = None):
        self.ocean = ocean
        self.waves: WaveSet = discretise(ocean.sea, ocean.grid.shortest_wavelength)
        check_wave_height(ocean.sea, self.waves)
        self._kernel = FrameKernel(ocean.grid, self.waves, contraction, ocean.framing.curved_earth)

    @property
    def vertex_count(self) -> int:
        """Number of vertices."""
        return self._kernel.vertex_count

    def placement(
        self, view: CameraView | None = None, final: bool = False, moment: float | None = None
    ) -> Placement:
        """Where the plane stands for a camera and what of it moves, for a `final` picture or the viewport.

        A picture that shows one `moment` of the sea, in s, and no other needs less of it.
        """
        return place(self.ocean.grid, self.ocean.framing, self.waves, view, final, moment)

    def positions(
        self,
        time: float,
        placement: Placement,
        out: np.ndarray | ReusedArray,
        more: dict[ColumnBlock, np.ndarray | ReusedArray] | None = None,
    ) -> None:
        """Write the vertices' positions at `time` (s) into `out`, (vertex_count, 3) float32, in m.

        `more` are further blocks of columns, each with the array to write it into.
        """
        self._kernel.evaluate(time, placement.anchors, out, placement.visible, placement.wave_limit, more)

    def undisturbed(self, anchors: np.ndarray) -> np.ndarray:
        """The vertices' undisturbed positions for level anchors, (vertex_count, 2) float64, m."""
        return undisturbed_positions(self.ocean.grid, anchors)

    def slope_variance(self) -> np.ndarray:
        """Unresolved slope variance (xx, yy, xy) of each vertex, (vertex_count, 3) float32; static in time."""
        return unresolved_slope_variance(self.ocean.sea, self.ocean.grid, self.waves)

    @property
    def has_gusts(self) -> bool:
        """Whether the slope variance changes with time."""
        return self._gusts is not None

    @functools.cached_property
    def _gusts(self):
        ripples = self.ocean.ripples
        return gust_waves(self.ocean.sea, ripples.gust_size) if ripples.gusts else None

    @functools.cached_property
    def _steady(self):
        """The slope variance without gusts, and the part of it (3,) that the mesh shows nowhere: theirs."""
        whole = total_slope_variance(self.ocean.sea, self.waves)
        return self.slope_variance(), np.float32(whole - wave_tensors(self.waves).sum(axis=0))

    def gusty(self, anchors: np.ndarray, time: float) -> tuple[np.ndarray, np.ndarray]:
        """Unresolved slope variance (vertices, 3) at `time` in s with gusts, and the root of their factor
        (vertices,), which the slopes of ripples are multiplied by; both float32. Only with `has_gusts`."""
        steady, theirs = self._steady
        factor = gust_factor(self.ocean.grid, self._gusts, self.ocean.ripples, anchors, time)
        return steady + (factor - 1.0)[:, None] * theirs, np.sqrt(factor)

    @functools.cached_property
    def bump(self) -> Bump | None:
        """The ripples between the mesh and the BRDF, or None if they are off."""
        if self.ocean.ripples.kind == "off":
            return None
        return Bump(self.ocean.ripples, self.ocean.sea, self.ocean.grid, self.waves)

    @functools.cached_property
    def whitecaps(self) -> Whitecaps | None:
        """The foam of breaking waves, or None if it is off."""
        if self.ocean.foam is None:
            return None
        return Whitecaps(self.ocean.foam, self.ocean.sea, self.ocean.grid, self.waves)
