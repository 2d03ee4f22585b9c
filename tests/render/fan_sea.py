# SPDX-License-Identifier: GPL-3.0-or-later
"""A flat sea that one picture shows from the zenith nearly to the horizon, for what is slow to start: EEVEE.

The camera stands above the point where sectors of the sea meet. It looks along +x, level, with its picture shifted
down, so that every column of the picture shows one sector, and every row another angle of view.
"""

import itertools
import math

import bpy
import numpy as np

from tests.render.flat_sea import FlatSea, mesh_with_variances

WIDTH = 0.35
"""Tangent of half of the picture's angle sideways."""

STEEPEST = 5.7
"""Tangent of the view's greatest elevation, 80 degrees."""

FARTHEST = 1000.0
"""Of the sectors, in heights of the camera: beyond the lowest row."""


class FanSea(FlatSea):
    """The scene: a sector of a material per slope variance tensor, and the picture of them."""

    def __init__(self, material, tensors):
        super().__init__(material, tensors)
        pixel = 2.0 * WIDTH / self.columns
        rows = round(STEEPEST / pixel)
        camera = self.camera.data
        camera.type, camera.sensor_width, camera.lens = "PERSP", 200.0 * WIDTH, 100.0
        camera.shift_y, camera.clip_start = -0.5 * rows / self.columns, 1e-3
        self.camera.location, self.camera.rotation_euler = (0.0, 0.0, 1.0), (0.5 * math.pi, 0.0, -0.5 * math.pi)
        self.scene.render.resolution_y = rows
        right = (np.arange(self.columns) + 0.5) * pixel - WIDTH
        down = (rows - np.arange(rows) - 0.5) * pixel
        x, z = np.meshgrid(right, down)
        to_viewer = np.stack([-np.ones_like(x), x, z], axis=-1)
        self.to_viewer = to_viewer / np.linalg.norm(to_viewer, axis=-1, keepdims=True)
        """Unit vectors to the viewer, shape (rows from below, columns, 3)"""

    def _add_strips(self, material, tensors):
        edges = np.linspace(WIDTH, -WIDTH, len(tensors) + 1)
        sectors = [
            [(0.0, 0.0, 0.0), (FARTHEST, FARTHEST * right, 0.0), (FARTHEST, FARTHEST * left, 0.0)]
            for left, right in itertools.pairwise(edges)
        ]
        self.sea = bpy.data.objects.new("Sea", mesh_with_variances(material, sectors, tensors))
        self.scene.collection.objects.link(self.sea)
