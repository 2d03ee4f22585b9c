# SPDX-License-Identifier: GPL-3.0-or-later
"""The sea command: every setting can be given, what it prints is the read-back, mistakes are one line."""

import dataclasses
import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

from ocean_lod_addon.cli import EXIT_BAD_INPUT, EXIT_OK, main, parser
from ocean_lod_addon.cli.sea import sea_of
from ocean_lod_addon.core import presets
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.readback import sea_report
from ocean_lod_addon.core.sea import Sea, WaveSystem

REPOSITORY = Path(__file__).parents[2]
PNG = b"\x89PNG\r\n"

SYSTEM_OPTIONS = [
    (["--spectrum", "jonswap"], {"spectrum": "jonswap"}),
    (["--sized-by", "height"], {"sized_by": "height"}),
    (["--wind", "7.5"], {"wind_speed": 7.5}),
    (["--spectrum", "jonswap", "--fetch", "2e4"], {"spectrum": "jonswap", "fetch": 2e4}),
    (
        ["--sized-by", "height", "--significant-wave-height", "3"],
        {"sized_by": "height", "significant_wave_height": 3.0},
    ),
    (
        ["--spectrum", "two_parameter", "--sized-by", "height", "--period", "9", "--period-kind", "mean"],
        {"spectrum": "two_parameter", "sized_by": "height", "period": 9.0, "period_kind": "mean"},
    ),
    (["--spectrum", "tma", "--peak-enhancement", "5"], {"spectrum": "tma", "peak_enhancement": 5.0}),
    (["--direction", "-90"], {"direction": math.radians(-90.0)}),
    (["--spreading", "cos2s", "--spreading-exponent", "20"], {"spreading": "cos2s", "spreading_exponent": 20.0}),
    (["--directional-cutoff", "30"], {"directional_cutoff": math.radians(30.0)}),
]

SEA_OPTIONS = [
    (["--finite-depth", "--depth", "12"], {"finite_depth": True, "depth": 12.0}),
    (["--surface-tension"], {"surface_tension": True}),
    (["--choppiness", "0.5"], {"choppiness": 0.5}),
    (["--wave-count", "33"], {"wave_count": 33}),
    (["--directions", "4"], {"directions": 4}),
    (["--seed", "9"], {"seed": 9}),
    (["--loop-frames", "48"], {"loop_period": 2.0}),
    (["--loop-frames", "50", "--frames-per-second", "25", "--speed", "-3"], {"loop_period": 6.0}),
]


def parsed(*arguments):
    return sea_of(parser().parse_args(["sea", *arguments]))


@pytest.mark.parametrize(("arguments", "settings"), SYSTEM_OPTIONS)
def test_options_of_the_wave_system(arguments, settings):
    assert parsed(*arguments) == Sea((WaveSystem(**settings),))


@pytest.mark.parametrize(("arguments", "settings"), SEA_OPTIONS)
def test_options_of_the_sea(arguments, settings):
    assert parsed(*arguments) == Sea(**settings)


def test_options_change_a_preset():
    """Truth: those of a wave system the first one, those of the sea the sea, all else stays."""
    preset = presets.load("swell_crossing_wind_sea").sea
    wind, swell = preset.systems
    changed = dataclasses.replace(preset, systems=(dataclasses.replace(wind, wind_speed=15.0), swell), seed=3)
    assert parsed("--preset", "swell_crossing_wind_sea", "--wind-speed", "15", "--seed", "3") == changed


@pytest.mark.parametrize("name", ["moderate", "swell_crossing_wind_sea", "shallow_beach_approach", "beaufort_00"])
def test_json_is_the_report(name, capsys):
    assert main(["sea", "--preset", name, "--json", "--shortest-wavelength", "1.5"]) == EXIT_OK
    sea = presets.load(name).sea
    assert json.loads(capsys.readouterr().out) == sea_report(sea, discretise(sea, 1.5), 1.5).to_json()


