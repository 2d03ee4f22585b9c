# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions at a shading point as the optics formulas want them: components along the rougher axis, the
smoother axis and the normal."""

from .graph import Graph, Vector


class SurfaceFrame:
    """The orthonormal axes at a shading point: rougher axis, smoother axis, normal (of the resolved surface)."""

    def __init__(self, graph: Graph, tangent: Vector, normal: Vector):
        self._graph = graph
        along_normal = graph.label(normal * normal.dot(tangent), "tangent along normal")
        x = graph.label((tangent - along_normal).normalized(), "rougher axis")
        y = graph.label(normal.cross(x), "smoother axis")
        self._axes = (x, y, normal)

    def components(self, direction: Vector):
        """(x, y, z) of a world direction."""
        return tuple(axis.dot(direction) for axis in self._axes)

    def view(self):
        """(x, y, z) of the direction to the viewer."""
        geometry = self._graph.node("ShaderNodeNewGeometry")
        return self.components(self._graph.output_of(geometry, "Incoming"))


def to_world(graph: Graph, vector: Vector, name: str) -> Vector:
    """A unit vector in the object's axes, in world space."""
    node = graph.node(
        "ShaderNodeVectorTransform",
        name,
        {0: vector},
        vector_type="VECTOR",
        convert_from="OBJECT",
        convert_to="WORLD",
    )
    return graph.output_of(node).normalized()
