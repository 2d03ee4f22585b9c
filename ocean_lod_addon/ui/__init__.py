# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist sees and clicks: the Add menu entry, operators and panels."""

import bpy

from . import (
    effects,
    foam,
    framing,
    menus,
    operators,
    panels,
    preset_operators,
    quality,
    readback_cache,
    ripples,
)

_CLASSES = (
    *operators.CLASSES,
    *preset_operators.CLASSES,
    *menus.CLASSES,
    *panels.CLASSES,
    *framing.CLASSES,
    *ripples.CLASSES,
    *quality.CLASSES,
    *foam.CLASSES,
    *effects.CLASSES,
)


def register():
    """Register operators and panels, then the menu entry."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    menus.register()


def unregister():
    """Undo `register`, in reverse."""
    readback_cache.unregister()
    menus.unregister()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
