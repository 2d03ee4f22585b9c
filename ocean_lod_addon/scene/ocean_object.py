# SPDX-License-Identifier: GPL-3.0-or-later
"""Ocean objects: making them, keeping them in step with their settings, moving them with time.

Geometry and attributes are created here, from operators and property changes. The frame-change handler only
writes arrays into what is there: Blender may call it from a worker thread.
"""

import functools
import sys
import threading

import bpy
import numpy as np

from ..core.column_blocks import TANGENTS, VELOCITY
from ..core.errors import OceanError
from ..core.foam_settings import Foam
from ..core.kernel import ReusedArray
from ..core.lod import Grid
from ..core.material_settings import MaterialSettings
from ..core.normals import surface_normals
from ..core.ocean import Ocean, Surface
from ..core.ocean_time import sea_time
from ..core.plan import EFFECT_ATTRIBUTES, FOAM_ATTRIBUTE, NORMAL_ATTRIBUTE, VELOCITY_ATTRIBUTE, Plan
from ..core.ripple_settings import Ripples
from ..core.sea import Sea
from ..nodes.pass_through import ensure_pass_through
from . import bump, clock, foam, frame_times, ocean_material, placing, planning, properties
from . import mesh as mesh_arrays

_MODIFIER_NAME = "Ocean LOD"

_TRANSFORM_TOLERANCE = 1e-4

_problems: dict[int, str] = {}
"""What keeps an ocean from moving, by the object's session id; for the panel, and to report it only once."""

_evaluation = threading.Lock()
"""A surface has scratch memory: one evaluation at a time."""


@functools.lru_cache(maxsize=8)
def _surface(ocean: Ocean) -> Surface:
    """The surface of an ocean, kept while the same settings are in use."""
    return Surface(ocean)


@functools.lru_cache(maxsize=6)
def _buffer(vertex_count: int, columns: int, number: int = 0) -> ReusedArray:
    """Memory that kernels write into; another `number` is another array."""
    return ReusedArray(np.empty((vertex_count, columns), np.float32))


@functools.lru_cache(maxsize=1)
def _normals(vertex_count: int) -> np.ndarray:
    """Scratch memory."""
    return np.empty((vertex_count, 3), np.float32)


def forget_surfaces() -> None:
    """Let go of all surfaces and scratch memory: the next frame makes what it needs."""
    for cached in (_surface, _buffer, _normals):
        cached.cache_clear()


def create(
    scene,
    sea: Sea,
    grid: Grid,
    material: MaterialSettings,
    name="Ocean",
    *,
    ripples: Ripples | None = None,
    foam: Foam | None = None,
):
    """A new ocean object in the active collection, at its surface of the current frame. Raises OceanError."""
    ob = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    try:
        ob.scale = (metres_to_units(scene),) * 3
        ob.ocean_lod.is_ocean = True
        properties.write_sea(sea, ob.ocean_lod)
        properties.write_grid(grid, ob.ocean_lod)
        properties.write_material(material, ob.ocean_lod)
        properties.write_ripples(ripples or Ripples(), ob.ocean_lod)
        properties.write_foam(foam or Foam(), ob.ocean_lod)
        add_pass_through_modifier(ob)
        _rebuild_and_move(ob, scene)
        planned = planning.PlannedOcean(ob, scene)
        ocean_material.apply(ob, scene, planned.material)
        _apply_surface_nodes(ob, scene, planned.ocean)
    except OceanError:
        bpy.data.meshes.remove(ob.data)
        raise
    # Handlers of a render run while the window draws; without the lock Blender can read a mesh being written.
    scene.render.use_lock_interface = True
    return ob


def add_pass_through_modifier(ob):
    """A modifier that does nothing, but tells Blender that the mesh deforms.

    Without one, Alembic and USD export a static mesh and neither engine blurs moved vertices. Blender takes any
    geometry nodes for a deformation, and nodes that hand the mesh on share its arrays: a deform modifier, even of
    no strength, would copy the vertices in every frame.
    """
    ob.modifiers.new(_MODIFIER_NAME, "NODES").node_group = ensure_pass_through()


def is_ocean(ob) -> bool:
    """Whether an object is one of ours."""
    return ob is not None and ob.type == "MESH" and ob.ocean_lod.is_ocean


def visible_oceans(scene, depsgraph) -> list:
    """The original ocean objects that `depsgraph` shows: it leaves out what is hidden for its purpose."""
    return [ob.original for ob in depsgraph.objects if is_ocean(ob)]


def scene_sea_time(evaluated, scene) -> float:
    """The clock of an (evaluated) ocean, s, at the scene's current frame and sub-frame."""
    settings = properties.read_time(evaluated.ocean_lod)
    return sea_time(settings, clock.current_frame(scene), clock.frames_per_second(scene))


def read_ocean(evaluated, scene) -> Ocean:
    """What an (evaluated) ocean's settings ask for, in a scene of this frame rate. Raises OceanError.

    What it is made of is up to the plan as well (scene.planning).
    """
    return properties.read_ocean(evaluated.ocean_lod, clock.frames_per_second(scene))


