# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered pictures as arrays."""

import bpy
import numpy as np


def read_pixels(path) -> np.ndarray:
    """The pixels of a picture file, (height, width, 4) float32, bottom row first, as stored."""
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = np.empty((height, width, 4), np.float32)
    image.pixels.foreach_get(pixels.ravel())
    bpy.data.images.remove(image)
    return pixels