def test_the_table_says_what_the_sea_is(capsys):
    """Truth: a fully developed sea of 10 m/s, THEORY section 3: Hs = 2.40 m, and the wind at its height."""
    assert main(["sea", "--wind", "10", "--loop-frames", "2400"]) == EXIT_OK
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["Height", "Hs", "2.40", "m", "2.40", "m"] in lines
    assert ["Beaufort", "5,", "fresh", "breeze"] in lines
    assert ["Pierson-Moskowitz", "at", "19.5", "m", "10.6", "m/s"] in lines
    assert ["SWOP", "at", "5", "m", "9.38", "m/s"] in lines
    assert any(line[:2] == ["Loop", "shift,"] for line in lines)


def test_list_names_every_preset(capsys):
    assert main(["sea", "--list"]) == EXIT_OK
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == presets.names()
    assert main(["sea", "--list", "--json"]) == EXIT_OK
    assert set(json.loads(capsys.readouterr().out)) == set(presets.names())


@pytest.mark.parametrize("name", ["moderate", "swell_crossing_wind_sea", "fetch_limited_lake"])
def test_plot(name, tmp_path, capsys):
    path = tmp_path / "sea.png"
    assert main(["sea", "--preset", name, "--loop-frames", "500", "--plot", str(path)]) == EXIT_OK
    assert path.read_bytes().startswith(PNG)
    first = path.read_bytes()
    assert main(["sea", "--preset", name, "--plot", str(path)]) == EXIT_OK
    assert path.read_bytes() != first, "the loop changes the waves that are drawn"


BAD = [
    (["--wind-speed", "99"], "'99' is not allowed, give 0 to 80 m/s"),
    (["--wind-speed", "nan"], "'nan' is not allowed, give 0 to 80 m/s"),
    (["--wind-speed", "strong"], "'strong' is not allowed, give 0 to 80 m/s"),
    (["--direction", "400"], "'400' is not allowed, give -360 to 360 degrees"),
    (["--wave-count", "1.5"], "'1.5' is not allowed, give 1 to 4096"),
    (["--spectrum", "guess"], "invalid choice: 'guess'"),
    (["--shortest-wavelength", "0"], "'0' is not allowed, give a number from 0.001 to 10000"),
    (["--frames-per-second", "0"], "'0' is not allowed"),
    (["--loop-frames", "-1"], "'-1' is not allowed, give 0 to"),
    (["--period", "8"], "--period has no effect on pierson_moskowitz sized by wind, which takes --spectrum"),
    (["--spreading-exponent", "8"], "--spreading-exponent has no effect"),
    (["--depth", "8"], "--depth has no effect without --finite-depth"),
    (["--preset", "tempest"], "unknown preset 'tempest'"),
    (["--plot", "sea.tiff"], "allowed is .png, .svg, .pdf"),
    (["--plot", "missing folder/sea.png"], "can not be written"),
    (["--wind", "0", "--plot", "sea.png"], "this sea has no waves to draw"),
]


@pytest.mark.parametrize(("arguments", "line"), BAD, ids=[" ".join(case[0]) for case in BAD])
def test_mistakes_are_one_clear_line(arguments, line, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["sea", *arguments]) == EXIT_BAD_INPUT
    printed = capsys.readouterr()
    assert printed.out == ""
    (error,) = printed.err.strip().splitlines()
    assert line in error
    assert list(tmp_path.iterdir()) == []


def run_python(script):
    return subprocess.run(
        [sys.executable, "-c", script], cwd=REPOSITORY, capture_output=True, text=True, timeout=120, check=False
    )


def test_without_matplotlib_one_line_says_so(tmp_path):
    """Truth: Blender's own Python has no matplotlib; here its import is made to fail in a process of its own."""
    path = tmp_path / "sea.png"
    done = run_python(
        "import sys; sys.modules['matplotlib'] = None; from ocean_lod_addon.cli import main;"
        f"sys.exit(main(['sea', '--plot', {str(path)!r}]))"
    )
    assert done.returncode == EXIT_BAD_INPUT
    assert done.stderr.strip().splitlines() == [
        "ocean_lod: --plot needs the Python package matplotlib, which is not installed here"
    ]
    assert not path.exists()


def test_reading_a_sea_back_needs_no_blender():
    done = run_python(
        "import sys; from ocean_lod_addon.cli import main; code = main(['sea', '--json']);"
        "sys.exit(code or 'bpy' in sys.modules)"
    )
    assert done.returncode == EXIT_OK, done.stderr
