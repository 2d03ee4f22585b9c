# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups "Ocean LOD Water": the whole material of deep water, one shader output per engine.

`clear_water_group` is the same for water that one looks into; both are put together from the parts here. Each
comes with Gaussian slopes and with skewed ones. The parts hand on the values they know in one table, by socket
name.
"""

from ..core.optics.eevee_closures import HALF_COLOR_STEP
from .body_group import WATER_BODY
from .graph import Graph, GraphOps, Shader, Vector
from .groups import GroupRecipe, use_group
from .reflected_share_group import REFLECTED_SHARE_OF_SLOPES
from .reflection_group import REFLECTION
from .sky_reflection_group import SKY_REFLECTION
from .slopes_group import SLOPES
from .sockets import (
    BSDF,
    CYCLES,
    EEVEE,
    FORMULA_SUN,
    GLITTER_STRENGTH,
    MISSING_SUN,
    NORMAL,
    ROUGHNESS,
    SLOPE_VARIANCE,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    TINT,
    WATER_COLOR,
    WIND_DIRECTION,
    WIND_SPEED,
)
from .sun_group import SKEWED_SUN, SUN, SUN_BESIDE_CLOSURE
from .sunlit_body_group import SUNLIT_BODY

WATER_SOCKETS = (
    SLOPE_VARIANCE,
    NORMAL,
    WATER_COLOR,
    TINT,
    ROUGHNESS,
    GLITTER_STRENGTH,
    FORMULA_SUN,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    SUN_ANGLE,
    MISSING_SUN,
)
"""What the material shows, whether one sees into the water or not."""

SKEWED_SOCKETS = (WIND_DIRECTION, WIND_SPEED)
"""What it shows in addition with skewed slopes."""

PARTS = (
    SLOPES,
    REFLECTED_SHARE_OF_SLOPES,
    REFLECTION,
    WATER_BODY,
    SKY_REFLECTION,
    SUN_BESIDE_CLOSURE,
    SUNLIT_BODY,
)


def surface(graph: Graph, sockets) -> dict:
    """The group's inputs, the unresolved slopes, the shown normal, the reflected share and the tinted color."""
    values = {socket.name: graph.input(socket.name) for socket in sockets}
    with graph.section("Unresolved slopes"):
        values |= use_group(graph, SLOPES, values)
    with graph.section("Shown normal"):
        values[NORMAL.name] = graph.label(_shown_normal(graph), "normal of mesh or bump")
    with graph.section("Reflected share"):
        values |= use_group(graph, REFLECTED_SHARE_OF_SLOPES, values)
    with graph.section("Water color"):
        color = values[WATER_COLOR.name].times(values[TINT.name])
        values[WATER_COLOR.name] = graph.label(color, "tinted color")
    return values


def _shown_normal(graph: Graph) -> Vector:
    """The input, or the mesh's own normal where nothing is linked to it and it is the vector 0."""
    linked = graph.input(NORMAL.name)
    missing = GraphOps(graph).less_than(linked.dot(linked), 0.5)
    return linked + graph.output_of(graph.node("ShaderNodeNewGeometry"), "Normal") * missing


def body(graph: Graph, values: dict) -> Shader:
    """Light of the whole scene that comes back out of the water."""
    return use_group(graph, WATER_BODY, values)[BSDF.name]


def cycles_reflection(graph: Graph, values: dict, sun: GroupRecipe) -> tuple[Shader, Shader, Shader]:
    """The closure, the sun beside it, and the sun instead of it.

    The closure reflects the sun itself, so only what the artist's strength adds to that comes from a formula
    beside it, or is taken away: in Cycles emission may be negative. The formula instead is that of EEVEE. What
    has strength 0, and by default both have, Cycles drops before it renders.
    """
    closure = use_group(graph, REFLECTION, values)[BSDF.name]
    strength, formula = values[GLITTER_STRENGTH.name], values[FORMULA_SUN.name]
    beside = graph.label((strength - 1.0) * (1.0 - formula), "glitter beyond the closure's")
    instead = graph.label(strength * formula, "glitter by formula")
    beside = use_group(graph, SUN_BESIDE_CLOSURE, values | {GLITTER_STRENGTH.name: beside})[BSDF.name]
    instead = use_group(graph, sun, values | {GLITTER_STRENGTH.name: instead})[BSDF.name]
    return closure, beside, instead


def eevee_reflection(graph: Graph, values: dict, sun: GroupRecipe) -> tuple[Shader, Shader]:
    """The sky's reflection, and the sun's by the formula."""
    return use_group(graph, SKY_REFLECTION, values)[BSDF.name], use_group(graph, sun, values)[BSDF.name]


def eevee_body(graph: Graph, values: dict) -> Shader:
    """The body as EEVEE must be told it, which cuts off its dark color."""
    step = graph.vector(*(3 * [HALF_COLOR_STEP]))
    color = graph.label(values[WATER_COLOR.name] + step, "color as EEVEE stores it")
    return body(graph, values | {WATER_COLOR.name: color})


def eevee_sunlit_body(graph: Graph, values: dict) -> Shader:
    """The body in the light of a sun that EEVEE leaves out."""
    missing = values[SUN_IRRADIANCE.name] * values[MISSING_SUN.name]
    missing = graph.label(missing, "sun that EEVEE leaves out")
    return use_group(graph, SUNLIT_BODY, values | {SUN_IRRADIANCE.name: missing})[BSDF.name]


def _build(graph: Graph, sockets, sun: GroupRecipe):
    """Reflection, body and sun for each engine."""
    values = surface(graph, sockets)
    with graph.section("Cycles"):
        cycles = graph.add_shaders(*cycles_reflection(graph, values, sun), body(graph, values))
    with graph.section("EEVEE"):
        below = (eevee_body(graph, values), eevee_sunlit_body(graph, values))
        eevee = graph.add_shaders(*eevee_reflection(graph, values, sun), *below)
    graph.output(CYCLES.name, cycles)
    graph.output(EEVEE.name, eevee)


def _recipe(name, sockets, sun):
    return GroupRecipe(
        name, "9", sockets, (CYCLES, EEVEE), lambda graph: _build(graph, sockets, sun), needs=(*PARTS, sun)
    )


WATER = _recipe("Ocean LOD Water", WATER_SOCKETS, SUN)
SKEWED_WATER = _recipe("Ocean LOD Skewed Water", WATER_SOCKETS + SKEWED_SOCKETS, SKEWED_SUN)
