# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors an artist can cause, each of which prints as one clear line."""


class OceanError(ValueError):
    """Something the artist can mend; its text is one line, fit for a panel or a terminal."""


class OutOfRangeError(OceanError):
    """A value outside its range: the line names the parameter, the value and what is allowed."""

    def __init__(self, name: str, value: object, allowed: str):
        super().__init__(f"{name} is {value!r}, allowed is {allowed}")
        self.name, self.value, self.allowed = name, value, allowed
