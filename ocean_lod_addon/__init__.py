# SPDX-License-Identifier: GPL-3.0-or-later
"""Ocean LOD: a physically calibrated sea for Blender.

Importing this package loads neither bpy nor NumPy; `register()` loads what Blender needs. Imports point
downward only: ui and cli -> scene -> nodes -> core (tests/test_architecture.py holds them to it).
"""


def register() -> None:
    """Make the operator, the panels, the frame-change handler and the command line known to Blender."""
    from . import scene, ui
    from .cli import blender_command

    scene.register()
    ui.register()
    blender_command.register()


def unregister() -> None:
    """Undo `register()`, in the reverse order."""
    from . import scene, ui
    from .cli import blender_command

    blender_command.unregister()
    ui.unregister()
    scene.unregister()
