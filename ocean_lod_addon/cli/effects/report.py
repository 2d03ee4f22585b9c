# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of `effects` as text."""

from ...core.effects import OFF, ON
from ..bench.timing import PairedRatio, Timing, paired_ratio
from .builds import ABSENT

LIMIT = 0.03
"""What is off may take this much more than what is absent."""

LEGEND = """\
on: an ocean with this effect and no other; off: the same after it was turned on and off again; absent: an ocean
that never had any. Measured in turns in one process; medians, in ms. off/absent is 1 where what is off costs
nothing: the median over the turns, and behind +- its standard error. frame: the frame-change handler, Blender's
evaluation of the object, and the normals that it is shaded with. MB: mesh, images and all arrays that a frame
keeps. CYCLES, EEVEE: whole renders."""


def off_over_absent(states: dict[str, Timing]) -> PairedRatio:
    """How many times longer it takes where the effect is off than where it never was on."""
    return paired_ratio(states[OFF], states[ABSENT])


def header(engines) -> list[str]:
    """Two lines above the table."""
    above = f"{'':15}{'frame':^31}{'memory, MB':^18}" + "".join(f"{engine:^31}" for engine in engines)
    times = f"{'on':>7}{'off':>7}{'off/absent':>15}  "
    return [above.rstrip(), f"{'':15}{times}{'on':>9}{'off':>8} " + times * len(engines)]


def line(row) -> str:
    """The numbers of an effect."""
    memory = f"{row.memory[ON] / 1e6:9.1f}{row.memory[OFF] / 1e6:8.1f} "
    return f"{row.label:15}{_times(row.frame)}{memory}" + "".join(map(_times, row.pictures.values()))


def _times(states):
    on, off = (1e3 * states[state].median() for state in (ON, OFF))
    ratio = off_over_absent(states)
    return f"{on:7.1f}{off:7.1f}{ratio.value:8.3f} +-{ratio.error:.3f}  "


def verdicts(rows) -> list[str]:
    """Whether what is off costs nothing."""
    kinds = {"a frame": [(row, row.frame) for row in rows]}
    for engine in rows[0].pictures:
        kinds[f"a picture in {engine}"] = [(row, row.pictures[engine]) for row in rows]
    lines = []
    for what, measured in kinds.items():
        over = {row.label: off_over_absent(states) for row, states in measured}
        worst = max(over, key=lambda label: over[label].value)
        most, verdict = over[worst].value - 1.0, _verdict(over[worst])
        lines.append(f"{what} with an effect off takes {most:+.1%} at most ({worst}): {verdict}")
    same = all(row.memory[OFF] <= (1.0 + LIMIT) * row.memory[ABSENT] for row in rows)
    passed = "PASS" if same else "MISS"
    lines.append(f"memory with an effect off is within {LIMIT:.0%} of what it is without: {passed}")
    return lines


def _verdict(ratio):
    """A miss, if two standard errors do not explain it."""
    if ratio.value <= 1.0 + LIMIT:
        return "PASS"
    return "MISS" if ratio.value - 2.0 * ratio.error > 1.0 + LIMIT else f"UNDECIDED, +-{ratio.error:.1%}"
