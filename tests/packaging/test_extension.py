# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension as a user gets it: built, checked and installed by Blender's own tool, and used from there."""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import bpy
import numpy as np
import pytest

from tools.extension import ROOT, build, extension_tool, valid_tags

# Everything that a user needs and nothing else: no tests, no tools, no caches.
SHIPPED = re.compile(
    r"blender_manifest\.toml|__init__\.py|LICENSE|presets/\w+\.json|ocean_lod_addon/(\w+/)*\w+\.py"
)


def validate(path: Path) -> None:
    checked = extension_tool("validate", "--valid-tags", valid_tags(), path)
    assert checked.returncode == 0, checked.stdout + checked.stderr


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("dist")
    built = build(folder)
    assert built.returncode == 0, built.stdout + built.stderr
    return next(folder.glob("ocean_lod-*.zip"))


@pytest.fixture(scope="module")
def resources(archive: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of Blender's user resources in which nothing but the extension is installed."""
    folder = tmp_path_factory.mktemp("resources")
    repository = folder / "extensions/user_default"
    repository.mkdir(parents=True)
    installed = extension_tool("install-files", "--local-dir", repository, archive)
    assert installed.returncode == 0, installed.stdout + installed.stderr
    assert (repository / "ocean_lod/blender_manifest.toml").exists()
    return folder


def run_installed(resources: Path, *arguments: object) -> None:
    """Run tests/packaging/installed_extension.py away from the checkout, in a Blender of its own."""
    script = Path(__file__).with_name("installed_extension.py")
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(resources)}
    environment.pop("PYTHONPATH", None)
    done = subprocess.run(
        [sys.executable, script, *map(str, arguments)],
        cwd=resources,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    assert "Traceback" not in done.stdout, done.stdout  # Blender prints, and does not pass on, an add-on's errors


def pixels_of(path: Path) -> np.ndarray:
    """The picture as an array of shape (height, width, 4), bottom row first."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def test_source_tree_validates():
    validate(ROOT)


def test_archive_validates(archive: Path):
    validate(archive)


def test_archive_holds_what_a_user_needs_and_nothing_else(archive: Path):
    names = {name for name in zipfile.ZipFile(archive).namelist() if not name.endswith("/")}
    assert {"blender_manifest.toml", "__init__.py", "LICENSE", "ocean_lod_addon/__init__.py"} <= names
    assert {f"presets/{path.name}" for path in (ROOT / "presets").glob("*.json")} <= names
    assert any(name.startswith("presets/") for name in names)
    assert [name for name in names if not SHIPPED.fullmatch(name)] == []


def test_installed_extension_can_be_enabled_and_disabled_again(resources: Path):
    run_installed(resources, "toggle")


@pytest.mark.render
def test_installed_extension_renders_an_ocean(resources: Path, tmp_path: Path):
    run_installed(resources, "render", tmp_path / "sea.png", tmp_path / "empty.png")
    sea, empty = pixels_of(tmp_path / "sea.png"), pixels_of(tmp_path / "empty.png")
    assert sea.shape == empty.shape == (36, 64, 4)
    # The lower third looks down at the water: there it differs from the view without it, and waves vary it.
    assert np.all(np.any(sea[:12] != empty[:12], axis=2))
    assert np.all(sea[:12].std(axis=1)[:, :3] > 0.0)
