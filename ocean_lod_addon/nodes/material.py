# SPDX-License-Identifier: GPL-3.0-or-later
"""The ocean material: one group node between the mesh's slope variance and an output for each engine."""

import json

import bpy
import numpy as np

from ..core.material_settings import MaterialSettings
from ..core.optics.color import reflectance_to_rec709
from ..core.optics.water_types import WATER_TYPES, WAVELENGTHS, water_leaving_reflectance
from ..core.sun import Sun
from .groups import ensure_group
from .layout import arrange
from .sockets import (
    GLITTER_STRENGTH,
    ROUGHNESS,
    SLOPE_VARIANCE,
    SUN_ANGLE,
    SUN_DIRECTION,
    SUN_IRRADIANCE,
    WATER_COLOR,
)
from .water_group import CYCLES, EEVEE, FORMULA_SUN, MISSING_SUN, TINT, WATER

SLOPE_VARIANCE_ATTRIBUTE = "ocean_slope_variance"
"""Point attribute (FLOAT_VECTOR) of the mesh: unresolved slope variance (xx, yy, xy) in the object's axes."""

MATERIAL_KEY = "ocean_lod_material"
"""Custom property of a material that this extension made: the name it was made under."""

APPLIED_KEY = "ocean_lod_applied"
"""Custom property of such a material: the socket values that were last set from settings, as JSON."""


def find_material(name: str):
    """The material that was made under `name`, whatever it is called by now, or None."""
    made_by_us = [
        material
        for material in bpy.data.materials
        if material.library is None and material.get(MATERIAL_KEY) == name
    ]
    return min(made_by_us, key=lambda material: (material.name != name, material.name), default=None)


def ensure_material(name: str, settings: MaterialSettings) -> bpy.types.Material:
    """The ocean material called `name`, showing `settings`; made if there is none, else changed in place.

    Only sockets whose setting changed since the last call are written, so that what an artist typed or linked
    elsewhere in the tree stays.
    """
    group = ensure_group(WATER)
    material = find_material(name) or _new_material(name)
    if WATER.name not in material.node_tree.nodes:
        _build_tree(material.node_tree, group)
    material.node_tree.nodes[WATER.name].node_tree = group
    _apply(material, socket_values(settings))
    return material


def set_sun(material: bpy.types.Material, sun: Sun | None) -> None:
    """Tell the material which sun to reflect; None for no sun. Sockets that hold it already are not touched."""
    inputs = material.node_tree.nodes[WATER.name].inputs
    if sun is None:
        _write(inputs[SUN_IRRADIANCE.name], (0.0, 0.0, 0.0, 1.0))
        return
    _write(inputs[SUN_DIRECTION.name], sun.direction)
    _write(inputs[SUN_IRRADIANCE.name], (*sun.irradiance, 1.0))
    _write(inputs[SUN_ANGLE.name], sun.angular_diameter)
    _write(inputs[MISSING_SUN.name], 0.0 if sun.shines_in_eevee else 1.0)


def _write(socket, value):
    """Set a socket unless it has the value, since every write makes the renderers update the material."""
    old = socket.default_value
    if not np.array_equal(np.float32(old if np.isscalar(value) else tuple(old)), np.float32(value)):
        socket.default_value = value


def water_color(settings: MaterialSettings) -> tuple[float, float, float, float]:
    """Linear RGB reflectance (and alpha 1) of the water body that the settings choose."""
    reflectance = water_leaving_reflectance(WATER_TYPES[settings.water_type])
    return (*map(float, reflectance_to_rec709(WAVELENGTHS, reflectance)), 1.0)


def socket_values(settings: MaterialSettings) -> dict:
    """What each setting means as the value of a socket of the group node."""
    return {
        WATER_COLOR.name: water_color(settings),
        TINT.name: (settings.tint_red, settings.tint_green, settings.tint_blue, 1.0),
        ROUGHNESS.name: settings.roughness,
        GLITTER_STRENGTH.name: settings.glitter_strength,
        FORMULA_SUN.name: float(settings.sun_model == "formula"),
    }


def _new_material(name):
    material = bpy.data.materials.new(name)
    material[MATERIAL_KEY] = name
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    # Cycles would bend the normals at grazing angles: up to 16 % more light at 3 degrees of elevation.
    material.cycles.use_bump_map_correction = False
    return material


def _build_tree(tree, group):
    nodes, links = tree.nodes, tree.links
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.name = attribute.label = SLOPE_VARIANCE.name
    attribute.attribute_type = "GEOMETRY"
    attribute.attribute_name = SLOPE_VARIANCE_ATTRIBUTE
    water = nodes.new("ShaderNodeGroup")
    water.name = water.label = WATER.name
    water.node_tree = group
    water.width = 240.0
    links.new(attribute.outputs["Vector"], water.inputs[SLOPE_VARIANCE.name])
    for socket in (CYCLES, EEVEE):
        output = nodes.new("ShaderNodeOutputMaterial")
        output.name = output.label = f"Output {socket.name}"
        output.target = socket.name.upper()
        links.new(water.outputs[socket.name], output.inputs["Surface"])
    arrange(tree)


def _apply(material, values):
    """Write the socket values that differ from those written last time."""
    applied = json.loads(material.get(APPLIED_KEY, "{}"))
    values = json.loads(json.dumps(values))  # as they will read back
    inputs = material.node_tree.nodes[WATER.name].inputs
    for name, value in values.items():
        if applied.get(name) != value:
            inputs[name].default_value = value
    if applied != values:
        material[APPLIED_KEY] = json.dumps(values)
