# SPDX-License-Identifier: GPL-3.0-or-later
"""The render command as a user runs it: a process, its exit code, what it prints and what it leaves behind."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

REPOSITORY = Path(__file__).parents[2]
BAD_INPUT = 2
TINY = ["--resolution", "32x18", "--samples", "1"]


def run(*arguments, cwd=None):
    """One run of the program."""
    return subprocess.run(
        [sys.executable, "-m", "ocean_lod_addon", *map(str, arguments)],
        cwd=cwd or REPOSITORY,
        env=os.environ | {"PYTHONPATH": str(REPOSITORY)},
        capture_output=True,
        text=True,
        timeout=300,
    )


def preset_with(tmp_path, **sea):
    path = tmp_path / "mine.json"
    path.write_text(json.dumps({"schema_version": 1, "sea": sea}))
    return path


@pytest.mark.render
def test_still_and_saved_scene(tmp_path):
    still, blend = tmp_path / "still.png", tmp_path / "scene.blend"
    done = run("render", "--preset", "calm", *TINY, "--output", still, "--save-blend", blend)
    assert done.returncode == 0, done.stderr
    assert still.read_bytes().startswith(b"\x89PNG")
    assert "(1 of 1)" in done.stdout
    assert blend.is_file()
    again = run("render", "--blend", blend, "--frames", "2:6:2", "--output", tmp_path / "seq.exr")
    assert again.returncode == 0, again.stderr
    assert sorted(path.name for path in tmp_path.glob("seq_*")) == ["seq_0002.exr", "seq_0004.exr", "seq_0006.exr"]
    assert "(3 of 3)" in again.stdout
    assert "left" in again.stdout


@pytest.mark.render
def test_film(tmp_path):
    film = tmp_path / "film.mp4"
    done = run("render", "--preset", "calm", *TINY, "--frames", "1:2", "--output", film)
    assert done.returncode == 0, done.stderr
    assert b"ftyp" in film.read_bytes()[:32]


@pytest.mark.render
def test_seed_changes_the_sea_and_nothing_else_does(tmp_path):
    pictures = {}
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        output = tmp_path / f"{name}.exr"
        done = run("render", "--preset", "moderate", *TINY, "--seed", seed, "--output", output)
        assert done.returncode == 0, done.stderr
        pictures[name] = _pixels(output)
    assert (pictures["a"] == pictures["b"]).all()
    assert not (pictures["a"] == pictures["c"]).all()


@pytest.mark.render
def test_a_frame_of_an_animation_is_the_frame_alone(tmp_path):
    """Truth: what Cycles keeps from frame to frame changes no bit of a picture, ripples included."""
    for frames, name in (("1:3", "film.exr"), ("3", "alone.exr")):
        done = run("render", "--preset", "moderate", *TINY, "--frames", frames, "--output", tmp_path / name)
        assert done.returncode == 0, done.stderr
    first, third = (_pixels(tmp_path / f"film_000{frame}.exr") for frame in (1, 3))
    assert (third == _pixels(tmp_path / "alone.exr")).all()
    assert not (third == first).all()


@pytest.mark.render
def test_denoising_smooths_the_noise_away_and_keeps_the_light(tmp_path):
    pictures = {}
    for name, option in (("noisy", []), ("clean", ["--denoise"])):
        arguments = ["--resolution", "64x36", "--samples", "1", *option, "--output", tmp_path / f"{name}.exr"]
        done = run("render", "--preset", "moderate", *arguments)
        assert done.returncode == 0, done.stderr
        pictures[name] = _pixels(tmp_path / f"{name}.exr")[:18, :, 1]  # the sea
    noise = {name: np.abs(np.diff(np.log(picture + 1e-3), axis=1)).mean() for name, picture in pictures.items()}
    assert noise["clean"] < 0.5 * noise["noisy"]
    assert pictures["clean"].mean() == pytest.approx(pictures["noisy"].mean(), rel=0.2)


def _pixels(path):
    from tests.render.exr import read_pixels

    return read_pixels(path)


BAD_ARGUMENTS = [
    (["--preset", "tempest"], "unknown preset 'tempest', allowed is one of"),
    (["--engine", "WORKBENCH"], "'WORKBENCH'"),
    (["--frames", "9:1"], "first <= last"),
    (["--frames", "one"], "is not A, A:B or A:B:STEP"),
    (["--frames", "1:9:0"], "the step is 0, allowed is 1 or more"),
    (["--resolution", "960"], "is not WIDTHxHEIGHT"),
    (["--resolution", "0x10"], "allowed is 4 to 65536 pixels"),
    (["--samples", "0"], "give a whole number from 1 to"),
    (["--seed", "-1"], "give a whole number from 0 to"),
    (["--output", "picture.tiff"], "allowed is .png, .exr, .mp4"),
    (["--output", "/proc/nowhere/picture.png"], "its folder can not be written to"),
    (["--blend", "nowhere.blend"], "there is no such file"),
    (["--preset", "calm", "--blend", "x.blend"], "not allowed with argument"),
]


@pytest.mark.parametrize(("arguments", "line"), BAD_ARGUMENTS, ids=[" ".join(case[0]) for case in BAD_ARGUMENTS])
def test_bad_arguments_give_one_clear_line(arguments, line, tmp_path):
    if "--output" not in arguments:
        arguments = [*arguments, "--output", str(tmp_path / "picture.png")]
    assert_one_line_error(run("render", *arguments, cwd=tmp_path), line)
    assert list(tmp_path.iterdir()) == [], "something half-written was left behind"


def assert_one_line_error(done, line):
    assert done.returncode == BAD_INPUT
    errors = done.stderr.strip().splitlines()
    assert len(errors) == 1, done.stderr
    assert line in errors[0]


SYSTEM = {"spectrum": "pierson_moskowitz"}
BAD_PRESETS = [
    ({"systems": [SYSTEM | {"wind_speed_m_s": -1}]}, "systems[0]: wind_speed_m_s is -1, allowed is 0 to 80 m/s"),
    ({"systems": [SYSTEM | {"wind_speed_m_s": 81}]}, "wind_speed_m_s is 81, allowed is 0 to 80 m/s"),
    ({"systems": [SYSTEM | {"wind_speed_m_s": float("nan")}]}, "wind_speed_m_s is nan, allowed is 0 to 80 m/s"),
    ({"systems": [SYSTEM | {"wind_speed_m_s": "strong"}]}, "wind_speed_m_s is 'strong', allowed is 0 to 80 m/s"),
    ({"systems": [SYSTEM | {"wind_speed_m_s": True}]}, "wind_speed_m_s is True, allowed is 0 to 80 m/s"),
    ({"systems": [{"spectrum": "guess"}]}, "spectrum is 'guess', allowed is one of"),
    ({"systems": [{"wind": 3}]}, "unknown key 'wind', allowed is"),
    ({"systems": []}, "systems is [], allowed is a list of one or more"),
    ({"systems": 3}, "systems is 3, allowed is a list"),
    ({"wave_count": 0}, "wave_count is 0, allowed is 1 to 4096"),
    ({"wave_count": 10.5}, "wave_count is 10.5, allowed is 1 to 4096"),
    ({"depth_m": 0}, "depth_m is 0, allowed is 0.05 to"),
]


@pytest.mark.parametrize(("sea", "line"), BAD_PRESETS, ids=[case[1] for case in BAD_PRESETS])
def test_bad_presets_name_file_key_value_and_range(sea, line, tmp_path):
    from ocean_lod_addon.core import presets
    from ocean_lod_addon.core.errors import OceanError

    path = preset_with(tmp_path, **sea)
    with pytest.raises(OceanError) as caught:
        presets.read(path)
    assert str(caught.value).startswith("mine.json: sea")
    assert line in str(caught.value)


def test_a_bad_preset_stops_the_command_before_anything_is_written(tmp_path):
    path = preset_with(tmp_path, wave_count=0)
    done = run("render", "--preset", path, "--output", tmp_path / "picture.png")
    assert_one_line_error(done, "mine.json: sea: wave_count is 0, allowed is 1 to 4096")
    assert not (tmp_path / "picture.png").exists()


@pytest.mark.parametrize("content", ["", "[]", "{", '{"schema_version": 99}', '{"schema_version": 1, "see": {}}'])
def test_files_that_are_no_presets_are_refused(content, tmp_path):
    path = tmp_path / "mine.json"
    path.write_text(content)
    done = run("render", "--preset", path, "--output", tmp_path / "picture.png")
    assert_one_line_error(done, "mine.json: ")


def test_a_file_without_an_ocean_or_a_camera_is_refused(tmp_path):
    script = (
        "import bpy, os; bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True);"
        f"bpy.ops.wm.save_as_mainfile(filepath={str(tmp_path / 'empty.blend')!r}); os._exit(0)"
    )
    subprocess.run([sys.executable, "-c", script], check=True, timeout=120, capture_output=True)
    done = run("render", "--blend", tmp_path / "empty.blend", "--output", tmp_path / "picture.png")
    assert_one_line_error(done, "has no ocean")
    (tmp_path / "broken.blend").write_bytes(b"not a blend file")
    done = run("render", "--blend", tmp_path / "broken.blend", "--output", tmp_path / "picture.png")
    assert_one_line_error(done, "broken.blend")
    assert not (tmp_path / "picture.png").exists()
