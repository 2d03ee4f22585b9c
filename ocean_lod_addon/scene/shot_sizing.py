# SPDX-License-Identifier: GPL-3.0-or-later
"""Size an ocean's plane and ripples for the scene's whole animation."""

import math

import numpy as np

from ..core.errors import OceanError
from ..core.ocean import Surface
from ..core.shot_fit import curvature_shows, fit, fit_ripples, frame_needs
from . import ocean_object, placing, properties

_MOST_FRAMES = 100
"""Frames of a shot that are looked at, evenly spread, first and last among them."""


def fit_to_shot(ob, context, pixels_per_cell: float) -> None:
    """Give an ocean the plane, curvature and lengths of ripples that its scene's camera path asks for.

    Plays through the shot; progress shows at the cursor. Raises OceanError if no frame has a camera.
    """
    scene, manager = context.scene, context.window_manager
    before = scene.frame_current, scene.frame_subframe
    count = min(_MOST_FRAMES, scene.frame_end - scene.frame_start + 1)
    frames = np.unique(np.linspace(scene.frame_start, scene.frame_end, count).round().astype(int))
    width = max(1, scene.render.resolution_x * scene.render.resolution_percentage // 100)
    needs = []
    manager.progress_begin(0, len(frames))
    try:
        for number, frame in enumerate(frames):
            scene.frame_set(int(frame))
            view = placing.camera_view(ob, scene)
            if view is not None:
                needs.append(frame_needs(view, width))
            manager.progress_update(number)
    finally:
        manager.progress_end()
        scene.frame_set(before[0], subframe=before[1])
    if not needs:
        raise OceanError(f"scene {scene.name!r} has no camera to size the ocean for")
    ocean = ocean_object.read_ocean(ob, scene)
    waves = Surface(ocean).waves
    highest = 4.0 * math.sqrt(0.5 * float(np.sum(waves.amplitude**2)))
    grid = fit(ocean.grid, needs, pixels_per_cell, highest)
    properties.write_grid(grid, ob.ocean_lod)
    ripples = properties.read_ripples(ob.ocean_lod)
    properties.write_ripples(fit_ripples(ripples, needs, grid.shortest_wavelength, waves), ob.ocean_lod)
    with properties.many_changes():
        ob.ocean_lod.framing.curved_earth = curvature_shows(needs, grid.half_extent)
    ocean_object.refresh(ob, scene)
