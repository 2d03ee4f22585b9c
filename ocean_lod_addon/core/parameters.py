# SPDX-License-Identifier: GPL-3.0-or-later
"""What a setting is: its meaning, unit, default and range, stated once.

A settings class is a frozen dataclass whose fields are made by `number`, `integer`, `choice`, `switch` and
`text`. The panel's properties, the preset files, the command line and the documentation are all derived
from these descriptions, so that a range can never differ between them.
"""

import dataclasses
import functools
import math
import types
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Integral, Real

from .errors import OceanError, OutOfRangeError

_METADATA_KEY = "parameter"
_FILE_SUFFIX = {"": "", "m": "_m", "s": "_s", "m/s": "_m_s", "rad": "_deg", "mm": "_mm"}


@dataclass(frozen=True)
class Parameter:
    """What every kind of setting has."""

    label: str
    description: str
    default: object


@dataclass(frozen=True)
class Number(Parameter):
    """A real setting in SI units (angles in radians), from `minimum` to `maximum`, both allowed.

    `soft_maximum` is where a slider in the panel ends; larger values can be typed.
    """

    minimum: float
    maximum: float
    unit: str = ""
    soft_maximum: float | None = None


@dataclass(frozen=True)
class Integer(Parameter):
    """A whole-number setting from `minimum` to `maximum`, both allowed."""

    minimum: int
    maximum: int
    unit: str = ""


@dataclass(frozen=True)
class Option:
    """One value of a choice: the key is what files and the command line use."""

    key: str
    label: str
    description: str


@dataclass(frozen=True)
class Choice(Parameter):
    """One of a fixed list of options."""

    options: tuple[Option, ...]


@dataclass(frozen=True)
class Switch(Parameter):
    """On or off."""


@dataclass(frozen=True)
class Text(Parameter):
    """A free name."""


def _field(parameter):
    return dataclasses.field(default=parameter.default, metadata={_METADATA_KEY: parameter})


def number(label, description, default, minimum, maximum, unit="", soft_maximum=None):
    """A dataclass field holding a `Number`."""
    return _field(Number(label, description, default, minimum, maximum, unit, soft_maximum))


def integer(label, description, default, minimum, maximum, unit=""):
    """A dataclass field holding an `Integer`."""
    return _field(Integer(label, description, default, minimum, maximum, unit))


def choice(label, description, default, options):
    """A dataclass field holding a `Choice`."""
    return _field(Choice(label, description, default, tuple(options)))


def switch(label, description, default):
    """A dataclass field holding a `Switch`."""
    return _field(Switch(label, description, default))


def text(label, description, default):
    """A dataclass field holding a `Text`."""
    return _field(Text(label, description, default))


def parameters_of(settings) -> Mapping[str, Parameter]:
    """Field name to parameter, in declaration order, of a settings class or an instance of one."""
    return _parameters_of_class(settings if isinstance(settings, type) else type(settings))


@functools.cache
def _parameters_of_class(settings_class):
    """Kept, since every frame reads and validates its settings."""
    return types.MappingProxyType(
        {
            field.name: field.metadata[_METADATA_KEY]
            for field in dataclasses.fields(settings_class)
            if _METADATA_KEY in field.metadata
        }
    )


def validate(settings) -> None:
    """Raise `OutOfRangeError` for the first setting that is not allowed; for `__post_init__` to call."""
    for name, parameter in parameters_of(settings).items():
        check(name, getattr(settings, name), parameter)


def check(name: str, value: object, parameter: Parameter) -> None:
    """Raise `OutOfRangeError` if `value` is not allowed for `parameter`; `name` is what the line calls it."""
    if not _is_allowed(value, parameter):
        raise OutOfRangeError(name, value, allowed_text(parameter))


def _is_allowed(value, parameter):
    match parameter:
        case Number():
            return _is_of_kind(value, float, Real) and parameter.minimum <= value <= parameter.maximum
        case Integer():
            return _is_of_kind(value, int, Integral) and parameter.minimum <= value <= parameter.maximum
        case Choice():
            return value in [option.key for option in parameter.options]
        case Switch():
            return isinstance(value, bool)
        case Text():
            return isinstance(value, str)
    raise TypeError(f"{type(parameter).__name__} is not a kind of parameter")


def _is_of_kind(value, usual, kind):
    """Whether a value is a number of a kind. Asking an abstract class is slow, so the usual type goes first."""
    return type(value) is usual or (isinstance(value, kind) and not isinstance(value, bool))


def allowed_text(parameter: Parameter) -> str:
    """The allowed values in words, in the units a person types (degrees for angles)."""
    match parameter:
        case Number(unit="rad"):
            return f"{math.degrees(parameter.minimum):g} to {math.degrees(parameter.maximum):g} degrees"
        case Number() | Integer():
            return f"{parameter.minimum:g} to {parameter.maximum:g} {parameter.unit}".rstrip()
        case Choice():
            return "one of " + ", ".join(option.key for option in parameter.options)
        case Switch():
            return "true or false"
        case Text():
            return "text"
    raise TypeError(f"{type(parameter).__name__} is not a kind of parameter")


def file_key(name: str, parameter: Parameter) -> str:
    """The key of a parameter in files: its name and its unit, such as wind_speed_m_s."""
    if isinstance(parameter, Number | Integer):
        return name + _FILE_SUFFIX[parameter.unit]
    return name


def to_file_value(value: object, parameter: Parameter) -> object:
    """The value as files hold it: angles in degrees, everything else unchanged."""
    if isinstance(parameter, Number) and parameter.unit == "rad":
        return round(math.degrees(value), 9)
    return value


def from_file_value(name: str, value: object, parameter: Parameter) -> object:
    """The setting that a file's value means. Raises `OutOfRangeError` in the file's own units."""
    if isinstance(parameter, Number) and parameter.unit == "rad":
        if isinstance(value, bool) or not isinstance(value, Real):
            raise OutOfRangeError(name, value, allowed_text(parameter))
        radians = math.radians(value)
        if not _is_allowed(radians, parameter):
            raise OutOfRangeError(name, value, allowed_text(parameter))
        return radians
    check(name, value, parameter)
    return float(value) if isinstance(parameter, Number) else value


def settings_from_mapping(cls, mapping: dict, where: str, left_out=(), **other_fields):
    """An instance of the settings class `cls` from a file's mapping; missing keys keep their defaults.

    `where` names the file for the error line; settings in `left_out` are not for files, and `other_fields` are
    fields that are no parameters. Raises `OceanError` for an unknown key, a wrong type or a value out of range.
    """
    if not isinstance(mapping, dict):
        raise OceanError(f"{where}: expected a table of settings, found {type(mapping).__name__}")
    by_key = {
        file_key(name, parameter): (name, parameter)
        for name, parameter in parameters_of(cls).items()
        if name not in left_out
    }
    values = {}
    for key, value in mapping.items():
        if key not in by_key:
            raise OceanError(f"{where}: unknown key {key!r}, allowed is {', '.join(by_key)}")
        name, parameter = by_key[key]
        try:
            values[name] = from_file_value(key, value, parameter)
        except OutOfRangeError as error:
            raise OceanError(f"{where}: {error}") from None
    try:
        return cls(**values, **other_fields)
    except OceanError as error:
        raise OceanError(f"{where}: {error}") from None


def mapping_from_settings(settings, left_out=()) -> dict:
    """The file's mapping of a settings instance; `settings_from_mapping` gives the same settings back.

    Settings in `left_out` are not for files.
    """
    return {
        file_key(name, parameter): to_file_value(getattr(settings, name), parameter)
        for name, parameter in parameters_of(settings).items()
        if name not in left_out
    }
