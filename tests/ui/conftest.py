# SPDX-License-Identifier: GPL-3.0-or-later
"""An ocean, small enough to be quick, that tests of operators and settings work on."""

import bpy
import pytest

import ocean_lod_addon


@pytest.fixture
def ocean():
    """An ocean added through the operator, in an otherwise empty scene; the extension is enabled meanwhile."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if not hasattr(bpy.types.Object, "ocean_lod"):
        ocean_lod_addon.register()
    assert bpy.ops.mesh.ocean_lod_add(preset="moderate", cells=32, levels=4, cell_size=0.25) == {"FINISHED"}
    yield bpy.context.object
    ocean_lod_addon.unregister()
