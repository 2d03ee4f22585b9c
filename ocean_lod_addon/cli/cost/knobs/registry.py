# SPDX-License-Identifier: GPL-3.0-or-later
"""All accuracy knobs, and which of a knob's steps are worth having."""

from . import foam, geometry, in_blender, misprints, ripples, shading, waves
from .knob import Knob

KNOBS: tuple[Knob, ...] = (
    geometry.WAVE_COUNT,
    geometry.MESH_DENSITY,
    geometry.WINDOW_WIDTH,
    geometry.PRECISION,
    waves.DISCRETISATION,
    ripples.RIPPLES,
    foam.MEMORY,
    shading.FRESNEL,
    shading.MEAN_FRESNEL,
    shading.MASKING,
    shading.SLOPES,
    shading.SLOPE_VARIANCE,
    shading.ANISOTROPY,
    in_blender.NORMALS,
    in_blender.REFLECTION,
    misprints.EQUATIONS,
)


def worth_having(errors, times) -> list[bool]:
    """For each step of a ladder, whether no other is at least as accurate and as fast, and better in one of both.

    What is left is a monotone ladder: whoever pays more gets less error.
    """
    points = list(zip(errors, times, strict=True))

    def beaten(error, time):
        return any(e <= error and t <= time and (e, t) != (error, time) for e, t in points)

    return [not beaten(error, time) for error, time in points]
