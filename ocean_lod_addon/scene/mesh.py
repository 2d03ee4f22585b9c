# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of core to and from Blender meshes."""

import numpy as np

from ..core.lod import Grid, topology
from ..core.plan import GUST_ATTRIBUTE as GUST
from ..core.plan import REST_POSITION_ATTRIBUTE as REST_POSITION
from ..core.plan import RIPPLE_AMPLITUDE_ATTRIBUTE as RIPPLE_AMPLITUDE
from ..core.plan import ripple_attributes

SLOPE_VARIANCE = "ocean_slope_variance"
"""Point attribute, FLOAT_VECTOR: unresolved slope variance (xx, yy, xy) in the object's axes, for shading."""

_REST_ANCHORS = "ocean_lod_rest_anchors"
_FINGERPRINT = "ocean_lod_fingerprint"


def build_topology(mesh, grid: Grid) -> None:
    """Replace the geometry of `mesh` by the plane of `grid`; positions are left for the caller to write."""
    faces = topology(grid.cells, grid.levels)
    mesh.clear_geometry()
    corner_count = faces.triangles.size + faces.quads.size
    mesh.vertices.add(faces.vertex_count)
    mesh.loops.add(corner_count)
    mesh.polygons.add(len(faces.triangles) + len(faces.quads))
    # Through the attribute in one copy; `vertex_index` of loops would be set corner by corner, some hundred times
    # as long.
    corners = np.concatenate([faces.triangles.ravel(), faces.quads.ravel()])
    mesh.attributes[".corner_vert"].data.foreach_set("value", corners)
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


def ensure_attributes(mesh, wanted, possible: dict[str, str]) -> None:
    """Of the attributes in `possible`, with their types, let the mesh have those `wanted`; not for handlers."""
    for name in possible:
        if name in mesh.attributes and name not in wanted:
            mesh.attributes.remove(mesh.attributes[name])
    for name in wanted:
        if name not in mesh.attributes:
            mesh.attributes.new(name, possible[name], "POINT")
            mesh.pop(_FINGERPRINT, None)  # it may be a static one, still to be written


def write_vectors(mesh, name: str, vectors: np.ndarray) -> None:
    """Set a FLOAT_VECTOR attribute, (vertices, 3) float32."""
    mesh.attributes[name].data.foreach_set("vector", vectors.ravel())


def write_floats(mesh, name: str, values: np.ndarray) -> None:
    """Set a FLOAT attribute, (vertices,) float32."""
    mesh.attributes[name].data.foreach_set("value", values)


def ensure_ripple_attributes(mesh, bands: int) -> None:
    """Attributes for ripples of which this many bands are shown by the mesh in part; not for handlers."""
    wanted = ripple_attributes(bands)
    remove_ripple_attributes(mesh, keep=wanted)
    for name in wanted:
        if name not in mesh.attributes:
            mesh.attributes.new(name, "FLOAT_COLOR", "POINT")
            mesh.pop(_FINGERPRINT, None)


def remove_ripple_attributes(mesh, keep=()) -> None:
    """Remove what ripples need, but for the attributes called `keep`."""
    for name in [attribute.name for attribute in mesh.attributes]:
        if name not in keep and name.startswith(RIPPLE_AMPLITUDE):
            mesh.attributes.remove(mesh.attributes[name])


def ensure_gust_attribute(mesh, wanted: bool) -> None:
    """Give the mesh the attribute of gusts or take it away, with what they left of the slope variance."""
    if wanted and GUST not in mesh.attributes:
        mesh.attributes.new(GUST, "FLOAT", "POINT")
    elif not wanted and GUST in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[GUST])
        mesh.pop(_FINGERPRINT, None)


def write_gusts(mesh, variance: np.ndarray, factor: np.ndarray) -> None:
    """Set the slope variance (vertices, 3) and the factor of ripples' slopes (vertices,) of one moment."""
    write_slope_variance(mesh, variance)
    mesh.attributes[GUST].data.foreach_set("value", factor)


def has_ripple_attributes(mesh, bands: int) -> bool:
    """Whether the mesh has the attributes for ripples of which it shows this many bands in part.

    A frame in which ripples come into sight has not.
    """
    return REST_POSITION in mesh.attributes and all(
        name in mesh.attributes for name in ripple_attributes(bands)
    )


def write_ripple_amplitudes(mesh, amplitudes: np.ndarray) -> None:
    """Set the amplitudes, (vertices, bands) float32, of the bands that the mesh shows in part."""
    for number, name in enumerate(ripple_attributes(amplitudes.shape[1])):
        four = np.zeros((len(amplitudes), 4), np.float32)
        part = amplitudes[:, 4 * number : 4 * number + 4]
        four[:, : part.shape[1]] = part
        mesh.attributes[name].data.foreach_set("color", four.ravel())


def ensure_rest_positions(mesh, wanted: bool) -> None:
    """Let the mesh have the attribute of undisturbed positions or not; not for handlers."""
    if wanted == (REST_POSITION in mesh.attributes):
        return
    mesh.pop(_REST_ANCHORS, None)
    if wanted:
        mesh.attributes.new(REST_POSITION, "FLOAT2", "POINT")
    else:
        mesh.attributes.remove(mesh.attributes[REST_POSITION])


def has_rest_positions(mesh) -> bool:
    """Whether the mesh has the attribute of undisturbed positions."""
    return REST_POSITION in mesh.attributes


def rest_positions_are_for(mesh, anchors: np.ndarray) -> bool:
    """Whether the mesh holds the undisturbed positions for these level anchors."""
    return mesh.get(_REST_ANCHORS) == anchors.tobytes().hex()


def write_rest_positions(mesh, anchors: np.ndarray, positions: np.ndarray) -> None:
    """Set the undisturbed positions, (vertices, 2), for these level anchors."""
    mesh.attributes[REST_POSITION].data.foreach_set("vector", positions.astype(np.float32).ravel())
    mesh[_REST_ANCHORS] = anchors.tobytes().hex()


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
