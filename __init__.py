# SPDX-License-Identifier: GPL-3.0-or-later
"""Ocean LOD as a Blender extension: what Blender looks for beside the manifest.

Nothing is imported before Blender asks for it, so that tests and the command line can load the package
`ocean_lod_addon` from the same folder without loading it a second time through this file.
"""


def register() -> None:
    """Called by Blender when the extension is enabled."""
    from . import ocean_lod_addon

    ocean_lod_addon.register()


def unregister() -> None:
    """Called by Blender when the extension is disabled."""
    from . import ocean_lod_addon

    ocean_lod_addon.unregister()
