# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the extension into dist/, with the tool that comes with Blender.

Run by an interpreter that has bpy: .env/blender-5.2/bin/python tools/extension.py
"""

import importlib.util
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def _scripts() -> Path:
    """Blender's folder of Python scripts inside the bpy module, found without loading bpy."""
    spec = importlib.util.find_spec("bpy")
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError("bpy is not installed in this interpreter")
    return next(Path(spec.origin).parent.glob("*/scripts"))


def extension_tool(*arguments: object) -> subprocess.CompletedProcess:
    """Run Blender's extension tool (what `blender --command extension` runs).

    Returns the finished process, with its output as text; the caller looks at its return code.
    """
    tool = _scripts() / "addons_core/bl_pkg/cli/blender_ext.py"
    command = [sys.executable, tool, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def valid_tags() -> Path:
    """The list of tags that Blender's extension platform accepts."""
    return _scripts() / "modules/_bpy_internal/extensions/tags.py"


def build(folder: Path) -> subprocess.CompletedProcess:
    """Build the zip of this checkout into `folder`, named after the extension and its version."""
    return extension_tool("build", "--source-dir", ROOT, "--output-dir", folder, "--valid-tags", valid_tags())


if __name__ == "__main__":
    (ROOT / "dist").mkdir(exist_ok=True)
    built = build(ROOT / "dist")
    print(built.stdout, built.stderr, sep="", end="")
    sys.exit(built.returncode)
