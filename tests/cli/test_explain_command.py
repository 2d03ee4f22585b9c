# SPDX-License-Identifier: GPL-3.0-or-later
"""`explain` prints the plan of a preset's shot, as text and as JSON."""

import json

import pytest

from ocean_lod_addon.cli import EXIT_BAD_INPUT, EXIT_OK, main
from ocean_lod_addon.core.effects import Effects
from ocean_lod_addon.core.parameters import parameters_of


def explained(capsys, *arguments):
    assert main(["explain", "--json", *arguments]) == EXIT_OK
    return json.loads(capsys.readouterr().out)


def test_json_has_every_effect_with_its_reason(capsys):
    plan = explained(capsys)
    assert list(plan["effects"]) == list(parameters_of(Effects))
    assert all(effect["why"] for effect in plan["effects"].values())


def test_motion_blur_adds_columns_and_an_attribute_in_cycles_alone(capsys):
    still, blurred = explained(capsys), explained(capsys, "--shutter", "0.01")
    assert "velocity" not in still["attributes"]
    assert "velocity" in blurred["attributes"]
    assert blurred["columns_per_vertex"] == still["columns_per_vertex"] + 3
    assert explained(capsys, "--shutter", "0.01", "--engine", "EEVEE")["attributes"] == still["attributes"]


def test_foam_is_explained_by_its_law(capsys):
    """0.83 % of the sea at 9.5 m/s, by Monahan and O'Muircheartaigh; twice that, or none, where it is wanted."""
    foam = explained(capsys)["effects"]["foam"]
    assert foam["on"] is True
    assert f"{3.84e-6 * 9.5**3.41:.2%} of the sea" in foam["why"]
    twice = explained(capsys, "--coverage", "2")["effects"]["foam"]["why"]
    assert f"{2.0 * 3.84e-6 * 9.5**3.41:.2%} of the sea" in twice
    assert explained(capsys, "--coverage", "0")["effects"]["foam"] == {"on": False, "why": "Foam's Coverage is 0"}


def test_text_has_a_line_for_each_effect(capsys):
    assert main(["explain", "--analytic-normals", "off"]) == EXIT_OK
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("Wave Normals") and "off  Set to Off" in line for line in lines)


@pytest.mark.parametrize("arguments", [["--velocity", "maybe"], ["--preset", "atlantis"], ["--shutter", "-1"]])
def test_bad_input_is_one_line(capsys, arguments):
    assert main(["explain", *arguments]) == EXIT_BAD_INPUT
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


def test_a_file_s_plan_is_the_one_that_its_ocean_follows(capsys, tmp_path):
    """A sideways look from 3 m in Cycles with motion blur; the file switches off what else is an attribute."""
    import bpy

    import ocean_lod_addon

    file = tmp_path / "shot.blend"
    arguments = ["--resolution", "16x16", "--samples", "1", "--output", str(tmp_path / "one.png")]
    assert main(["render", *arguments]) == EXIT_OK
    ocean = next(ob for ob in bpy.data.objects if ob.ocean_lod.is_ocean)
    bpy.context.scene.render.use_motion_blur = True
    effects = ocean.ocean_lod.effects
    effects.analytic_normals = effects.foam = effects.ripples = "off"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    capsys.readouterr()
    plan = explained(capsys, "--blend", str(file))
    assert plan["attributes"] == ["velocity"]
    assert plan["nodes"] == ["Ocean LOD Water"]
    assert plan["effects"]["analytic_normals"] == {"on": False, "why": "Set to Off"}
    ocean_lod_addon.unregister()
