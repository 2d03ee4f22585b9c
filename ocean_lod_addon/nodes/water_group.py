# SPDX-License-Identifier: GPL-3.0-or-later
"""Node group "Ocean LOD Water": the whole material of deep water, one shader output per engine.

`clear_water_group` is the same for water that one looks into; both are put together from the parts here.
"""

from typing import NamedTuple

from .body_group import WATER_BODY
from .graph import Color, Graph, GraphOps, Shader, Vector
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
)
from .sun_group import SUN, SUN_BESIDE_CLOSURE
from .sunlit_body_group import SUNLIT_BODY

SUN_SOCKETS = (SUN_DIRECTION, SUN_IRRADIANCE, SUN_ANGLE)

WATER_SOCKETS = (
    SLOPE_VARIANCE,
    NORMAL,
    WATER_COLOR,
    TINT,
    ROUGHNESS,
    GLITTER_STRENGTH,
    FORMULA_SUN,
    *SUN_SOCKETS,
    MISSING_SUN,
)
"""What the material shows, whether one sees into the water or not."""

PARTS = (
    SLOPES,
    REFLECTED_SHARE_OF_SLOPES,
    REFLECTION,
    WATER_BODY,
    SKY_REFLECTION,
    SUN,
    SUN_BESIDE_CLOSURE,
    SUNLIT_BODY,
)


class Surface(NamedTuple):
    """What both engines need of the surface: inputs of groups, by socket name."""

    slopes: dict
    normal: dict
    reflected_share: dict
    color: Color
    sun: dict


def surface(graph: Graph) -> Surface:
    """The sections that find the unresolved slopes, the reflected share and the tinted color."""
    with graph.section("Unresolved slopes"):
        inputs = {socket.name: graph.input(socket.name) for socket in (SLOPE_VARIANCE, ROUGHNESS)}
        slopes = use_group(graph, SLOPES, inputs)
    with graph.section("Shown normal"):
        normal = {NORMAL.name: graph.label(_shown_normal(graph), "normal of mesh or bump")}
    with graph.section("Reflected share"):
        reflected_share = use_group(graph, REFLECTED_SHARE_OF_SLOPES, slopes | normal)
    with graph.section("Water color"):
        color = graph.label(graph.input(WATER_COLOR.name).times(graph.input(TINT.name)), "tinted color")
    sun = slopes | normal | {socket.name: graph.input(socket.name) for socket in SUN_SOCKETS}
    return Surface(slopes, normal, reflected_share, color, sun)


def _shown_normal(graph: Graph) -> Vector:
    """The input, or the mesh's own normal where nothing is linked to it and it is the vector 0."""
    linked = graph.input(NORMAL.name)
    missing = GraphOps(graph).less_than(linked.dot(linked), 0.5)
    return linked + graph.output_of(graph.node("ShaderNodeNewGeometry"), "Normal") * missing


def body(graph: Graph, parts: Surface, color: Color) -> Shader:
    """Light of the whole scene that comes back out of water of the given color."""
    inputs = {WATER_COLOR.name: color, **parts.reflected_share, **parts.normal}
    return use_group(graph, WATER_BODY, inputs)[BSDF.name]


def cycles_reflection(graph: Graph, parts: Surface) -> tuple[Shader, Shader]:
    """The closure, and the sun that the formula adds to it.

    The closure reflects the sun as well, so only what the artist's strength adds to it (or takes from it: in
    Cycles emission may be negative) comes from the formula. At 1 Cycles drops the formula altogether.
    """
    closure = use_group(graph, REFLECTION, parts.slopes | parts.normal)[BSDF.name]
    surplus = graph.input(GLITTER_STRENGTH.name) - 1.0 + graph.input(FORMULA_SUN.name)
    surplus = graph.label(surplus, "glitter beyond the closure's")
    inputs = parts.sun | {GLITTER_STRENGTH.name: surplus, FORMULA_SUN.name: graph.input(FORMULA_SUN.name)}
    inputs = {socket.name: inputs[socket.name] for socket in SUN_BESIDE_CLOSURE.inputs}
    return closure, use_group(graph, SUN_BESIDE_CLOSURE, inputs)[BSDF.name]


def eevee_reflection(graph: Graph, parts: Surface) -> tuple[Shader, Shader]:
    """The sky's reflection, and the sun's by the formula."""
    variances = {socket.name: parts.slopes[socket.name] for socket in SKY_REFLECTION.inputs[:2]}
    sky = use_group(graph, SKY_REFLECTION, variances | parts.reflected_share | parts.normal)[BSDF.name]
    strength = {GLITTER_STRENGTH.name: graph.input(GLITTER_STRENGTH.name)}
    return sky, use_group(graph, SUN, parts.sun | strength)[BSDF.name]


def eevee_sunlit_body(graph: Graph, parts: Surface, color: Color) -> Shader:
    """The body in the light of a sun that EEVEE leaves out."""
    missing = graph.input(SUN_IRRADIANCE.name) * graph.input(MISSING_SUN.name)
    inputs = parts.reflected_share | parts.normal | {
        WATER_COLOR.name: color,
        SUN_DIRECTION.name: graph.input(SUN_DIRECTION.name),
        SUN_IRRADIANCE.name: graph.label(missing, "sun that EEVEE leaves out"),
    }
    return use_group(graph, SUNLIT_BODY, inputs)[BSDF.name]


def _build(graph: Graph):
    """Reflection, body and sun for each engine."""
    parts = surface(graph)
    with graph.section("Cycles"):
        cycles = graph.add_shaders(*cycles_reflection(graph, parts), body(graph, parts, parts.color))
    with graph.section("EEVEE"):
        below = (body(graph, parts, parts.color), eevee_sunlit_body(graph, parts, parts.color))
        eevee = graph.add_shaders(*eevee_reflection(graph, parts), *below)
    graph.output(CYCLES.name, cycles)
    graph.output(EEVEE.name, eevee)


WATER = GroupRecipe(
    "Ocean LOD Water", "7", inputs=WATER_SOCKETS, outputs=(CYCLES, EEVEE), build=_build, needs=PARTS
)
