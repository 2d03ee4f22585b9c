# SPDX-License-Identifier: GPL-3.0-or-later
"""An ocean's material: made from its settings, told about the scene's sun and wind in every frame."""

import itertools

from ..core.material_settings import MaterialSettings
from ..core.roughness import roughening_system
from ..core.sea import Sea
from ..core.wind import COX_MUNK_HEIGHT, wind_at_height
from ..nodes.foam_material import follow_sun
from ..nodes.material import MATERIAL_KEY, ensure_material, find_material, set_sun, set_wind
from ..nodes.scene_sun import claim_sun, scene_sun
from . import properties


def apply(ob, scene, settings: MaterialSettings) -> None:
    """Bring an ocean's material in step with settings, make it if need be, and let it have the scene's sun."""
    material = ensure_material(_material_name(ob), settings)
    if not ob.data.materials:
        ob.data.materials.append(material)
    claim_sun(scene, settings)
    set_surroundings(ob, scene, properties.read_sea(ob.ocean_lod))


def own_material(ob):
    """The material that was made for an ocean, the first if it has several, or None."""
    ours = (material for material in ob.data.materials if material is not None and MATERIAL_KEY in material)
    return next(ours, None)


def set_surroundings(ob, scene, sea: Sea) -> None:
    """Tell an ocean's materials the sun of a scene (original or evaluated) and the wind of a sea.

    Only values of sockets are written, and only those that differ.
    """
    materials = [material for material in ob.data.materials if material is not None and MATERIAL_KEY in material]
    if not materials:
        return
    sun = scene_sun(scene)
    rough = roughening_system(sea)
    for material in materials:
        set_sun(material, sun)
        follow_sun(material)
        if rough is not None:
            system = sea.systems[rough]
            set_wind(material, wind_at_height(system.wind_speed, COX_MUNK_HEIGHT), system.direction)


def _material_name(ob):
    """The name that the ocean's material was made under; for an ocean without one, a name not in use."""
    material = own_material(ob)
    if material is not None:
        return material[MATERIAL_KEY]
    numbered = (f"{ob.name} {number}" for number in itertools.count(2))
    names = itertools.chain([ob.name], numbered)
    return next(name for name in names if _is_free(find_material(name)))


def _is_free(material):
    return material is None or material.users == 0
