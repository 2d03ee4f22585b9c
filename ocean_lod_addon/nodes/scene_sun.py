# SPDX-License-Identifier: GPL-3.0-or-later
"""The sun that a scene has, and the agreement with it about who reflects it.

**What counts as the sun**: the strongest Sun light that renders, or the disc of a Sky Texture that is linked
straight into the world's Background (every kind that has a disc, in either Blender). An HDR image of a sky has no
sun here; set the material's sockets by hand then.

**Counting it once.** EEVEE does not draw a Sky Texture's disc, so the formula is all there is of it. A Sun light
it does reflect in the ocean's Glossy closure as well, in a round blob; a shader cannot see which light it is lit
by, so `claim_sun` takes the highlights from the light itself: Specular 0, which Cycles ignores. Other shiny
objects then lose its highlight in EEVEE, too; when the last ocean has gone, `release_sun` gives it back. Where the
formula replaces the closure in Cycles the light becomes invisible to glossy rays.

**A sky brighter than 10.** A physical sky is, and EEVEE by default cuts reflected light off there, and takes what
is brighter out of the world to make a sun of its own, which the sea would reflect in one more blob. So `claim_sun`
turns both off where the world is a Sky Texture: `clamp_surface_indirect` of the scene and `sun_threshold` of the
world.
"""

import math

import bpy
import numpy as np
from mathutils import Vector

from ..core.material_settings import MaterialSettings
from ..core.optics.sky_sun import multiple_scattering_sun, single_scattering_sun
from ..core.sun import Sun

CLAIMED_KEY = "ocean_lod_claimed_sun"
"""Custom property of a scene whose sun is claimed; lights and worlds may be in other scenes, too."""

SPECULAR_KEY = "ocean_lod_specular_factor"
"""Custom property of a claimed light: its Specular before."""

GLOSSY_KEY = "ocean_lod_visible_glossy"
"""Custom property of a claimed light's object: whether glossy rays saw it before."""

CLAMP_KEY = "ocean_lod_clamp_surface_indirect"
"""Custom property of a scene under a claimed sky: its limit of indirect light in EEVEE before."""

THRESHOLD_KEY = "ocean_lod_sun_threshold"
"""Custom property of a claimed world: its sun threshold before."""


def scene_sun(scene: bpy.types.Scene) -> Sun | None:
    """The strongest sun of the scene, as its settings are now, or None."""
    suns = [light_sun(lamp) for lamp in sun_lights(scene)]
    sky = sky_sun(scene.world)
    if sky is not None:
        suns.append(sky)
    return max(suns, key=lambda sun: sun.strength, default=None)


