# SPDX-License-Identifier: GPL-3.0-or-later
"""How much slope variance each level shows at a distance from the camera, measured on what the levels are made of.

geometry   the waves as the frame kernel windows them at a vertex: f(w e), what the mesh shows of each
bump       the pixels of the ripple images, faded by the shader's own formulas and by the vertex's amplitudes
brdf       the vertex's slope variance attribute, less what those formulas say that the bump shows

None of the three knows the others' sum: that they add up to the sea's slope variance is for a test to find out.
"""

from dataclasses import dataclass

import numpy as np

from ..ocean import Surface
from ..ops import NumpyOps
from ..optics.trochoid_slopes import mean_square_slope
from ..slope_budget import total_slope_variance
from ..windows import window, window_reach
from . import shading


@dataclass(frozen=True, eq=False)
class SlopeBudget:
    """Slope variances (xx, yy, xy): `total` (3,) of the sea, the rest (distances, 3) of each level.

    `distance` is that of the vertices used, m: from the point of the water below the camera.
    """

    distance: np.ndarray
    geometry: np.ndarray
    bump: np.ndarray
    brdf: np.ndarray
    total: np.ndarray


class BudgetOf:
    """The slope budget of one ocean, with its images and attributes computed once."""

    def __init__(self, surface: Surface, time: float = 0.0):
        self._surface = surface
        ocean = surface.ocean
        self._total = total_slope_variance(ocean.sea, surface.waves)
        self._places = surface.undisturbed(np.zeros((ocean.grid.levels, 2)))
        self._attribute = surface.slope_variance()
        self._bump = surface.bump
        if self._bump is None:
            self._measured, self._amplitudes = np.zeros((0, 3)), np.zeros((len(self._places), 0))
            return
        self._measured = measured_tensors(self._bump, time)
        handed_over = self._bump.amplitudes()
        whole = np.ones((len(handed_over), len(self._measured) - handed_over.shape[1]))
        self._amplitudes = np.hstack([handed_over, whole])

    def seen(self, heading: float, distances, height: float, pixel_angle: float) -> SlopeBudget:
        """The budget along a line of sight: `heading` in rad from x, lens `height` m above the water.

        Vertices nearest to the `distances` (m) are used; `pixel_angle` is that between two pixels, rad.
        """
        ahead = np.array([np.cos(heading), np.sin(heading)])
        wanted = np.multiply.outer(np.asarray(distances, dtype=np.float64), ahead)
        vertex = np.array([np.argmin(np.sum((self._places - place) ** 2, axis=1)) for place in wanted])
        places, attribute = self._places[vertex], self._attribute[vertex].astype(np.float64)
        to_viewer = np.column_stack([-places, np.full(len(places), height)])
        range_ = np.linalg.norm(to_viewer, axis=1)
        bump, believed = self._bump_of(vertex, (to_viewer / range_[:, None]).T, pixel_angle * range_)
        return SlopeBudget(
            np.linalg.norm(places, axis=1), self._geometry(places), bump, attribute - believed, self._total
        )

    def _geometry(self, places):
        """sum_i f(w_i e_i) of the waves, with the windows of the frame kernel, in their directions."""
        waves = self._surface.waves
        reach = window_reach(self._surface.ocean.grid, waves.wavelength)
        w = window(np.abs(places[:, :1]), reach) * window(np.abs(places[:, 1:]), reach)
        f = mean_square_slope(w * (waves.wavenumber * waves.amplitude), waves.orbit_ratio)
        x, y = np.cos(waves.direction), np.sin(waves.direction)
        return f @ np.stack([x * x, y * y, x * y], axis=-1)

    def _bump_of(self, vertex, to_viewer, pixel_width):
        """What the bump shows: measured on its images, and as the shader believes from the bands' variances."""
        if self._bump is None:
            return np.zeros((len(vertex), 3)), np.zeros((len(vertex), 3))
        ops, flat = NumpyOps(), (0.0, 0.0, 1.0)
        c, s = shading.view_axes(ops, to_viewer)
        sight = shading.sight_of(ops, to_viewer, flat, pixel_width)
        axes = shading.tensor_axes(ops, c, s)
        results = []
        for tensors in (self._measured, self._bump.tensors):
            shown = shading.Shown(0.0, 0.0, 0.0, 0.0, 0.0)
            for band, amplitude, tensor in zip(
                self._bump.layout.bands, self._amplitudes[vertex].T, tensors, strict=True
            ):
                k2 = band.middle_wavenumber**2
                fades = [shading.fade(ops, sight[axis], k2, amplitude) for axis in (1, 2)]
                shown = shading.add_band(ops, shown, c, s, axes, fades, (0.0, 0.0), tensor[:, None])
            results.append(-shading.left_to_brdf(axes, np.zeros((3, len(vertex))), shown).T)
        return results


def measured_tensors(bump, time: float) -> np.ndarray:
    """Slope variances (bands, 3) of the bump's images at `time` in s."""
    tensors = []
    for number, tile in enumerate(bump.layout.tiles):
        pixels = np.empty((tile.texels, tile.texels, 4), np.float32)
        bump.image(number, time, pixels)
        x, y = pixels[..., 0::2].astype(np.float64), pixels[..., 1::2].astype(np.float64)
        means = [np.mean(product, axis=(0, 1)) for product in (x * x, y * y, x * y)]
        tensors.append(np.stack(means, axis=-1)[: len(tile.bands)])
    return np.concatenate(tensors)
