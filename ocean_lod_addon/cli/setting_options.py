# SPDX-License-Identifier: GPL-3.0-or-later
"""Command line options made from settings classes: names, ranges and help come from `core.parameters` alone."""

import argparse

from ..core.errors import OutOfRangeError
from ..core.parameters import (
    Choice,
    Integer,
    Number,
    Parameter,
    Switch,
    allowed_text,
    from_file_value,
    parameters_of,
    to_file_value,
)


def option_name(name: str) -> str:
    """The option for a setting: wind_speed is --wind-speed."""
    return "--" + name.replace("_", "-")


def add_setting_options(parser, settings_class, left_out=()) -> None:
    """An option for each setting of the class that is not in `left_out`; None where it is not given."""
    for name, parameter in parameters_of(settings_class).items():
        if name not in left_out:
            _add_option(parser, name, parameter)


def given_settings(options, settings_class, left_out=()) -> dict:
    """The settings of the class that were given, by name, in SI units."""
    values = {name: getattr(options, name) for name in parameters_of(settings_class) if name not in left_out}
    return {name: value for name, value in values.items() if value is not None}


def _add_option(parser, name, parameter):
    text = _help(parameter)
    match parameter:
        case Switch():
            parser.add_argument(option_name(name), action=argparse.BooleanOptionalAction, default=None, help=text)
        case Choice():
            choices = [option.key for option in parameter.options]
            parser.add_argument(option_name(name), choices=choices, help=text)
        case _:
            parse = _value_of(name, parameter)
            parser.add_argument(option_name(name), type=parse, metavar=_unit(parameter), help=text)


def _help(parameter: Parameter):
    default = to_file_value(parameter.default, parameter)
    if isinstance(parameter, Switch):
        default = "on" if default else "off"
    parts = [parameter.description, f"default {default:g}" if isinstance(default, float) else f"default {default}"]
    if isinstance(parameter, Number | Integer):
        parts.append(allowed_text(parameter))
    return "; ".join(parts).replace("%", "%%")


def _unit(parameter):
    match parameter:
        case Number(unit="rad"):
            return "degrees"
        case Number() if parameter.unit:
            return parameter.unit
        case Integer():
            return "N"
    return "X"


def _value_of(name, parameter):
    """A parser for one setting; its error line names the range."""

    def parse(text):
        try:
            number = int(text) if isinstance(parameter, Integer) else float(text)
        except ValueError:
            number = text
        try:
            return from_file_value(option_name(name), number, parameter)
        except OutOfRangeError as error:
            raise argparse.ArgumentTypeError(f"{text!r} is not allowed, give {error.allowed}") from None

    return parse