def sun_lights(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """The Sun lights of the scene that render."""
    return [
        lamp for lamp in scene.objects if lamp.type == "LIGHT" and lamp.data.type == "SUN" and not lamp.hide_render
    ]


def light_sun(lamp: bpy.types.Object) -> Sun:
    """A Sun light as the renderers see it: its strength is its irradiance."""
    light = lamp.data
    color = np.array(light.color) * light.energy * 2.0**light.exposure
    if light.use_temperature:
        color = color * np.array(light.temperature_color)[:3]
    if _has_nodes(light):
        color = color * _emission(light.node_tree)
    direction = lamp.matrix_world.to_quaternion() @ Vector((0.0, 0.0, 1.0))
    return Sun(tuple(direction), tuple(map(float, color)), light.angle, shines_in_eevee=True)


def sky_sun(world: bpy.types.World | None) -> Sun | None:
    """The disc of the world's Sky Texture, or None where there is none, or none that can be known."""
    background, sky = _background_and_sky(world)
    if sky is None or background.inputs["Strength"].is_linked:
        return None
    irradiance = _disc_irradiance(sky)
    if irradiance is None:
        return None
    elevation, rotation = sky.sun_elevation, sky.sun_rotation
    direction = (
        math.cos(elevation) * math.sin(rotation),
        math.cos(elevation) * math.cos(rotation),
        math.sin(elevation),
    )
    irradiance = irradiance * sky.sun_intensity * background.inputs["Strength"].default_value
    return Sun(direction, tuple(map(float, irradiance)), sky.sun_size, shines_in_eevee=False)


def _background_and_sky(world):
    """The world's Background and the Sky Texture that is linked straight into it; None for what there is not."""
    background = _source(_world_output(world), "Surface")
    if background is None or background.bl_idname != "ShaderNodeBackground":
        return None, None
    sky = _source(background, "Color")
    return background, sky if sky is not None and sky.bl_idname == "ShaderNodeTexSky" else None


def _disc_irradiance(sky):
    """RGB irradiance of the disc at intensity 1, by the texture's own model, or None if it has no disc."""
    if not sky.sun_disc:
        return None
    match sky.sky_type:
        case "NISHITA":
            return single_scattering_sun(sky.sun_elevation, sky.altitude, sky.air_density, sky.dust_density)
        case "SINGLE_SCATTERING":
            return single_scattering_sun(sky.sun_elevation, sky.altitude, sky.air_density, sky.aerosol_density)
        case "MULTIPLE_SCATTERING":
            return multiple_scattering_sun(
                sky.sun_elevation, sky.altitude, sky.air_density, sky.aerosol_density, sky.ozone_density
            )
    return None


def _world_output(world):
    return world.node_tree.get_output_node("ALL") if world is not None and _has_nodes(world) else None


def _has_nodes(owner):
    """Whether nodes make a light's or a world's color; from 5.2 on always, and asking would be a warning."""
    return owner.node_tree is not None and (bpy.app.version >= (5, 2, 0) or owner.use_nodes)


def _source(node, name):
    """The node that is linked into an input, or None."""
    socket = node.inputs.get(name) if node is not None else None
    return socket.links[0].from_node if socket is not None and socket.is_linked else None


def _emission(tree):
    """What a light's nodes multiply its strength by, where that is a plain Emission node; else 1."""
    emission = _source(tree.get_output_node("ALL"), "Surface")
    if emission is None or emission.bl_idname != "ShaderNodeEmission":
        return 1.0
    if emission.inputs["Color"].is_linked or emission.inputs["Strength"].is_linked:
        return 1.0
    return np.array(emission.inputs["Color"].default_value)[:3] * emission.inputs["Strength"].default_value


def claim_sun(scene: bpy.types.Scene, settings: MaterialSettings) -> None:
    """Leave the scene's sun to the ocean's formula where it is used, and let EEVEE reflect all of the sky."""
    scene[CLAIMED_KEY] = True
    for lamp in sun_lights(scene):
        _claim(lamp.data, SPECULAR_KEY, lamp.data, "specular_factor", 0.0)
        if settings.sun_model == "formula":
            _claim(lamp, GLOSSY_KEY, lamp, "visible_glossy", False)
        else:
            _release(lamp, GLOSSY_KEY, lamp, "visible_glossy")
    if _has_sky(scene.world):
        _claim(scene, CLAMP_KEY, scene.eevee, "clamp_surface_indirect", 0.0)
        _claim(scene.world, THRESHOLD_KEY, scene.world, "sun_threshold", 0.0)


def is_claimed(scene: bpy.types.Scene) -> bool:
    """Whether there is nothing that `claim_sun` has not seen: no Sun light or sky that came later."""
    lights = all(SPECULAR_KEY in lamp.data for lamp in sun_lights(scene))
    return CLAIMED_KEY in scene and lights and (not _has_sky(scene.world) or THRESHOLD_KEY in scene.world)


def _has_sky(world):
    return _background_and_sky(world)[1] is not None


def release_sun(scene: bpy.types.Scene) -> None:
    """Undo `claim_sun`, where that has been done."""
    if CLAIMED_KEY not in scene:
        return
    del scene[CLAIMED_KEY]
    for lamp in scene.objects:
        if lamp.type == "LIGHT":
            _release(lamp.data, SPECULAR_KEY, lamp.data, "specular_factor")
            _release(lamp, GLOSSY_KEY, lamp, "visible_glossy")
    _release(scene, CLAMP_KEY, scene.eevee, "clamp_surface_indirect")
    if scene.world is not None:
        _release(scene.world, THRESHOLD_KEY, scene.world, "sun_threshold")


def _claim(memory, key, owner, name, value):
    """Set a property, after `memory` has learnt what it was."""
    if key not in memory:
        memory[key] = getattr(owner, name)
    setattr(owner, name, value)


def _release(memory, key, owner, name):
    if key in memory:
        setattr(owner, name, type(getattr(owner, name))(memory[key]))
        del memory[key]
