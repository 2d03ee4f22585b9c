# SPDX-License-Identifier: GPL-3.0-or-later
"""The knob of ripples: what is shown of the waves that are too short for the mesh, and what is roughness."""

import dataclasses
import functools
import itertools

import numpy as np

from ....core.lod import Grid
from ....core.ocean import Ocean, Surface
from ....core.parameters import parameters_of
from ....core.ripple_settings import Ripples
from ....core.ripples.bump import bump_layout, random_density
from ....core.ripples.spectrum import ripple_spectrum, slope_tensor_between
from ....core.ripples.synthesis import band_waves, ripple_water
from ....core.sea import Sea
from .knob import Knob, Step

_GRID, _SEA = Grid(), Sea()
_STEPS_PER_OCTAVE = 2


def _classes():
    """Classes of wavelength, half an octave each, from the shortest ripple to the shortest wave of the mesh."""
    low, high = Ripples().shortest_wavelength, _GRID.shortest_wavelength
    return np.geomspace(low, high, 1 + round(_STEPS_PER_OCTAVE * np.log2(high / low)))


@functools.lru_cache(maxsize=1)
def _wanted():
    """Slope variances (xx, yy, xy) of the sea's ripples in each class, (classes, 3)."""
    density = ripple_spectrum(_SEA, _GRID.shortest_wavelength).density
    return np.array([slope_tensor_between(density, a, b) for a, b in itertools.pairwise(_classes())])


def wrong_share(shown: np.ndarray, wanted: np.ndarray) -> float:
    """How much of the slope variance is shown at a wrong length, in a wrong direction or not at all, as a share.

    `shown` and `wanted` are tensors (xx, yy, xy) by class of wavelength, (classes, 3). A tensor's size is the sum
    of the absolute values of its eigenvalues. What is shown in place of something else counts once, not twice.
    """
    difference = shown - wanted
    mean = 0.5 * (difference[:, 0] + difference[:, 1])
    radius = np.hypot(0.5 * (difference[:, 0] - difference[:, 1]), difference[:, 2])
    size = np.abs(mean + radius) + np.abs(mean - radius)
    missing = max(0.0, float((wanted - shown)[:, :2].sum()))
    total = float(wanted[:, :2].sum())
    return 0.5 * (float(size.sum()) + missing) / total


def _settings(kind, resolution=None):
    settings = Ripples(kind=kind)
    return settings if resolution is None else dataclasses.replace(settings, resolution=resolution)


def _density(settings):
    spectrum = ripple_spectrum(_SEA, _GRID.shortest_wavelength)
    if settings.kind == "random":
        layout = bump_layout(settings, _GRID.shortest_wavelength)
        return random_density(spectrum, settings.shortest_wavelength, layout.bands)
    return spectrum.density


def _shown(settings):
    """Slope variances of the images' waves in each class, (classes, 3)."""
    density, classes = _density(settings), _classes()
    shown = np.zeros((len(classes) - 1, 3))
    for tile in bump_layout(settings, _GRID.shortest_wavelength).tiles:
        for band in tile.bands:
            waves = band_waves(density, tile, band, ripple_water(_SEA), 0.0, 0).waves
            k, theta = waves.wavenumber, waves.direction
            variance = 0.5 * (k * waves.amplitude) ** 2
            tensors = variance * np.stack([np.cos(theta) ** 2, np.sin(theta) ** 2, np.cos(theta) * np.sin(theta)])
            inside = (waves.wavelength >= classes[0]) & (waves.wavelength < classes[-1])
            number = np.clip(np.searchsorted(classes, waves.wavelength, side="right") - 1, 0, len(shown) - 1)
            for component, values in enumerate(tensors):
                shown[:, component] += np.bincount(number[inside], values[inside], minlength=len(shown))
    return shown


def ripple_error(settings: Ripples) -> float:
    """Share of the slope variance of ripples that these settings show wrongly or not at all, %."""
    if settings.kind == "off":
        return 100.0
    return 100.0 * wrong_share(_shown(settings), _wanted())


def _images(settings):
    """The images of one frame."""
    bump = Surface(Ocean(_SEA, _GRID, ripples=settings)).bump
    texels = settings.texels
    out = np.empty((texels, texels, 4), np.float32)

    def write(time):
        for number in range(len(bump.layout.tiles)):
            bump.image(number, time, out)

    return write


def _steps():
    yield Step("none", lambda: ripple_error(_settings("off")), None)
    random = _settings("random")
    yield Step("random, still", functools.partial(ripple_error, random), functools.partial(_images, random))
    for option in parameters_of(Ripples)["resolution"].options:
        settings = _settings("spectral", option.key)
        yield Step(
            f"spectral, {option.key}",
            functools.partial(ripple_error, settings),
            functools.partial(_images, settings),
        )


RIPPLES = Knob(
    "ripples",
    "Ripples",
    "The texture of the water nearby: what is not shown as ripples is shown as roughness",
    "Ripples shown at a wrong length, in a wrong direction, or not at all",
    "% of the ripples' slope variance",
    "The spectrum from 6 mm to the shortest wave of the mesh, in half octaves (wind 10 m/s)",
    "all images of a frame",
    tuple(_steps()),
)
