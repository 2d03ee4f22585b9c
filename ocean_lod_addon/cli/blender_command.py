# SPDX-License-Identifier: GPL-3.0-or-later
"""`blender --command ocean_lod SUB`: the command line inside a Blender program."""

from . import main

NAME = "ocean_lod"

_handles = []


def register():
    """Make the command known to Blender."""
    import bpy

    _handles.append(bpy.utils.register_cli_command(NAME, main))


def unregister():
    """Withdraw the command."""
    import bpy

    bpy.utils.unregister_cli_command(_handles.pop())
