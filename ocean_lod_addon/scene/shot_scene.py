# SPDX-License-Identifier: GPL-3.0-or-later
"""A first shot around an ocean: camera, physical sky with its sun, colour management.

The exposure is in the strength of the sky, not in the view. With any exposure of the view but 0 EEVEE's pixel
filter counts bright samples less than dark ones: a glitter path gets darker and is speckled with dark pixels.
"""

import math

import bpy
from mathutils import Matrix, Vector

from ..core.shot import Shot

_SUN_ANGULAR_DIAMETER = math.radians(0.545)
_DAYLIGHT_EXPOSURE = -3.9
"""Stops from the sky model's radiance (W/m^2/sr/channel) to a picture of a sunny day."""

_CLIP_START, _CLIP_END = 0.05, 200e3  # m
_SKY_TYPES = ("MULTIPLE_SCATTERING", "NISHITA")
"""The physical sky model with a sun disc, as Blender 5 and Blender 4.5 call it."""


def add_camera(scene, shot: Shot):
    """A camera at the shot's height above the origin, looking along +x, made the scene's camera."""
    data = bpy.data.cameras.new("Shot")
    data.sensor_width = 36.0
    data.lens = shot.focal_length
    data.clip_start, data.clip_end = _CLIP_START, _CLIP_END
    camera = bpy.data.objects.new("Shot", data)
    view = Vector((math.cos(shot.camera_pitch), 0.0, -math.sin(shot.camera_pitch)))
    rotation = view.to_track_quat("-Z", "Y").to_matrix().to_4x4()
    camera.matrix_world = Matrix.Translation((0.0, 0.0, shot.camera_height)) @ rotation
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def add_sky(scene, shot: Shot):
    """A world with Blender's physical sky, the sun's disc in it, exposed for the picture."""
    world = bpy.data.worlds.new("Sky")
    if world.node_tree is None:
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    sky = tree.nodes.new("ShaderNodeTexSky")
    offered = [item.identifier for item in sky.bl_rna.properties["sky_type"].enum_items]
    sky.sky_type = next(kind for kind in _SKY_TYPES if kind in offered)
    sky.sun_disc = True
    sky.sun_size = _SUN_ANGULAR_DIAMETER
    sky.sun_elevation = shot.sun_elevation
    sky.sun_rotation = math.pi / 2 - shot.sun_azimuth  # the node counts clockwise from +y
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Strength"].default_value = 2.0 ** (_DAYLIGHT_EXPOSURE + shot.exposure)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(sky.outputs["Color"], background.inputs["Color"])
    tree.links.new(background.outputs["Background"], output.inputs["Surface"])
    sky.location, background.location = (-480, 0), (-200, 0)
    scene.world = world
    return world


def set_tone_mapping(scene) -> None:
    """Film-like tone mapping."""
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.look = "AgX - Medium High Contrast"
    scene.view_settings.exposure = 0.0


def build(scene, shot: Shot) -> None:
    """Camera, sky and tone mapping of a shot."""
    add_camera(scene, shot)
    add_sky(scene, shot)
    set_tone_mapping(scene)
