# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups that the ripples of every ocean are put together from: how a point is seen, one look at an image,
one band of waves, and the surface with all of them."""

from ..core.ripples import shading
from .graph import Graph, GraphOps
from .groups import GroupRecipe, Socket
from .sockets import NORMAL, SLOPE_VARIANCE

PIXEL_PROPERTY = "ocean_lod_pixel"
"""Property of the object: width of a pixel of the camera, (angle in rad, size in m, 0)."""


def _vector(name: str, description: str) -> Socket:
    return Socket(name, "VECTOR", description, hide_value=True)


def _number(name: str, description: str, default=0.0, maximum=1e5) -> Socket:
    return Socket(name, "FLOAT", description, default, 0.0, maximum)


def _sum(name: str, description: str) -> Socket:
    return Socket(name, "FLOAT", f"Sum over bands: {description}", 0.0, -1e5, 1e5)


TOWARDS_VIEWER = _vector(
    "Towards Viewer", "Horizontal unit vector u towards the viewer, in the object's axes; v is to the left of it"
)
EDGE_ON = _number("Edge-On Slope", "Slope along u at which a facet is seen edge-on")
FOOTPRINT_U = _number("Footprint Along View", "Variance of what a pixel covers along u, m²")
FOOTPRINT_V = _number("Footprint Across View", "Variance of what a pixel covers along v, m²")
MESH_NORMAL = _vector("Mesh Normal", "Normal of the mesh in the object's axes")

REST_POSITION = _vector("Rest Position", "Undisturbed x, y in m")
CELLS_PER_METRE = _number("Cells per Metre", "One over the side of a cell of the grid", 1.0)
SHIFT = Socket("Shift", "VECTOR", "Shift of the grid in cells; z is the number of the grid and a half")
PLACE = _vector("Place", "Where to look at the image")
WEIGHT = _number("Weight", "How much the look counts, before weights are normalised", 0.0, 1.0)

WAVENUMBER_2 = _number("Squared Wavenumber", "Of the middle of the band, rad²/m²", 1.0, 9e5)
AMPLITUDE = _number("Amplitude", "Root of the share of the band's slope variance that the mesh leaves", 1.0, 2.0)
SLOPE_X = Socket("Slope x", "FLOAT", "Slope of the band along x", 0.0, -1e3, 1e3)
SLOPE_Y = Socket("Slope y", "FLOAT", "Slope of the band along y", 0.0, -1e3, 1e3)
VARIANCE = _vector("Variance", "Slope variance of the band as (xx, yy, xy)")
SUMS = (
    _sum("Slope u", "slopes shown along u"),
    _sum("Slope v", "slopes shown along v"),
    _sum("Variance uu", "variance of the slopes shown along u"),
    _sum("Variance vv", "variance of the slopes shown along v"),
    _sum("Covariance uv", "covariance of the slopes shown along u and v"),
)
"""A `shading.Shown` as sockets."""


def _turn(graph, vector, vector_type, convert_from, convert_to):
    turned = graph.node(
        "ShaderNodeVectorTransform",
        f"To {convert_to.lower()} space",
        {0: vector},
        vector_type=vector_type,
        convert_from=convert_from,
        convert_to=convert_to,
    )
    return graph.output_of(turned).normalized()


def _build_view(graph: Graph):
    """The mesh's normal and the direction to the viewer in the object's axes, and the size of a pixel."""
    ops = GraphOps(graph)
    with graph.section("Directions"):
        geometry = graph.node("ShaderNodeNewGeometry")
        normal = _turn(graph, graph.output_of(geometry, "Normal"), "NORMAL", "WORLD", "OBJECT")
        to_viewer = _turn(graph, graph.output_of(geometry, "Incoming"), "VECTOR", "WORLD", "OBJECT")
    with graph.section("Pixel"):
        distance = graph.output_of(graph.node("ShaderNodeCameraData"), "View Distance")
        pixel = graph.node("ShaderNodeAttribute", attribute_name=PIXEL_PROPERTY, attribute_type="OBJECT")
        angle, size, _ = graph.output_of(pixel, "Vector").components()
        width = graph.label(ops.multiply_add(distance, angle, size), "width of a pixel")
    with graph.section("View"):
        c, s = shading.view_axes(ops, to_viewer.components())
        sight = shading.sight_of(ops, to_viewer.components(), normal.components(), width)
    values = (graph.vector(c, s, 0.0), *sight, normal)
    for socket, value in zip(VIEW.outputs, values, strict=True):
        graph.output(socket.name, value)


VIEW = GroupRecipe(
    "Ocean LOD Ripple View",
    "2",
    inputs=(),
    outputs=(TOWARDS_VIEWER, EDGE_ON, FOOTPRINT_U, FOOTPRINT_V, MESH_NORMAL),
    build=_build_view,
)
"""How a point is seen."""


def _build_look(graph: Graph):
    """The cell of the grid that the point is in, that cell's own place in the image, and the point's weight."""
    with graph.section("Cell"):
        place = graph.input(REST_POSITION.name) * graph.input(CELLS_PER_METRE.name) + graph.input(SHIFT.name)
        noise = graph.node(
            "ShaderNodeTexWhiteNoise",
            "the cell's own place",
            {"Vector": graph.vector_math("FLOOR", place)},
            noise_dimensions="3D",
        )
        x, y, _ = graph.vector_math("FRACTION", place).components()
    with graph.section("Distance from the border"):
        graph.output(WEIGHT.name, shading.blend_weight(x, y))
    with graph.section("Place in the image"):
        own_x, own_y, _ = graph.output_of(noise, "Color").components()
        cell = 1.0 / shading.CELLS_PER_TILE
        graph.output(PLACE.name, graph.vector(x * cell + own_x, y * cell + own_y, 0.0))


LOOK = GroupRecipe(
    "Ocean LOD Ripple Look",
    "4",
    inputs=(REST_POSITION, CELLS_PER_METRE, SHIFT),
    outputs=(PLACE, WEIGHT),
    build=_build_look,
)
"""Where one of three grids looks at an image."""


def _build_band(graph: Graph):
    """What a pixel keeps of the band along and across the view, added to what it keeps of others."""
    ops = GraphOps(graph)
    with graph.section("Fading"):
        footprints = (graph.input(socket.name) for socket in (FOOTPRINT_U, FOOTPRINT_V))
        k2, amplitude = graph.input(WAVENUMBER_2.name), graph.input(AMPLITUDE.name)
        fades = [shading.fade(ops, footprint, k2, amplitude) for footprint in footprints]
    with graph.section("Tensors along the view"):
        c, s, _ = graph.input(TOWARDS_VIEWER.name).components()
        axes = shading.tensor_axes(ops, c, s)
    with graph.section("Sums"):
        others = shading.Shown(*(graph.input(socket.name) for socket in SUMS))
        slopes = (graph.input(SLOPE_X.name), graph.input(SLOPE_Y.name))
        sums = shading.add_band(ops, others, c, s, axes, fades, slopes, graph.input(VARIANCE.name))
    for socket, value in zip(SUMS, sums, strict=True):
        graph.output(socket.name, value)


BAND = GroupRecipe(
    "Ocean LOD Ripple Band",
    "2",
    inputs=(
        TOWARDS_VIEWER,
        FOOTPRINT_U,
        FOOTPRINT_V,
        WAVENUMBER_2,
        AMPLITUDE,
        SLOPE_X,
        SLOPE_Y,
        VARIANCE,
        *SUMS,
    ),
    outputs=SUMS,
    build=_build_band,
)
"""One band of waves."""


def _build_surface(graph: Graph):
    """The slopes as the viewer meets them, added to those of the mesh; the variance that is left to the BRDF."""
    ops = GraphOps(graph)
    unresolved = graph.input(SLOPE_VARIANCE.name)
    shown = shading.Shown(*(graph.input(socket.name) for socket in SUMS))
    with graph.section("Tensors along the view"):
        c, s, _ = graph.input(TOWARDS_VIEWER.name).components()
        axes = shading.tensor_axes(ops, c, s)
    with graph.section("Left to the BRDF"):
        graph.output(SLOPE_VARIANCE.name, shading.left_to_brdf(axes, unresolved, shown))
    with graph.section("Visible slopes"):
        total = ops.dot(unresolved, axes.of_uu)
        slopes = shading.visible_slopes(ops, shown, graph.input(EDGE_ON.name), total)
    with graph.section("Bumped normal"):
        bumped = shading.bumped_normal(ops, c, s, graph.input(MESH_NORMAL.name).components(), *slopes)
        graph.output(NORMAL.name, _turn(graph, bumped, "NORMAL", "OBJECT", "WORLD"))


SURFACE = GroupRecipe(
    "Ocean LOD Ripple Surface",
    "2",
    inputs=(SLOPE_VARIANCE, MESH_NORMAL, TOWARDS_VIEWER, EDGE_ON, *SUMS),
    outputs=(SLOPE_VARIANCE, NORMAL),
    build=_build_surface,
)
"""The surface with all bands on it."""
