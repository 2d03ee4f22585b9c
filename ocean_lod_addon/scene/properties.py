# SPDX-License-Identifier: GPL-3.0-or-later
"""What an ocean object remembers: its settings, as Blender properties that can be keyed, saved and undone."""

import contextlib
import dataclasses

import bpy

from ..core.beaufort import BEAUFORT_SCALE, beaufort_force, typical_wind
from ..core.effects import Effects
from ..core.foam_settings import Foam
from ..core.framing import Framing
from ..core.lod import Grid
from ..core.material_settings import MaterialSettings
from ..core.ocean import Ocean
from ..core.ocean_time import OceanTime, loop_period
from ..core.parameters import parameters_of
from ..core.presets import FOAM_EFFORT, Preset
from ..core.ripple_settings import Ripples
from ..core.sea import Sea, WaveSystem
from . import rna


class _Changes:
    """Whom to tell that a property has changed; `register` sets it, `many_changes` silences it for a while."""

    def __init__(self):
        self.surface = self.material = None
        self.silenced = False


_changes = _Changes()


@contextlib.contextmanager
def many_changes():
    """Within this context changed properties do not refresh the ocean one by one; refresh it once afterwards."""
    before, _changes.silenced = _changes.silenced, True
    try:
        yield
    finally:
        _changes.silenced = before


def _surface_changed(group, context):
    if not _changes.silenced:
        _changes.surface(group.id_data, context.scene)


def _material_changed(group, context):
    if not _changes.silenced:
        _changes.material(group.id_data, context.scene)


def _effect_changed(group, context):
    _surface_changed(group, context)
    _material_changed(group, context)


def _beaufort_of_wind(system):
    return beaufort_force(system.wind_speed).number


def _wind_of_beaufort(system, number):
    system.wind_speed = round(typical_wind(number), 1)


WaveSystemProperties = rna.property_group(
    "OCEAN_LOD_WaveSystemProperties",
    rna.annotations(WaveSystem, _surface_changed)
    | {
        "beaufort": bpy.props.IntProperty(
            name="Beaufort",
            description="Force of the wind. Type a number to get the wind in the middle of that force",
            min=0,
            max=len(BEAUFORT_SCALE) - 1,
            get=_beaufort_of_wind,
            set=_wind_of_beaufort,
            options=set(),
        ),
    },
)
SeaProperties = rna.property_group(
    "OCEAN_LOD_SeaProperties",
    rna.annotations(Sea, _surface_changed)
    | {
        "systems": bpy.props.CollectionProperty(
            name="Wave Systems", description="The wind sea and the swells", type=WaveSystemProperties
        ),
        "active_system": bpy.props.IntProperty(
            name="Active Wave System", description="The wave system shown in the panel", min=0, options=set()
        ),
    },
)
GridProperties = rna.property_group(
    "OCEAN_LOD_GridProperties", rna.annotations(Grid, _surface_changed, not_animatable=parameters_of(Grid))
)
FramingProperties = rna.property_group(
    "OCEAN_LOD_FramingProperties",
    rna.annotations(Framing, _surface_changed, not_animatable=parameters_of(Framing)),
)
RippleProperties = rna.property_group(
    "OCEAN_LOD_RippleProperties",
    rna.annotations(Ripples, _surface_changed, not_animatable=parameters_of(Ripples)),
)
FoamProperties = rna.property_group(
    "OCEAN_LOD_FoamProperties",
    rna.annotations(Foam, _effect_changed, not_animatable=("memory_steps",)),
)
EffectsProperties = rna.property_group(
    "OCEAN_LOD_EffectsProperties",
    rna.annotations(Effects, _effect_changed, not_animatable=parameters_of(Effects)),
)
TimeProperties = rna.property_group("OCEAN_LOD_TimeProperties", rna.annotations(OceanTime, _surface_changed))
MaterialProperties = rna.property_group(
    "OCEAN_LOD_MaterialProperties", rna.annotations(MaterialSettings, _material_changed)
)
KeptPlaneProperties = rna.property_group(
    "OCEAN_LOD_KeptPlaneProperties", rna.annotations(Grid, None, not_animatable=parameters_of(Grid))
)
QualityProperties = rna.property_group(
    "OCEAN_LOD_QualityProperties",
    {
        "name": bpy.props.StringProperty(
            name="Quality", description="The quality that the plane was last set to", options=set()
        ),
        "budget": bpy.props.FloatProperty(
            name="Budget (ms)",
            description="Time that a frame of this ocean may take on this machine, up to the object that Blender"
            " has evaluated; rendering not counted",
            default=40.0,
            min=0.1,
            soft_max=200.0,
            max=1e5,
            step=100,
            precision=1,
            options=set(),
        ),
        "sized": bpy.props.PointerProperty(type=KeptPlaneProperties),
        "made": bpy.props.PointerProperty(type=KeptPlaneProperties),
    },
)
"""`sized` is the plane as it was before a quality was chosen, `made` as the quality has left it."""

OceanProperties = rna.property_group(
    "OCEAN_LOD_OceanProperties",
    {
        "is_ocean": bpy.props.BoolProperty(
            name="Is an Ocean", description="Whether Ocean LOD moves this object's vertices", options=set()
        ),
        "sea": bpy.props.PointerProperty(type=SeaProperties),
        "grid": bpy.props.PointerProperty(type=GridProperties),
        "framing": bpy.props.PointerProperty(type=FramingProperties),
        "ripples": bpy.props.PointerProperty(type=RippleProperties),
        "foam": bpy.props.PointerProperty(type=FoamProperties),
        "effects": bpy.props.PointerProperty(type=EffectsProperties),
        "quality": bpy.props.PointerProperty(type=QualityProperties),
        "time": bpy.props.PointerProperty(type=TimeProperties),
        "material": bpy.props.PointerProperty(type=MaterialProperties),
    },
)

