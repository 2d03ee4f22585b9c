# SPDX-License-Identifier: GPL-3.0-or-later
"""An ocean's material: made from its settings, told about the scene's sun and wind in every frame."""

import itertools

from ..core.material_settings import MaterialSettings
from ..core.roughness import roughening_system
from ..core.sea import Sea
from ..core.wind import COX_MUNK_HEIGHT, wind_at_height
from ..nodes.foam_material import follow_sun
from ..nodes.material import MATERIAL_KEY, ensure_material, find_material, is_our_water, set_sun, set_wind
from ..nodes.scene_sun import claim_sun, is_claimed, release_sun, scene_sun
from . import properties


def apply(ob, scene, settings: MaterialSettings) -> None:
    """Bring an ocean's material in step with settings, make it if need be, and let it have the scene's sun."""
    material = ensure_material(_material_name(ob), settings)
    if not ob.data.materials:
        ob.data.materials.append(material)
    if own_materials(ob):
        claim_sun(scene, settings)
    set_surroundings(ob, scene, properties.read_sea(ob.ocean_lod))


def settle_sun(scene, oceans) -> None:
    """Let the `oceans` of a scene reflect its sun as it is now, and give it back once none of them does.

    A sun that came after them is claimed. What the artist changed at a claimed one stays.
    """
    reflecting = [ob for ob in oceans if own_materials(ob)]
    if not reflecting:
        release_sun(scene)
        return
    if not is_claimed(scene):
        for ob in reflecting:
            claim_sun(scene, properties.read_material(ob.ocean_lod))
    _set_sun([material for ob in reflecting for material in own_materials(ob)], scene)


def own_materials(ob) -> list:
    """The materials of an ocean that were made by this extension, and still have its water."""
    return [material for material in ob.data.materials if is_our_water(material)]


def own_material(ob):
    """The material that was made for an ocean, the first if it has several, or None."""
    return next(iter(own_materials(ob)), None)


def set_surroundings(ob, scene, sea: Sea) -> None:
    """Tell an ocean's materials the sun of a scene (original or evaluated) and the wind of a sea.

    Only values of sockets are written, and only those that differ.
    """
    materials = own_materials(ob)
    _set_sun(materials, scene)
    rough = roughening_system(sea)
    if rough is not None:
        system = sea.systems[rough]
        for material in materials:
            set_wind(material, wind_at_height(system.wind_speed, COX_MUNK_HEIGHT), system.direction)


def _set_sun(materials, scene):
    if materials:
        sun = scene_sun(scene)
        for material in materials:
            set_sun(material, sun)
            follow_sun(material)


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