def update(ob, scene, depsgraph) -> None:
    """Move an ocean to the scene's current frame. Raises OceanError if it can not be moved.

    Settings are read from the evaluated object: during a render, animation reaches only that one.
    """
    stages = frame_times.StageClock()
    time = scene_sea_time(ob.evaluated_get(depsgraph), scene)
    planned, surface, placement = decide_frame(ob, scene, depsgraph, time)
    stages.done("setup")
    if placement is not None:
        with_velocity = depsgraph.mode == "RENDER" or planned.plan.on("velocity")
        _write_surface(ob, surface, placement, time, with_velocity, stages)
        bump.update(ob, surface, time)
        if _looks_up_textures(planned.ocean):
            bump.update_pixel(ob, scene, planned.view)
        stages.done("ripples")
    frame_times.keep(ob, stages)


def decide_frame(ob, scene, depsgraph, time):
    """What a frame is made by: its plan, and its surface and placement or None where nothing is to be moved.

    `time` is that of the sea, s.

    While the shutter of a rendered frame is open the plan and the placement stay. Raises OceanError.
    """
    evaluated, final = ob.evaluated_get(depsgraph), depsgraph.mode == "RENDER"
    _check_transform(evaluated, scene)
    kept = placing.decision_of_open_shutter(ob, scene)
    planned = planning.PlannedOcean(evaluated, scene, depsgraph, final, plan=kept and kept.plan)
    grid, placement = planned.ocean.grid, kept and kept.placement
    surface = None
    if planned.plan.tiles != "none":
        surface = _surface(planned.ocean)
        ocean_material.set_surroundings(ob, depsgraph.scene_eval, planned.ocean.sea)
        if kept is None or kept.grid != grid:
            moment = None if scene.render.use_motion_blur else time
            placement = surface.placement(planned.view, final, moment)
            placement = placement if placement.sees_water else None
    if kept is None:
        placing.keep_decision(ob, scene, placing.FrameDecision(planned.plan, grid, placement))
    return planned, surface, placement


def update_reporting(ob, scene, depsgraph) -> None:
    """`update`, for Blender's handlers: a problem is reported once on the terminal, and the ocean stays still."""
    try:
        update(ob, scene, depsgraph)
    except Exception as error:  # noqa: BLE001 - nothing may be raised into Blender's frame loop
        _report(ob, error)
    else:
        _problems.pop(ob.session_uid, None)


def problem(ob) -> str:
    """What keeps an ocean from moving, in one line, or an empty text."""
    return _problems.get(ob.session_uid, "")


def _report(ob, error):
    message = str(error) if isinstance(error, OceanError) else f"{type(error).__name__}: {error}"
    if _problems.get(ob.session_uid) != message:
        print(f"Ocean LOD: {ob.name} stays still: {message}", file=sys.stderr, flush=True)
    _problems[ob.session_uid] = message


def refresh(ob, scene) -> None:
    """Bring an ocean in step with its settings, geometry included; for operators and changed properties."""
    if not is_ocean(ob):
        return
    try:
        _apply_surface_nodes(ob, scene, _rebuild_and_move(ob, scene).ocean)
    except OceanError as error:
        _report(ob, error)
    else:
        if _problems.pop(ob.session_uid, None):
            refresh_material(ob, scene)  # it has missed the changes meanwhile


def refresh_material(ob, scene) -> None:
    """Bring an ocean's material in step with its settings, once they go together."""
    if not is_ocean(ob):
        return
    try:
        ocean_material.apply(ob, scene, planning.PlannedOcean(ob, scene).material)
    except OceanError as error:
        _report(ob, error)


def prepare_render(ob, scene) -> None:
    """Let an ocean have the attributes and nodes that a render calls for; not for handlers beside a window.

    The surface itself waits for the frame. Settings that do not go together are reported by the frame, too.
    """
    if not is_ocean(ob):
        return
    try:
        planned = planning.PlannedOcean(ob, scene)
        if not mesh_arrays.has_geometry_for(ob.data, planned.ocean.grid.vertex_count):
            return
        _ensure_attributes(ob.data, planned)
        material = ocean_material.own_material(ob)
        if material is not None:
            ocean_material.apply(ob, scene, planned.material)
            foam.apply(material, planned.ocean)
            if bump.is_shown(material) != (planned.ocean.ripples.kind != "off"):
                _apply_surface_nodes(ob, scene, planned.ocean)
    except OceanError:
        return


def plan(ob, scene) -> Plan:
    """The plan for a picture rendered at the scene's current frame. Raises OceanError."""
    return planning.PlannedOcean(ob, scene).plan


def _rebuild_and_move(ob, scene):
    """Give an ocean the geometry and attributes of its plan, at its surface of the current frame."""
    planned = planning.PlannedOcean(ob, scene)
    ocean = planned.ocean
    if not mesh_arrays.has_geometry_for(ob.data, ocean.grid.vertex_count):
        mesh_arrays.build_topology(ob.data, ocean.grid)
    _ensure_attributes(ob.data, planned)
    surface = _surface(ocean)
    placement = surface.placement(planned.view)
    _write_surface(ob, surface, placement, scene_sea_time(ob, scene))
    return planned


