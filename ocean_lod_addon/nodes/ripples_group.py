# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Ripples": the bump level of one ocean.

Per image of slopes, three looks at it: the water is covered by three square grids, shifted against each other by
a third of a cell, and every cell looks at a place of its own in the image, of which it sees a ninth. Their
weights fade to 0 at the border of a cell, so that no border shows, and are normalised so that the variance is the
same everywhere; where one grid has a border, another has not. So the image never repeats: two cells may see the
same part of it, but they are a small share of any picture.

A look picks one texel, at random up to half a texel beside its place, so that the samples of a pixel see the image
as linear interpolation would show it on average, and each of them slopes with all their variance. Interpolated
images lose some, and EEVEE would fade them by mip maps, besides what is faded here.

Ripples ride on longer ripples as they do on the waves of the mesh: an image is looked up at the places that water
had before the ripples of the images before displaced it.

Per band of waves, what `core.ripples.shading` says: the amplitude that the mesh leaves to it, faded by the size of
a pixel. What neither mesh nor bump shows is left to the BRDF.
"""

import hashlib
from collections.abc import Sequence

from ..core.plan import GUST_ATTRIBUTE, REST_POSITION_ATTRIBUTE, RIPPLE_AMPLITUDE_ATTRIBUTE
from ..core.ripples import shading
from ..core.ripples.bump import BumpLayout
from . import ripple_parts as parts
from .graph import Graph, GraphOps
from .groups import GroupRecipe, Socket, use_group
from .sockets import NORMAL, SLOPE_VARIANCE

BANDS_PER_ATTRIBUTE = 4

WAVE_HEIGHT = Socket(
    "Wave Height", "FLOAT", "Significant wave height: random ripples are stronger on high water", 1.0, 0.0, 100.0
)

GRIDS = 3

_LEAST_WAVE_HEIGHT = 1e-3  # m; a flat sea has no high water


def variance_socket(band: int) -> Socket:
    """The slope variance of band number `band`, an input that follows the sea state."""
    return Socket(
        f"Variance {band + 1}",
        "VECTOR",
        "Slope variance of this band of waves as (xx, yy, xy). The first band has the longest waves",
        hide_value=True,
    )


class _Builder:
    """Fills the group's graph for one layout."""

    def __init__(self, graph: Graph, layout: BumpLayout, images: Sequence):
        self.graph, self.ops, self.layout, self.images = graph, GraphOps(graph), layout, images

    def build(self):
        graph, layout = self.graph, self.layout
        with graph.section("How the point is seen"):
            view = use_group(graph, parts.VIEW, {})
        with graph.section("Left by the mesh"):
            rest = graph.output_of(self.attribute(REST_POSITION_ATTRIBUTE), "Vector")
            amplitudes = self.amplitudes()
        with graph.section("Random place in a texel"):
            beside = self.beside(rest)
        sums = {socket.name: 0.0 for socket in parts.SUMS}
        numbered = iter(enumerate(zip(layout.bands, amplitudes, strict=True)))
        for number, tile in enumerate(layout.tiles):
            with graph.section(f"Image {number + 1}"):
                slopes_of_bands = self.slopes(number, rest + beside * (tile.size / tile.texels))
            with graph.section(f"Bands of image {number + 1}"):
                shown = [(*next(numbered), slopes) for slopes in slopes_of_bands]
                for index, (band, amplitude), (x, y) in shown:
                    own = {
                        parts.WAVENUMBER_2.name: band.middle_wavenumber**2,
                        parts.AMPLITUDE.name: amplitude,
                        parts.SLOPE_X.name: x,
                        parts.SLOPE_Y.name: y,
                        parts.VARIANCE.name: graph.input(variance_socket(index).name),
                    }
                    sums = use_group(graph, parts.BAND, view | own | sums)
            if tile != layout.tiles[-1]:
                with graph.section(f"What rides on image {number + 1}"):
                    for _, (band, amplitude), slopes in shown:
                        wave = (*slopes, amplitude, band.middle_wavenumber)
                        rest = shading.undisturbed_by(self.ops, rest, *wave)
        with graph.section("Surface"):
            unresolved = {SLOPE_VARIANCE.name: graph.input(SLOPE_VARIANCE.name)}
            surface = use_group(graph, parts.SURFACE, view | unresolved | sums)
        for name, value in surface.items():
            graph.output(name, value)

    def beside(self, rest):
        """A random vector (x, y, 0) from -1/2 to 1/2 along both axes, another one at every place."""
        noise = self.graph.node("ShaderNodeTexWhiteNoise", inputs={"Vector": rest}, noise_dimensions="3D")
        x, y, _ = self.graph.output_of(noise, "Color").components()
        return self.graph.vector(x - 0.5, y - 0.5, 0.0)

    def attribute(self, name: str):
        return self.graph.node("ShaderNodeAttribute", name, attribute_name=name, attribute_type="GEOMETRY")

    def amplitudes(self):
        """The amplitude of each band that the mesh leaves to the bump."""
        graph, count = self.graph, self.layout.handed_over
        result = []
        for first in range(0, count, BANDS_PER_ATTRIBUTE):
            attribute = self.attribute(f"{RIPPLE_AMPLITUDE_ATTRIBUTE}{first // BANDS_PER_ATTRIBUTE}")
            result += graph.output_of(attribute, "Color").components()
            result.append(graph.output_of(attribute, "Alpha"))
        never_resolved = 1.0
        if self.layout.gusts:
            never_resolved = graph.output_of(self.attribute(GUST_ATTRIBUTE), 2)  # Fac, or Factor
        result = result[:count] + [never_resolved] * (len(self.layout.bands) - count)
        if self.layout.kind == "random":
            factor = self.on_high_water()
            result = [amplitude * factor for amplitude in result]
        return result

    def on_high_water(self):
        """Amplitude of random ripples over its mean: the variance is 1 + z / wave height, whose mean is 1."""
        graph, ops = self.graph, self.ops
        z = graph.output_of(graph.node("ShaderNodeTexCoord"), "Object").components()[2]
        height = ops.maximum(graph.input(WAVE_HEIGHT.name), _LEAST_WAVE_HEIGHT)
        return graph.label(ops.sqrt(ops.maximum(z / height + 1.0, 0.0)), "stronger on high water")

    def slopes(self, number: int, place) -> list[tuple]:
        """Slopes (x, y) of each band of image `number` at a place."""
        ops, bands = self.ops, len(self.layout.tiles[number].bands)
        channels, weights = [0.0] * (2 * bands), []
        for grid in range(GRIDS):
            own_channels, weight = self.look(number, grid, place)
            weights.append(weight)
            pairs = zip(own_channels, channels, strict=False)
            channels = [ops.multiply_add(own, weight, others) for own, others in pairs]
        normaliser = self.graph.label(shading.blend_normaliser(ops, weights), "1 / weights")
        channels = [channel * normaliser for channel in channels]
        return [(channels[2 * band], channels[2 * band + 1]) for band in range(bands)]

    def look(self, number: int, grid: int, place):
        """The channels of image `number` as grid number `grid` sees it, and the weight of what it sees."""
        graph = self.graph
        inputs = {
            parts.REST_POSITION.name: place,
            parts.CELLS_PER_METRE.name: shading.CELLS_PER_TILE / self.layout.tiles[number].size,
            parts.SHIFT.name: (grid / GRIDS, grid / GRIDS, GRIDS * number + grid + 0.5),
        }
        look = use_group(graph, parts.LOOK, inputs)
        image = graph.node(
            "ShaderNodeTexImage",
            f"Slopes {number + 1}",
            {"Vector": look[parts.PLACE.name]},
            image=self.images[number],
            interpolation="Closest",
            extension="REPEAT",
        )
        channels = (*graph.output_of(image, "Color").components(), graph.output_of(image, "Alpha"))
        return channels, look[parts.WEIGHT.name]


def ripples_recipe(name: str, layout: BumpLayout, images: Sequence) -> GroupRecipe:
    """The recipe of the group called `name`, for this layout and an image for each of its tiles."""
    variances = tuple(variance_socket(index) for index in range(len(layout.bands)))
    extra = (WAVE_HEIGHT,) if layout.kind == "random" else ()
    description = repr((layout, [image.name for image in images]))
    return GroupRecipe(
        name,
        "4 " + hashlib.blake2b(description.encode(), digest_size=8).hexdigest(),
        inputs=(SLOPE_VARIANCE, *variances, *extra),
        outputs=(SLOPE_VARIANCE, NORMAL),
        build=lambda graph: _Builder(graph, layout, images).build(),
        needs=(parts.VIEW, parts.LOOK, parts.BAND, parts.SURFACE),
    )
