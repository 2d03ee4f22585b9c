# SPDX-License-Identifier: GPL-3.0-or-later
"""The ocean material: one group node between the mesh's slope variance and an output for each engine."""

import json

import bpy
import numpy as np

from ..core.material_settings import MaterialSettings
from ..core.optics.color import reflectance_to_rec709
from ..core.optics.water_types import (
    WATER_TYPES,
    WAVELENGTHS,
    rgb_absorption,
    rgb_backscattering,
    water_leaving_reflectance,
)
from ..core.plan import WATER_NODE
from ..core.sun import Sun
from .clear_water_group import CLEAR_WATER, SKEWED_CLEAR_WATER
from .groups import ensure_group, remove_unused
from .layout import arrange, fitting_width
from .sockets import (
    ABSORPTION,
    BACKSCATTERING,
    CYCLES,
    EEVEE,
    EEVEE_DEPTH,
    FORMULA_SUN,
    GLITTER_STRENGTH,
    MISSING_SUN,
    ROUGHNESS,
    SLOPE_VARIANCE,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    TINT,
    VOLUME,
    WATER_COLOR,
    WIND_DIRECTION,
    WIND_SPEED,
)
from .water_group import SKEWED_WATER, WATER

NODE_NAME = WATER_NODE
"""Name of the group node in a material."""

_RECIPES = {
    (False, False): WATER,
    (False, True): SKEWED_WATER,
    (True, False): CLEAR_WATER,
    (True, True): SKEWED_CLEAR_WATER,
}
"""By see_through and skewed_slopes."""

SLOPE_VARIANCE_ATTRIBUTE = "ocean_slope_variance"
"""Point attribute (FLOAT_VECTOR) of the mesh: unresolved slope variance (xx, yy, xy) in the object's axes."""

MATERIAL_KEY = "ocean_lod_material"
"""Custom property of a material that this extension made: the name it was made under."""

APPLIED_KEY = "ocean_lod_applied"
"""Custom property of such a material or node: the socket values last set from settings, as JSON."""


def find_material(name: str):
    """The material that was made under `name`, whatever it is called by now, or None."""
    made_by_us = [
        material
        for material in bpy.data.materials
        if material.library is None and material.get(MATERIAL_KEY) == name
    ]
    return min(made_by_us, key=lambda material: (material.name != name, material.name), default=None)


def is_our_water(material: bpy.types.Material | None) -> bool:
    """Whether a material was made by us and still has the water's node: without it, it is the artist's own."""
    return material is not None and MATERIAL_KEY in material and NODE_NAME in material.node_tree.nodes


def ensure_material(name: str, settings: MaterialSettings) -> bpy.types.Material:
    """The ocean material called `name`, showing `settings`; made if there is none, else changed in place.

    Only sockets whose setting changed since the last call are written, so that what an artist typed or linked
    elsewhere in the tree stays.
    """
    group = ensure_group(_RECIPES[settings.see_through, settings.skewed_slopes])
    material = find_material(name) or _new_material(name)
    tree = material.node_tree
    if NODE_NAME not in tree.nodes:
        _build_tree(tree)
    if tree.nodes[NODE_NAME].node_tree != group:
        _use_group(material, group)
    write_changed(material, tree.nodes[NODE_NAME].inputs, socket_values(settings))
    return material


def set_sun(material: bpy.types.Material, sun: Sun | None) -> None:
    """Tell the material which sun to reflect; None for no sun. Sockets that hold it already are not touched."""
    inputs = material.node_tree.nodes[NODE_NAME].inputs
    if sun is None:
        write_socket(inputs[SUN_IRRADIANCE.name], (0.0, 0.0, 0.0, 1.0))
        return
    write_socket(inputs[SUN_DIRECTION.name], sun.direction)
    write_socket(inputs[SUN_IRRADIANCE.name], (*sun.irradiance, 1.0))
    write_socket(inputs[SUN_ANGLE.name], sun.angular_diameter)
    write_socket(inputs[MISSING_SUN.name], 0.0 if sun.shines_in_eevee else 1.0)


def set_wind(material: bpy.types.Material, wind_speed: float, direction: float) -> None:
    """Tell a material with skewed slopes the wind, in m/s at 12.5 m, and where to, rad from the object's x."""
    inputs = material.node_tree.nodes[NODE_NAME].inputs
    if WIND_SPEED.name in inputs:
        write_socket(inputs[WIND_SPEED.name], wind_speed)
        write_socket(inputs[WIND_DIRECTION.name], direction)


def write_socket(socket, value):
    """Set a socket unless it has the value, since every write makes the renderers update the material."""
    if not np.array_equal(np.float32(_plain(socket)), np.float32(value)):
        socket.default_value = value


