# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/environment.py: which interpreter it takes, when it starts afresh, and what it says is missing."""

import os
import sys
from pathlib import Path

import pytest

from tools import environment

VERSION = "{}.{}".format(*sys.version_info[:2])
FORWARD = f'#!/bin/sh\nexec "{sys.executable}" "$@"\n'
BROKEN_SHIM = "#!/bin/sh\necho command not found >&2\nexit 127\n"


def put_program(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)
    return path


@pytest.fixture
def search_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """A PATH of two empty folders, on a machine where no manager keeps anything."""
    folders = [tmp_path / "first", tmp_path / "second"]
    monkeypatch.setenv("PATH", os.pathsep.join(map(str, folders)))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in ("PYENV_ROOT", "XDG_DATA_HOME", "UV_PYTHON_INSTALL_DIR"):
        monkeypatch.setenv(name, str(tmp_path / name))
    return folders


def test_shim_that_does_not_run_is_passed_over(search_path: list[Path]):
    put_program(search_path[0] / f"python{VERSION}", BROKEN_SHIM)
    put_program(search_path[1] / f"python{VERSION}", FORWARD)
    found = environment.find_interpreter(VERSION)
    assert found is not None
    assert os.path.samefile(found, sys.executable)  # the interpreter behind the shim, not the shim


def test_interpreter_of_another_version_is_passed_over(search_path: list[Path]):
    other = put_program(search_path[0] / "python3.999", FORWARD)
    assert environment.working_interpreter(str(other), VERSION) is not None
    assert environment.working_interpreter(str(other), "3.999") is None


@pytest.mark.parametrize(
    ("manager", "folder"),
    [
        ("PYENV_ROOT", f"versions/{VERSION}.%d/bin"),
        ("UV_PYTHON_INSTALL_DIR", f"cpython-{VERSION}.%d-linux-x86_64-gnu/bin"),
    ],
)
def test_managers_folders_are_searched_newest_first(search_path, tmp_path, manager: str, folder: str):
    programs = [
        put_program(tmp_path / manager / (folder % patch) / f"python{VERSION}", FORWARD) for patch in (9, 10)
    ]
    candidates = [Path(candidate) for candidate in environment.interpreter_candidates(VERSION)]
    assert [candidate for candidate in candidates if candidate in programs] == programs[::-1]


def test_environment_is_complete_only_with_its_stamp_and_a_working_interpreter(tmp_path: Path):
    python = put_program(tmp_path / "bin/python", FORWARD)
    assert not environment.is_complete(tmp_path, VERSION, "new")  # interrupted
    (tmp_path / "complete").write_text("old", encoding="utf-8")
    assert not environment.is_complete(tmp_path, VERSION, "new")  # other requirements
    (tmp_path / "complete").write_text("new", encoding="utf-8")
    assert environment.is_complete(tmp_path, VERSION, "new")
    put_program(python, BROKEN_SHIM)
    assert not environment.is_complete(tmp_path, VERSION, "new")  # its base interpreter was removed
    python.unlink()
    assert not environment.is_complete(tmp_path, VERSION, "new")


def test_included_requirements_count(tmp_path: Path):
    (tmp_path / "outer.txt").write_text("-r inner.txt\nbpy\n", encoding="utf-8")
    (tmp_path / "inner.txt").write_text("pytest==1\n", encoding="utf-8")
    before = environment.requirements_text(tmp_path / "outer.txt")
    (tmp_path / "inner.txt").write_text("pytest==2\n", encoding="utf-8")
    assert environment.requirements_text(tmp_path / "outer.txt") != before


def test_every_environment_has_requirements():
    for name in environment.PYTHON_VERSIONS:
        assert (environment.ROOT / "tools" / f"requirements-{name}.txt").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere bpy brings what it links to")
def test_missing_system_library_is_named_with_its_package(monkeypatch: pytest.MonkeyPatch):
    environment.check_system_libraries(sys.executable)  # this Blender runs, so nothing is missing
    monkeypatch.setitem(environment.SYSTEM_LIBRARIES, "libNoSuch.so.1", ("libnosuch1", "nosuch"))
    with pytest.raises(environment.SetupError) as raised:
        environment.check_system_libraries(sys.executable)
    lines = str(raised.value).splitlines()
    assert "lacks: libNoSuch.so.1. Install" in lines[0]
    assert lines[1].split() == ["apt", "install", "libnosuch1", "(Debian,", "Ubuntu)"]
    assert lines[2].split() == ["dnf", "install", "nosuch", "(Fedora)"]
