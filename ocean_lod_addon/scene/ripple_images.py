# SPDX-License-Identifier: GPL-3.0-or-later
"""The images of an ocean's ripples, and what else its bump needs of the scene.

Images are made and removed here from operators and changed settings; the frame-change handler only writes pixels.
"""

import bpy
import numpy as np

from ..core.ripples.bump import Bump, BumpLayout

IMAGE_KEY = "ocean_lod_ripples"
"""Custom property of an image of ripples: the name of the material it belongs to, and its number."""


def find_images(owner: str, count: int) -> list:
    """Images number 0 to count - 1 of the material made under the name `owner`; None for one that is missing."""
    found = {
        image[IMAGE_KEY]: image for image in bpy.data.images if image.library is None and IMAGE_KEY in image
    }
    return [found.get(_key(owner, number)) for number in range(count)]


def fit(images: list, layout: BumpLayout) -> bool:
    """Whether there is an image for each tile, of its size: oceans that share a material have those of one."""
    return all(
        image is not None and image.size[0] == tile.texels
        for image, tile in zip(images, layout.tiles, strict=True)
    )


def _key(owner, number):
    return f"{owner} {number}"


def ensure_images(owner: str, layout: BumpLayout) -> list:
    """An image for each tile, of its size; what is left over of an earlier layout is removed."""
    images = []
    for number, (tile, image) in enumerate(
        zip(layout.tiles, find_images(owner, len(layout.tiles)), strict=True)
    ):
        if image is None:
            image = _new_image(owner, number, tile.texels)
        elif tuple(image.size) != (tile.texels, tile.texels):
            image.scale(tile.texels, tile.texels)
        images.append(image)
    remove_images(owner, keep=len(images))
    return images


def _new_image(owner, number, texels):
    image = bpy.data.images.new(
        f"{owner} Ripples {number + 1}", texels, texels, alpha=True, float_buffer=True, is_data=True
    )
    image[IMAGE_KEY] = _key(owner, number)
    image.alpha_mode = "CHANNEL_PACKED"  # alpha is a slope
    image.use_half_precision = False
    return image


def remove_images(owner: str, keep: int = 0) -> None:
    """Remove the images of `owner` from number `keep` on."""
    for image in list(bpy.data.images):
        name, _, number = image.get(IMAGE_KEY, "").rpartition(" ")
        if image.library is None and name == owner and int(number) >= keep:
            bpy.data.images.remove(image)


def write_images(images: list, bump: Bump, time: float) -> None:
    """Show the ripples at `time` in s."""
    for number, (tile, image) in enumerate(zip(bump.layout.tiles, images, strict=True)):
        pixels = np.empty((tile.texels, tile.texels, 4), np.float32)
        bump.image(number, time, pixels)
        write_pixels(image, pixels)


def write_pixels(image, pixels: np.ndarray) -> None:
    """Show `pixels`, (texels, texels, 4) float32, in an image of that size."""
    image.pixels.foreach_set(pixels.ravel())
    image.update_tag()
