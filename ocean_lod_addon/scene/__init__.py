# SPDX-License-Identifier: GPL-3.0-or-later
"""Oceans in Blender's data: properties, meshes, the frame-change handler."""

from . import handlers, ocean_object, properties


def register():
    """Register the properties that make an object an ocean, then the handlers that move it."""
    properties.register(ocean_object.refresh, ocean_object.refresh_material)
    handlers.register()


def unregister():
    """Undo `register`, in reverse."""
    handlers.unregister()
    properties.unregister()
