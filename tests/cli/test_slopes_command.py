# SPDX-License-Identifier: GPL-3.0-or-later
"""At every distance the slope variances of geometry, bump and BRDF are together the sea's."""

import json

import numpy as np
import pytest

from ocean_lod_addon.cli import main
from ocean_lod_addon.cli.slopes import looks_at


@pytest.mark.parametrize("wind", [3.0, 10.0, 20.0])
def test_levels_add_up_to_the_sea(wind):
    """Windows, images and shader formulas conserve variance by design. What is left is f(w e) against w^2 f(e) of
    the waves (0.2 % for their steepness) and an image's few hundred waves against an integral."""
    for look in looks_at([wind], height=3.0, width=1920, count=40):
        budget = look.budget
        assert np.abs(look.deviation).max() < 0.02
        assert np.all(budget.brdf[:, :2] > 0.0)
        # each level has its part: mesh and bump nearby, the BRDF alone at the horizon
        assert budget.geometry[0, :2].sum() > 0.2 * budget.total[:2].sum()
        assert budget.bump[0, :2].sum() > 0.3 * budget.total[:2].sum()
        assert budget.brdf[-1, :2] == pytest.approx(budget.total[:2], rel=0.01)


def test_command_prints_json(capsys):
    assert main(["slopes", "--wind", "7", "--distances", "3", "--json"]) == 0
    upwind, crosswind = json.loads(capsys.readouterr().out)
    assert (upwind["view"], crosswind["view"]) == ("upwind", "crosswind")
    for look in (upwind, crosswind):
        levels = np.sum([look[level] for level in ("geometry", "bump", "brdf")], axis=0)
        assert levels == pytest.approx(np.array([look["total"]] * 3), rel=0.02)