def shows_water(material: bpy.types.Material, target: str) -> bool:
    """Whether the material's output for an engine, "CYCLES" or "EEVEE", is fed by the ocean's node."""
    tree = material.node_tree
    output = None if tree is None else tree.get_output_node(target)
    waiting, seen = [] if output is None else [output], set()
    while waiting:
        node = waiting.pop()
        if node.name == NODE_NAME:
            return True
        if node.name not in seen:
            seen.add(node.name)
            waiting += [link.from_node for socket in node.inputs for link in socket.links]
    return False


def water_color(settings: MaterialSettings) -> tuple[float, float, float, float]:
    """Linear RGB reflectance (and alpha 1) of the water body that the settings choose."""
    reflectance = water_leaving_reflectance(WATER_TYPES[settings.water_type])
    return (*map(float, reflectance_to_rec709(WAVELENGTHS, reflectance)), 1.0)


def socket_values(settings: MaterialSettings) -> dict:
    """What each setting means as the value of a socket of the group node."""
    values = {
        WATER_COLOR.name: water_color(settings),
        TINT.name: (settings.tint_red, settings.tint_green, settings.tint_blue, 1.0),
        ROUGHNESS.name: settings.roughness,
        GLITTER_STRENGTH.name: settings.glitter_strength,
        FORMULA_SUN.name: float(settings.sun_model == "formula"),
    }
    if settings.see_through:
        contents = WATER_TYPES[settings.water_type]
        values[ABSORPTION.name] = tuple(map(float, rgb_absorption(contents)))
        values[BACKSCATTERING.name] = tuple(map(float, rgb_backscattering(contents)))
        values[EEVEE_DEPTH.name] = settings.eevee_depth
    return values


def _new_material(name):
    material = bpy.data.materials.new(name)
    material[MATERIAL_KEY] = name
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    # Cycles would bend the normals at grazing angles: up to 16 % more light at 3 degrees of elevation.
    material.cycles.use_bump_map_correction = False
    return material


def own_nodes(tree) -> list[bpy.types.Node]:
    """The nodes of a material that this extension put beside the water's, as far as the artist left them."""
    names = (SLOPE_VARIANCE.name, *(_output_name(socket) for socket in (CYCLES, EEVEE)))
    return [tree.nodes[name] for name in names if name in tree.nodes]


def _output_name(socket):
    return f"Output {socket.name}"


def _build_tree(tree):
    attribute = tree.nodes.new("ShaderNodeAttribute")
    attribute.name = attribute.label = SLOPE_VARIANCE.name
    attribute.attribute_type = "GEOMETRY"
    attribute.attribute_name = SLOPE_VARIANCE_ATTRIBUTE
    water = tree.nodes.new("ShaderNodeGroup")
    water.name = NODE_NAME
    water.node_tree = ensure_group(WATER)
    water.width = 260.0  # leaves room for the values
    tree.links.new(attribute.outputs["Vector"], water.inputs[SLOPE_VARIANCE.name])
    for socket in (CYCLES, EEVEE):
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        output.name = output.label = _output_name(socket)
        output.target = socket.name.upper()
        tree.links.new(water.outputs[socket.name], output.inputs["Surface"])
    for node in tree.nodes:
        node.select = False
    arrange(tree)


def _use_group(material, group):
    """Exchange the group of the material's node; links and values stay with sockets of the same name.

    The group that it had goes, unless something else uses it.
    """
    tree = material.node_tree
    node = tree.nodes[NODE_NAME]
    values = {socket.name: _plain(socket) for socket in node.inputs if hasattr(socket, "default_value")}
    sources = [(link.from_socket, link.to_socket.name) for link in tree.links if link.to_node == node]
    targets = [(link.from_socket.name, link.to_socket) for link in tree.links if link.from_node == node]
    before = node.node_tree
    node.node_tree = group
    remove_unused(before)
    node.width = fitting_width(node)
    for name, value in values.items():
        if name in node.inputs:
            node.inputs[name].default_value = value
    for source, name in sources:
        if name in node.inputs:
            tree.links.new(source, node.inputs[name])
    for name, target in targets:
        if name in node.outputs:
            tree.links.new(node.outputs[name], target)
    output = tree.nodes.get(_output_name(CYCLES))
    see_through = VOLUME.name in node.outputs
    if see_through and output is not None:
        tree.links.new(node.outputs[VOLUME.name], output.inputs["Volume"])
    if bpy.app.version < (5, 0, 0):
        material.cycles.homogeneous_volume = see_through  # Blender 5 sees it for itself
    material.use_raytrace_refraction = see_through


def _plain(socket):
    value = socket.default_value
    return value if np.isscalar(value) else tuple(value)


def write_changed(owner, inputs, values: dict) -> None:
    """Write the socket values that differ from those written last time, which `owner` remembers.

    What an artist typed into a socket stays until its setting changes.
    """
    applied = json.loads(owner.get(APPLIED_KEY, "{}"))
    values = json.loads(json.dumps(values))  # as they will read back
    for name, value in values.items():
        if applied.get(name) != value:
            inputs[name].default_value = value
    if applied != values:
        owner[APPLIED_KEY] = json.dumps(values)
