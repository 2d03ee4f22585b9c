# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole configurations from Draft to Reference: the same sea, waves and all, drawn with more or less effort.

Every step keeps the shortest wave of the mesh, and with it each single wave: crests stay where they are, so that a
shot laid out in Draft is the shot that is rendered in Film. What changes is how many vertices a wave has, how far
from the camera it stays geometry, the images of the ripples, and how finely the trail of a breaking crest fades.
"""

from dataclasses import dataclass, replace

from ..effects import AUTO, OFF
from ..lod import CELLS_STEP, Grid
from ..parameters import parameters_of
from ..plan import Settings

_KEPT_EXTENT = 0.97
"""Of the sized plane's, at least: cells come in eights, and another level would double it."""

_MOST_LEVELS = parameters_of(Grid)["levels"].maximum
_MOST_CELLS = parameters_of(Grid)["cells"].maximum


@dataclass(frozen=True)
class Quality:
    """How much effort is spent.

    samples   vertices per wavelength of the shortest wave, 2 or more
    reach     how far waves stay geometry, over how far they do on the plane that was sized by the artist
    ripples   texels along a side of the ripples' images, or "off": then they are roughness
    instants  at how many instants foam is looked for; with 1 a breaking crest leaves no trail
    """

    label: str
    description: str
    samples: float
    reach: float
    ripples: str
    instants: int


QUALITIES: dict[str, Quality] = {
    "draft": Quality(
        "Draft", "To lay out a shot: waves are coarse and soon fade, ripples are roughness", 2.0, 0.25, "off", 1
    ),
    "preview": Quality("Preview", "To judge motion: ripples move, foam trails", 3.0, 1.0, "256", 4),
    "standard": Quality("Standard", "As the plane was sized for the shot", 4.0, 1.0, "512", 16),
    "film": Quality("Film", "For the final picture: smooth waves up close", 6.0, 1.0, "512", 16),
    "reference": Quality(
        "Reference",
        "What the others are measured by: twice of everything shows no difference",
        8.0,
        1.0,
        "2048",
        64,
    ),
}
"""By name, each at least as accurate as the one before in every respect."""


def apply(quality: Quality, settings: Settings) -> Settings:
    """The settings with this quality; `settings` hold the plane as it was sized for the shot.

    Ripples that the artist has switched off by their kind stay off.
    """
    ripples = settings.ripples
    if ripples.kind != "off" and quality.ripples != "off":
        ripples = replace(ripples, kind="spectral", resolution=quality.ripples)
    effects = replace(settings.effects, ripples=OFF if quality.ripples == "off" else AUTO)
    foam = replace(settings.foam, memory_steps=quality.instants)
    return replace(settings, grid=_grid(quality, settings.grid), ripples=ripples, foam=foam, effects=effects)


def _grid(quality, sized):
    """The plane with the same shortest wave and at least the same extent."""
    cells_per_sample = sized.cells / sized.samples_per_wavelength
    wanted = cells_per_sample * quality.reach * quality.samples
    cells = CELLS_STEP * max(1, round(wanted / CELLS_STEP))
    return _with_cells(sized, min(cells, _MOST_CELLS), quality.samples)


def _with_cells(sized, cells, samples):
    cell_size = sized.shortest_wavelength / samples
    levels = 1
    while levels < _MOST_LEVELS and cell_size * 2.0 ** (levels - 1) * cells / 2 < _KEPT_EXTENT * sized.half_extent:
        levels += 1
    return Grid(cell_size, cells, levels, samples)


_RIPPLES_FROM = 1 / 3
"""Of the way from a quality without ripples to one with them."""


@dataclass(frozen=True)
class Rung:
    """A step of the ladder of whole configurations: a named quality, or one between two of them."""

    name: str
    quality: Quality

    @property
    def label(self) -> str:
        """For a panel: the quality's name, or that of the one below and a plus sign."""
        return self.quality.label


def ladder(sized: Grid) -> list[Rung]:
    """The qualities and all planes between two of them, whose sides differ by the smallest number of cells.

    Between two qualities, samples and reach go over from one to the other and the ripples are those of the lower;
    between one without and one with ripples they begin on the way.
    """
    rungs = []
    names = list(QUALITIES)
    for name, above in zip(names, [*names[1:], None], strict=True):
        low = QUALITIES[name]
        rungs.append(Rung(name, low))
        if above is None:
            break
        high = QUALITIES[above]
        cells = [_grid(quality, sized).cells for quality in (low, high)]
        steps = (cells[1] - cells[0]) // CELLS_STEP
        for number in range(1, steps):
            share = number / steps
            ripples = high.ripples if low.ripples == "off" and share >= _RIPPLES_FROM else low.ripples
            between = replace(
                low,
                ripples=ripples,
                label=f"{low.label}+",
                description=f"Between {low.label} and {high.label}",
                samples=low.samples + share * (high.samples - low.samples),
                reach=low.reach + share * (high.reach - low.reach),
            )
            rungs.append(Rung(f"{name}+", between))
    return rungs
