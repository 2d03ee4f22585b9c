# SPDX-License-Identifier: GPL-3.0-or-later
"""The foam of an ocean object: attributes and nodes, kept in step with its settings and with time."""

import numpy as np

from ..core.column_blocks import ColumnBlock
from ..core.foam.whitecaps import sea_coverage
from ..core.kernel import ReusedArray
from ..core.ocean import Ocean, Surface
from ..core.plan import FOAM_ATTRIBUTE, WHITECAPS_ATTRIBUTE
from ..nodes.foam_material import hide_foam, show_foam
from . import mesh as mesh_arrays


def write_static(mesh, surface: Surface) -> None:
    """Write what depends on settings alone."""
    if WHITECAPS_ATTRIBUTE in mesh.attributes and surface.whitecaps is not None:
        mesh_arrays.write_floats(mesh, WHITECAPS_ATTRIBUTE, surface.whitecaps.shown)


def write(mesh, surface: Surface, columns: dict[ColumnBlock, ReusedArray]) -> None:
    """Write the foam that follows from the columns of `whitecaps.block`; for every frame.

    Within a shot foam can stop to show; where its attribute stays, it is empty then.
    """
    foam = np.zeros(surface.vertex_count, np.float32)
    if surface.whitecaps is not None:
        surface.whitecaps.foam(columns[surface.whitecaps.block].array, foam)
    mesh_arrays.write_floats(mesh, FOAM_ATTRIBUTE, foam)


def apply(material, ocean: Ocean) -> None:
    """Give the material nodes for the foam, or take them away; not for handlers."""
    if ocean.foam is None:
        hide_foam(material)
    else:
        show_foam(material, ocean.foam, sea_coverage(ocean.foam, ocean.sea))
