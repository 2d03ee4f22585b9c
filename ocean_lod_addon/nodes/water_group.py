# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Water": the whole material, one shader output per engine."""

from .body_group import WATER_BODY
from .graph import Graph
from .groups import GroupRecipe, Socket, use_group
from .mean_fresnel_group import MEAN_FRESNEL_OF_SLOPES
from .reflection_group import REFLECTION
from .sky_reflection_group import SKY_REFLECTION
from .slopes_group import SLOPES
from .sockets import (
    BSDF,
    GLITTER_STRENGTH,
    ROUGHNESS,
    SLOPE_VARIANCE,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    WATER_COLOR,
)
from .sun_group import SUN
from .sunlit_body_group import SUNLIT_BODY

TINT = Socket(
    "Tint",
    "COLOR",
    "Factor on the color of the water, per channel. White is physical",
    (1.0, 1.0, 1.0, 1.0),
)
FORMULA_SUN = Socket(
    "Formula Sun in Cycles",
    "FLOAT",
    "1 to reflect the sun in Cycles by the formula that EEVEE uses instead of by the closure. The Sun light must "
    "then be invisible to glossy rays",
    0.0,
    0.0,
    1.0,
    "FACTOR",
)
MISSING_SUN = Socket(
    "Missing Sun in EEVEE",
    "FLOAT",
    "1 where EEVEE does not light the sea with this sun, as with the disc of a Sky Texture; 0 for a Sun light",
    0.0,
    0.0,
    1.0,
    "FACTOR",
)
SUN_SOCKETS = (SUN_DIRECTION, SUN_IRRADIANCE, SUN_ANGLE)
CYCLES = Socket("Cycles", "SHADER", "Surface for Cycles")
EEVEE = Socket("EEVEE", "SHADER", "Surface for EEVEE")


def _build(graph: Graph):
    """Slopes, then reflection, body and sun, then their sum for each engine.

    In Cycles the closure reflects the sun as well, so only what the artist's strength adds to it (or takes from
    it: emission may be negative there) comes from the formula. At 1 Cycles drops the formula altogether.
    """
    with graph.section("Unresolved slopes"):
        inputs = {socket.name: graph.input(socket.name) for socket in (SLOPE_VARIANCE, ROUGHNESS)}
        slopes = use_group(graph, SLOPES, inputs)
    with graph.section("Mean Fresnel"):
        mean_fresnel = use_group(graph, MEAN_FRESNEL_OF_SLOPES, slopes)
    with graph.section("Water body"):
        color = graph.label(graph.input(WATER_COLOR.name).times(graph.input(TINT.name)), "tinted color")
        body = use_group(graph, WATER_BODY, {WATER_COLOR.name: color, **mean_fresnel})[BSDF.name]
    sun_inputs = slopes | {socket.name: graph.input(socket.name) for socket in SUN_SOCKETS}
    with graph.section("Cycles"):
        reflection = use_group(graph, REFLECTION, slopes)[BSDF.name]
        surplus = graph.input(GLITTER_STRENGTH.name) - 1.0 + graph.input(FORMULA_SUN.name)
        surplus = graph.label(surplus, "glitter beyond the closure's")
        sun = use_group(graph, SUN, sun_inputs | {GLITTER_STRENGTH.name: surplus})[BSDF.name]
        cycles = graph.add_shaders(reflection, body, sun)
    with graph.section("EEVEE"):
        variances = {socket.name: slopes[socket.name] for socket in SKY_REFLECTION.inputs[:2]}
        sky = use_group(graph, SKY_REFLECTION, variances | mean_fresnel)[BSDF.name]
        strength = {GLITTER_STRENGTH.name: graph.input(GLITTER_STRENGTH.name)}
        sun = use_group(graph, SUN, sun_inputs | strength)[BSDF.name]
        missing = graph.input(SUN_IRRADIANCE.name) * graph.input(MISSING_SUN.name)
        sunlit_inputs = mean_fresnel | {
            WATER_COLOR.name: color,
            SUN_DIRECTION.name: graph.input(SUN_DIRECTION.name),
            SUN_IRRADIANCE.name: graph.label(missing, "sun that EEVEE leaves out"),
        }
        sunlit = use_group(graph, SUNLIT_BODY, sunlit_inputs)[BSDF.name]
        eevee = graph.add_shaders(sky, body, sun, sunlit)
    graph.output(CYCLES.name, cycles)
    graph.output(EEVEE.name, eevee)


WATER = GroupRecipe(
    "Ocean LOD Water",
    "3",
    inputs=(
        SLOPE_VARIANCE,
        WATER_COLOR,
        TINT,
        ROUGHNESS,
        GLITTER_STRENGTH,
        FORMULA_SUN,
        *SUN_SOCKETS,
        MISSING_SUN,
    ),
    outputs=(CYCLES, EEVEE),
    build=_build,
    needs=(SLOPES, MEAN_FRESNEL_OF_SLOPES, REFLECTION, WATER_BODY, SKY_REFLECTION, SUN, SUNLIT_BODY),
)
