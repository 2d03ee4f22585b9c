# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender properties made from the settings classes of core, and settings read back from them.

Names, ranges, units and tooltips come from `core.parameters` alone.
"""

import functools
import math
import typing

import bpy
import numpy as np

from ..core.parameters import Choice, Integer, Number, Parameter, Switch, Text, parameters_of

_FEW_DECIMALS, _MANY_DECIMALS, _MANY_DECIMALS_BELOW = 2, 3, 10.0
"""Decimals that the panel shows, many for settings whose slider ends below the third number."""

_LARGEST_STEP = 100
"""Blender's limit for the step of a field's arrows, in hundredths."""

_LONGEST_FLOAT32 = 10
"""Nine decimal digits tell any two float32 apart."""


def annotations(settings_class, update, not_animatable=()) -> dict:
    """Property annotations for a PropertyGroup that holds a settings class.

    `update` is called when a property changes; names in `not_animatable` can not be keyed.
    """
    return {
        name: _property(parameter, update, {"ANIMATABLE"} if name not in not_animatable else set())
        for name, parameter in parameters_of(settings_class).items()
    }


def _property(parameter: Parameter, update, options):
    common = {
        "name": parameter.label,
        "description": parameter.description,
        "default": parameter.default,
        "update": update,
        "options": options,
    }
    match parameter:
        case Number(unit="rad"):
            return bpy.props.FloatProperty(
                **common,
                min=parameter.minimum,
                max=parameter.maximum,
                subtype="ANGLE",
                precision=_FEW_DECIMALS,
                step=_LARGEST_STEP,
            )
        case Number():
            common |= _with_unit(parameter)
            soft_maximum = parameter.maximum if parameter.soft_maximum is None else parameter.soft_maximum
            return bpy.props.FloatProperty(
                **common,
                min=parameter.minimum,
                max=parameter.maximum,
                soft_max=soft_maximum,
                precision=_decimals(parameter, soft_maximum),
                step=_step(soft_maximum),
            )
        case Integer():
            common |= _with_unit(parameter)
            return bpy.props.IntProperty(**common, min=parameter.minimum, max=parameter.maximum)
        case Choice():
            items = [(option.key, option.label, option.description) for option in parameter.options]
            return bpy.props.EnumProperty(**common, items=items)
        case Switch():
            return bpy.props.BoolProperty(**common)
        case Text():
            return bpy.props.StringProperty(**common)
    raise TypeError(f"{type(parameter).__name__} is not a kind of parameter")


def _decimals(parameter, soft_maximum):
    """Enough to tell the smallest value from nothing."""
    wanted = _MANY_DECIMALS if soft_maximum < _MANY_DECIMALS_BELOW else _FEW_DECIMALS
    if parameter.minimum > 0.0:
        wanted = max(wanted, math.ceil(-math.log10(parameter.minimum)))
    return wanted


def _step(soft_maximum):
    """A hundredth of the slider, to a power of ten, in Blender's hundredths."""
    hundredth = 10.0 ** (math.floor(math.log10(soft_maximum)) - 2)
    return min(max(round(100.0 * hundredth), 1), _LARGEST_STEP)


def _with_unit(parameter):
    """Name with the unit in it: values are SI whatever the scene's unit scale, so the panel says which."""
    if not parameter.unit:
        return {}
    return {"name": f"{parameter.label} ({parameter.unit})"}


def read(settings_class, group, **other_fields):
    """The settings held by a PropertyGroup made with `annotations`; `other_fields` are passed on as they are.

    Raises OceanError if the values do not go together (single values are kept in range by Blender).
    """
    values = tuple(getattr(group, name) for name in parameters_of(settings_class))
    return _settings(settings_class, values, tuple(other_fields.items()))


@functools.lru_cache(maxsize=256)  # every frame reads all settings anew, most as they were
def _settings(settings_class, values, other_fields):
    """Settings of the values that Blender keeps, in the order of their parameters."""
    parameters = parameters_of(settings_class).items()
    typed = {name: _python_value(value, each) for (name, each), value in zip(parameters, values, strict=True)}
    return settings_class(**typed, **dict(other_fields))


def _python_value(value, parameter):
    """The value a person typed: Blender keeps float32, whose shortest decimal form is what was meant."""
    if isinstance(parameter, Number):
        typed = typed_angle(value) if parameter.unit == "rad" else typed_number(value)
        return min(max(typed, parameter.minimum), parameter.maximum)
    return value


@functools.lru_cache(maxsize=1024)
def typed_number(value: float) -> float:
    """The shortest decimal number that Blender would keep as this float32 value."""
    return float(str(np.float32(value)))


@functools.lru_cache(maxsize=1024)
def typed_angle(value: float) -> float:
    """The angle in rad whose number of degrees is the shortest that Blender would keep as this float32 value."""
    kept = np.float32(value)
    for digits in range(1, _LONGEST_FLOAT32):
        radians = math.radians(float(f"{math.degrees(value):.{digits}g}"))
        if np.float32(radians) == kept:
            return radians
    return typed_number(value)


def write(settings, group) -> None:
    """Put settings into a PropertyGroup made with `annotations` for their class."""
    for name in parameters_of(settings):
        setattr(group, name, getattr(settings, name))


def property_group(name: str, annotations_: typing.Mapping) -> type:
    """A PropertyGroup class with these property annotations."""
    return type(name, (bpy.types.PropertyGroup,), {"__annotations__": dict(annotations_)})
