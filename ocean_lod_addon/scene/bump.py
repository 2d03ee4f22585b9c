# SPDX-License-Identifier: GPL-3.0-or-later
"""The ripples of an ocean object: attributes, images and nodes, kept in step with its settings and with time."""

import math

from ..core.camera_view import CameraView
from ..core.ocean import Ocean, Surface
from ..core.ripples.bump import bump_layout
from ..nodes.material import MATERIAL_KEY
from ..nodes.ripple_parts import PIXEL_PROPERTY
from ..nodes.ripples_material import RIPPLES_NODE_NAME, hide_ripples, set_ripple_values, show_ripples
from . import mesh as mesh_arrays
from .ripple_images import ensure_images, find_images, fit, remove_images, write_images

_DEFAULT_PIXEL_ANGLE = 36.0 / 35.0 / 1920.0
"""rad; of a 35 mm lens in a picture 1920 pixels wide, for a scene without a camera."""


def ensure_attributes(mesh, ocean: Ocean) -> None:
    """Give the mesh the attributes that the ripples of this ocean need, and no others; not for handlers."""
    if ocean.ripples.kind == "off":
        mesh_arrays.remove_ripple_attributes(mesh)
    else:
        layout = bump_layout(ocean.ripples, ocean.grid.shortest_wavelength)
        mesh_arrays.ensure_ripple_attributes(mesh, layout.handed_over)


def write_static(mesh, surface: Surface) -> None:
    """Write what depends on settings alone, where there are ripples."""
    bump = surface.bump
    if bump is not None and mesh_arrays.has_ripple_attributes(mesh, bump.layout.handed_over):
        mesh_arrays.write_ripple_amplitudes(mesh, bump.amplitudes())


def is_shown(material) -> bool:
    """Whether a material has the nodes of ripples."""
    return RIPPLES_NODE_NAME in material.node_tree.nodes


def apply(ob, material, surface: Surface, time: float) -> None:
    """Give the material images and nodes for the ripples, or take them away; not for handlers."""
    owner = material[MATERIAL_KEY]
    if surface.bump is None:
        hide_ripples(material)
        remove_images(owner)
        return
    show_ripples(material, surface.bump.layout, ensure_images(owner, surface.bump.layout))
    update(ob, surface, time)


def update(ob, surface: Surface, time: float) -> None:
    """Show the ripples at `time` in s; for every frame."""
    bump = surface.bump
    if bump is None:
        return
    for material in ob.data.materials:
        if material is not None and MATERIAL_KEY in material and is_shown(material):
            images = find_images(material[MATERIAL_KEY], len(bump.layout.tiles))
            if fit(images, bump.layout):
                write_images(images, bump, time)
                set_ripple_values(material, bump.tensors, bump.wave_height)


def forget_pixel(ob) -> None:
    """Take away what `update_pixel` wrote."""
    ob.pop(PIXEL_PROPERTY, None)


def update_pixel(ob, scene, view: CameraView | None) -> None:
    """Tell the material how large a pixel of a camera is on the water; for every frame."""
    pixel = (*pixel_width(view, scene), 0.0)
    if tuple(ob.get(PIXEL_PROPERTY, ())) != pixel:
        ob[PIXEL_PROPERTY] = pixel
        ob.update_tag()


def pixel_width(view: CameraView | None, scene) -> tuple[float, float]:
    """Width of a pixel on the water, m: the first number times the distance in scene units, plus the second."""
    metres = scene.unit_settings.scale_length
    if view is None:
        return _DEFAULT_PIXEL_ANGLE * metres, 0.0
    pixels = max(1, scene.render.resolution_x * scene.render.resolution_percentage // 100)
    left, right, _, _ = view.extent
    if view.kind == "ORTHO":
        return 0.0, (right - left) / pixels
    if view.kind == "PANO":
        return 2.0 * math.pi / pixels * metres, 0.0
    return (right - left) / pixels * metres, 0.0