_CLASSES = (
    WaveSystemProperties,
    SeaProperties,
    GridProperties,
    FramingProperties,
    RippleProperties,
    FoamProperties,
    EffectsProperties,
    TimeProperties,
    MaterialProperties,
    KeptPlaneProperties,
    QualityProperties,
    OceanProperties,
)


def read_system(group) -> WaveSystem:
    """One wave system."""
    return rna.read(WaveSystem, group)


def read_sea(properties) -> Sea:
    """The sea state that an object's properties describe, without the shot's loop."""
    systems = tuple(read_system(group) for group in properties.sea.systems)
    return rna.read(Sea, properties.sea, systems=systems)


def read_ocean(properties, frames_per_second: float) -> Ocean:
    """The ocean that an object's properties describe. Raises OceanError if they do not go together.

    The frame rate (scene.clock) says how long the frames of a loop take.
    """
    sea = dataclasses.replace(
        read_sea(properties), loop_period=loop_period(read_time(properties), frames_per_second)
    )
    return Ocean(
        sea=sea,
        grid=rna.read(Grid, properties.grid),
        framing=rna.read(Framing, properties.framing),
        ripples=read_ripples(properties),
        foam=read_foam(properties),
    )


def read_ripples(properties) -> Ripples:
    """The ripple settings."""
    return rna.read(Ripples, properties.ripples)


def read_foam(properties) -> Foam:
    """The foam settings."""
    return rna.read(Foam, properties.foam)


def read_effects(properties) -> Effects:
    """The artist's word on each effect."""
    return rna.read(Effects, properties.effects)


def sized_plane(properties) -> tuple[Grid, str]:
    """The plane as it was sized before a quality was chosen, and that quality.

    A plane that was changed since then is itself the sized one, and its quality is "".
    """
    grid, quality = rna.read(Grid, properties.grid), properties.quality
    if quality.name and rna.read(Grid, quality.made) == grid:
        return rna.read(Grid, quality.sized), quality.name
    return grid, ""


def write_quality(properties, name: str, sized: Grid, settings) -> None:
    """Put what a quality (core.plan.Settings) decides into an object's properties: plane, ripples, foam, effects.

    The plane that it was made from is remembered; the caller refreshes the ocean.
    """
    with many_changes():
        rna.write(settings.grid, properties.grid)
        rna.write(settings.ripples, properties.ripples)
        rna.write(settings.foam, properties.foam)
        rna.write(settings.effects, properties.effects)
        rna.write(settings.grid, properties.quality.made)
        rna.write(sized, properties.quality.sized)
        properties.quality.name = name


def read_time(properties) -> OceanTime:
    """The clock settings."""
    return rna.read(OceanTime, properties.time)


def read_material(properties) -> MaterialSettings:
    """The material settings."""
    return rna.read(MaterialSettings, properties.material)


def read_preset(properties, title: str, description: str) -> Preset:
    """A preset of the sea state, the water and the look of the foam; the shot is a preset's default."""
    foam = dataclasses.replace(read_foam(properties), **{name: getattr(Foam(), name) for name in FOAM_EFFORT})
    return Preset(title, description, read_sea(properties), read_material(properties), foam)


def write_preset(preset: Preset, properties) -> None:
    """Put a preset's sea state, water and foam into an object's properties; the caller refreshes the ocean."""
    write_sea(preset.sea, properties)
    write_material(preset.material, properties)
    write_foam(preset.foam, properties)


def write_sea(sea: Sea, properties) -> None:
    """Put a sea into an object's properties; the caller refreshes the ocean."""
    with many_changes():
        rna.write(sea, properties.sea)
        properties.sea.systems.clear()
        for system in sea.systems:
            rna.write(system, properties.sea.systems.add())
        properties.sea.active_system = 0


def write_grid(grid: Grid, properties) -> None:
    """Put the plane's shape into an object's properties; the caller refreshes the ocean."""
    with many_changes():
        rna.write(grid, properties.grid)


def write_ripples(ripples: Ripples, properties) -> None:
    """Put settings of ripples into an object's properties; the caller refreshes the ocean."""
    with many_changes():
        rna.write(ripples, properties.ripples)


def write_material(material: MaterialSettings, properties) -> None:
    """Put material settings into an object's properties; the caller refreshes the ocean."""
    with many_changes():
        rna.write(material, properties.material)


def write_foam(foam: Foam, properties) -> None:
    """Put the look of foam into an object's properties, not the effort; the caller refreshes the ocean."""
    kept = {name: getattr(properties.foam, name) for name in FOAM_EFFORT}
    with many_changes():
        rna.write(dataclasses.replace(foam, **kept), properties.foam)


def register(surface_changed, material_changed):
    """Register the property groups and attach them to every object.

    The arguments are called with (object, scene) after a property of an object's surface or material changed.
    """
    _changes.surface, _changes.material = surface_changed, material_changed
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Object.ocean_lod = bpy.props.PointerProperty(type=OceanProperties)


def unregister():
    """Undo `register`."""
    del bpy.types.Object.ocean_lod
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