def _ensure_attributes(mesh, planned):
    """Attributes come and go here, with the plan."""
    ocean = planned.ocean
    bump.ensure_attributes(mesh, ocean)
    mesh_arrays.ensure_gust_attribute(mesh, ocean.ripples.gusts)
    mesh_arrays.ensure_rest_positions(mesh, _looks_up_textures(ocean))
    wanted = [name for name in planned.plan.attributes if name in EFFECT_ATTRIBUTES]
    mesh_arrays.ensure_attributes(mesh, wanted, EFFECT_ATTRIBUTES)


def metres_to_units(scene) -> float:
    """How many of the scene's units a metre is; an ocean's mesh is in metres and its object scaled by this."""
    return 1.0 / scene.unit_settings.scale_length


def _looks_up_textures(ocean):
    """Whether the material needs undisturbed positions and the size of a pixel."""
    return ocean.ripples.kind != "off" or ocean.foam is not None


def _check_transform(ob, scene):
    """Refuse what no sea does: be tilted or scaled. It can be moved anywhere and turned about z."""
    expected = metres_to_units(scene)
    scale = ob.matrix_world.to_scale()
    if max(abs(factor / expected - 1.0) for factor in scale) > _TRANSFORM_TOLERANCE:
        raise OceanError(
            f"the object's scale is {', '.join(f'{factor:g}' for factor in scale)}, allowed is {expected:g} in a "
            f"scene with unit scale {1.0 / expected:g}: change the sea state or the cell size instead"
        )
    if ob.matrix_world.to_3x3().normalized()[2][2] < 1.0 - _TRANSFORM_TOLERANCE:
        raise OceanError("the object is tilted, allowed is a rotation about z")


def _write_surface(ob, surface, placement, time, with_velocity=True, stages=None):
    """Write the surface into the mesh, and what its attributes ask for: a plan has put them there."""
    stages = stages or frame_times.StageClock()
    mesh, ocean = ob.data, surface.ocean
    if not mesh_arrays.has_geometry_for(mesh, surface.vertex_count):
        raise OceanError(
            f"the mesh has {len(mesh.vertices)} vertices, its settings make {surface.vertex_count}; "
            "change any of its Mesh settings to rebuild it"
        )
    if mesh_arrays.static_fingerprint(mesh) != ocean.fingerprint:
        mesh_arrays.write_slope_variance(mesh, surface.slope_variance())
        bump.write_static(mesh, surface)
        foam.write_static(mesh, surface)
        mesh_arrays.set_static_fingerprint(mesh, ocean.fingerprint)
        stages.done("setup")
    attributes = mesh.attributes
    if surface.has_gusts and mesh_arrays.GUST in attributes:
        mesh_arrays.write_gusts(mesh, *surface.gusty(placement.anchors, time))
    with _evaluation:
        positions, more = _buffer(surface.vertex_count, 3), {}
        if NORMAL_ATTRIBUTE in attributes:
            more[TANGENTS] = _buffer(surface.vertex_count, TANGENTS.columns)
        if VELOCITY_ATTRIBUTE in attributes and with_velocity:
            more[VELOCITY] = _buffer(surface.vertex_count, VELOCITY.columns, number=1)
        if FOAM_ATTRIBUTE in attributes and surface.whitecaps is not None:
            block = surface.whitecaps.block
            more[block] = _buffer(surface.vertex_count, block.columns, number=2)
        surface.positions(time, placement, positions, more)
        stages.done("products")
        mesh_arrays.write_positions(mesh, positions.array)
        if VELOCITY in more:
            mesh_arrays.write_vectors(mesh, VELOCITY_ATTRIBUTE, more[VELOCITY].array)
        stages.done("write")
        if TANGENTS in more:
            normals = _normals(surface.vertex_count)
            surface_normals(more[TANGENTS].array, normals)
            stages.done("normals")
            mesh_arrays.write_vectors(mesh, NORMAL_ATTRIBUTE, normals)
            stages.done("write")
        if FOAM_ATTRIBUTE in attributes:
            foam.write(mesh, surface, more)
            stages.done("foam")
    anchors = placement.anchors
    if mesh_arrays.has_rest_positions(mesh) and not mesh_arrays.rest_positions_are_for(mesh, anchors):
        mesh_arrays.write_rest_positions(mesh, anchors, surface.undisturbed(anchors))
    stages.done("write")


def _apply_surface_nodes(ob, scene, ocean):
    """Bring images and nodes of ripples and foam in step with the settings, once there is a material."""
    material = ocean_material.own_material(ob)
    if material is not None:
        foam.apply(material, ocean)
        if _looks_up_textures(ocean):
            bump.update_pixel(ob, scene, placing.camera_view(ob, scene))
        else:
            bump.forget_pixel(ob)
        bump.apply(ob, material, _surface(ocean), scene_sea_time(ob, scene))
