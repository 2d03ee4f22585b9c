# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of core to and from Blender meshes."""

import numpy as np

from ..core.lod import Grid, topology

SLOPE_VARIANCE = "ocean_slope_variance"
"""Point attribute, FLOAT_VECTOR: unresolved slope variance (xx, yy, xy) in the object's axes, for shading."""

_FINGERPRINT = "ocean_lod_fingerprint"


def build_topology(mesh, grid: Grid) -> None:
    """Replace the geometry of `mesh` by the plane of `grid`; positions are left for the caller to write."""
    faces = topology(grid.cells, grid.levels)
    mesh.clear_geometry()
    corner_count = faces.triangles.size + faces.quads.size
    mesh.vertices.add(faces.vertex_count)
    mesh.loops.add(corner_count)
    mesh.polygons.add(len(faces.triangles) + len(faces.quads))
    mesh.loops.foreach_set("vertex_index", np.concatenate([faces.triangles.ravel(), faces.quads.ravel()]))
    starts = np.concatenate(
        [
            np.arange(0, faces.triangles.size, 3, dtype=np.int32),
            np.arange(faces.triangles.size, corner_count, 4, dtype=np.int32),
        ]
    )
    mesh.polygons.foreach_set("loop_start", starts)
    mesh.update(calc_edges=True)
    mesh.attributes.new(SLOPE_VARIANCE, "FLOAT_VECTOR", "POINT")


def has_geometry_for(mesh, vertex_count: int) -> bool:
    """Whether the mesh was built for a surface of this many vertices, so that arrays can be written to it."""
    return len(mesh.vertices) == vertex_count and SLOPE_VARIANCE in mesh.attributes


def write_positions(mesh, positions: np.ndarray) -> None:
    """Set all vertex positions, (vertices, 3) float32, and make Blender notice."""
    mesh.attributes["position"].data.foreach_set("vector", positions.ravel())
    # A bulk write leaves cached normals and bounds stale in Blender 4.5; writing one vertex through the
    # ordinary way refreshes both and costs nothing.
    first = mesh.vertices[0]
    first.co = first.co


def write_slope_variance(mesh, variance: np.ndarray) -> None:
    """Set the slope variance attribute, (vertices, 3) float32."""
    mesh.attributes[SLOPE_VARIANCE].data.foreach_set("vector", variance.ravel())


def read_positions(mesh) -> np.ndarray:
    """All vertex positions, (vertices, 3) float32."""
    positions = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", positions.ravel())
    return positions


def static_fingerprint(mesh) -> str:
    """The fingerprint of the ocean whose static attributes the mesh holds, or an empty text.

    It is kept on the mesh, so that undo and file loading carry it along with the attributes it describes.
    """
    return mesh.get(_FINGERPRINT, "")


def set_static_fingerprint(mesh, fingerprint: str) -> None:
    """Record which ocean's static attributes the mesh holds."""
    mesh[_FINGERPRINT] = fingerprint
