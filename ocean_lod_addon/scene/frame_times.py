# SPDX-License-Identifier: GPL-3.0-or-later
"""How long the last frame of each ocean took, by stage. For people to read: nothing is decided by it."""

import time

_last: dict[int, dict[str, float]] = {}
"""Seconds of each stage, by the ocean object's session id."""


class StageClock:
    """Adds up the time between calls, each to a stage; a call takes well under a microsecond."""

    def __init__(self):
        self.seconds: dict[str, float] = {}
        self._last = time.perf_counter()

    def done(self, stage: str) -> None:
        """What has run since the call before belongs to `stage` (core.cost.model.STAGES)."""
        now = time.perf_counter()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._last
        self._last = now


def keep(ob, clock: StageClock) -> None:
    """Remember the times of an ocean's frame."""
    _last[ob.session_uid] = clock.seconds


def of_last_frame(ob) -> dict[str, float]:
    """Seconds of each stage of an ocean's last frame; empty before the first."""
    return _last.get(ob.session_uid, {})
