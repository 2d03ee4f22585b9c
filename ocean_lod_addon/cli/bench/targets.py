# SPDX-License-Identifier: GPL-3.0-or-later
"""What the frame update must reach, each as a ratio of two times of the same run, and whether it does."""

from dataclasses import dataclass

from . import measurements, workloads
from .correctness import Correctness
from .in_blender import DEPSGRAPH, WRITE
from .measurements import DISPLACE, EINSUM, FRAME, GENERATE, PRODUCTS, UPDATE, Row, Scaling, ViewResult
from .timing import Ratio, ratio

PASS, MISS, NOT_MEASURED = "PASS", "MISS", "not measured"


@dataclass(frozen=True)
class Target:
    """A ratio and its limit. The verdict goes by the medians; the fastest runs stand beside them."""

    text: str
    limit: float
    at_most: bool
    measured: Ratio | None

    @property
    def verdict(self) -> str:
        """PASS, MISS or NOT_MEASURED."""
        if self.measured is None:
            return NOT_MEASURED
        value = self.measured.of_medians
        reached = value <= self.limit if self.at_most else value >= self.limit
        return PASS if reached else MISS

    def as_mapping(self) -> dict:
        """For the saved file."""
        return {
            "target": self.text,
            "at_most" if self.at_most else "at_least": self.limit,
            "ratio_of_medians": self.measured and self.measured.of_medians,
            "ratio_of_minima": self.measured and self.measured.of_minima,
            "verdict": self.verdict,
        }


@dataclass(frozen=True)
class _Peer:
    """How many times faster than a mode of the Ocean modifier a frame must be, with BLAS and by einsum."""

    case: tuple[int, int]
    mode: str
    with_blas: float
    by_einsum: float


_PEERS = (
    _Peer((512, 128), GENERATE, 15.0, 3.0),
    _Peer((1024, 256), GENERATE, 25.0, 6.0),
    _Peer((1024, 256), DISPLACE, 13.0, 3.5),
)

_OVER_PRODUCTS = {(512, 128): 1.3, (1024, 256): 1.25}
_SHARE_OF_BEST_RATE = 0.75
_STEP_LIMITS = {4: 4.4, 2: 2.2}
_CULLING = 3.0
_SWIM = 0.01
_PRECISION = 2e-6
_ALLOCATION = 0.05
"""Of the size of the positions, of the largest case: NumPy's own buffers, of constant size."""


def frame_targets(rows: list[Row], contraction: str) -> list[Target]:
    """Targets about the sizes that they name: what a frame is made of, then the Ocean modifier beside it."""
    wanted = [row for row in rows if (row.cells, row.waves) in measurements.TARGET_CASES]
    squares = [row for row in wanted if row.kind == workloads.SQUARE]
    result = [target for row in squares for target in _own_targets(row, contraction)]
    if contraction == "matmul":
        result += _peer_targets(wanted, FRAME, "with BLAS")
        result += _peer_targets(wanted, EINSUM, "by einsum")
    else:
        result += _peer_targets(wanted, FRAME, "by einsum")
    return result


def _own_targets(row, contraction):
    update, products = row.timings[UPDATE], row.timings[PRODUCTS]
    allocated = row.allocated / (12 * row.vertices)
    case = _case(row)
    over_products = _OVER_PRODUCTS[row.cells, row.waves]
    rate, allocation = [], []
    if (row.cells, row.waves) == measurements.TARGET_CASES[-1]:
        text = f"allocated in a frame / positions: {case}"
        allocation.append(Target(text, _ALLOCATION, True, Ratio(allocated, allocated)))
    if contraction == "matmul":
        text = f"rate of products / best sgemm: {case}"
        rate.append(Target(text, _SHARE_OF_BEST_RATE, False, row.share_of_best_rate))
    return [
        Target(f"update / products in it: {case}", over_products, True, ratio(update, products)),
        Target("  the same, surface alone", over_products, True, ratio(update, products, above_without=(WRITE,))),
        *rate,
        *allocation,
    ]


def _case(row):
    return f"{row.kind}, {row.vertices} vertices, {row.waves} waves"


def _peer_targets(rows, ours, how):
    """Both times up to the evaluated object in Blender; then ours without Blender's evaluation."""
    result = []
    for peer in _PEERS:
        limit = peer.with_blas if how == "with BLAS" else peer.by_einsum
        for row in rows:
            if (row.cells, row.waves) != peer.case:
                continue
            text = f"{peer.mode} / frame {how}: {_case(row)}"
            modifier = row.timings.get(peer.mode)
            in_blender = modifier and ratio(modifier, row.timings[ours])
            update = modifier and ratio(modifier, row.timings[ours], below_without=(DEPSGRAPH,))
            result.append(Target(text, limit, False, in_blender))
            result.append(Target("  the same, our update alone", limit, False, update))
    return result


def scaling_targets(scaling: Scaling) -> list[Target]:
    """Targets about steps in the number of vertices and waves."""
    return [Target(f"surface, {step.text}", _STEP_LIMITS[step.factor], True, step.ratio) for step in scaling.steps]


def culling_targets(views: list[ViewResult]) -> list[Target]:
    """Targets about leaving out what the camera does not see."""
    return [
        Target(f"whole plane / in view: {view.vertices} vertices, {view.sea}", _CULLING, False, view.saved)
        for view in views
    ]


def correctness_targets(correctness: Correctness) -> list[Target]:
    """Targets about lengths and areas instead of times."""
    swim, seams, precision = correctness.swim, correctness.seams, correctness.precision

    def at_most(text, limit, value):
        return Target(text, limit, True, Ratio(value, value))

    return [
        at_most(f"swim / significant height, largest: {swim.frames} frames", _SWIM, swim.swim_max),
        at_most(f"gap between {seams.levels} levels / area: {seams.offsets} offsets", 0.0, seams.gap),
        at_most("overlap of levels / area", 0.0, seams.overlap),
        at_most("height error / significant height: origin, t = 0", _PRECISION, precision.at_origin),
        at_most("height error / significant height: 100 km, t = 1e6 s", _PRECISION, precision.far_and_late),
    ]
