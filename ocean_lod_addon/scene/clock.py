# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's clock: frame rate, time remapping, sub-frames."""

from . import rna


def current_frame(scene) -> float:
    """The scene's frame number with its sub-frame, before time remapping."""
    return scene.frame_current + scene.frame_subframe


def frames_per_second(scene) -> float:
    """The scene's frame rate, with its time remapping: `new` frames play in the time of `old` ones."""
    render = scene.render
    rate = render.fps / rna.typed_number(render.fps_base)
    return rate * render.frame_map_new / render.frame_map_old
