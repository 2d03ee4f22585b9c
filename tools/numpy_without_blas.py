# SPDX-License-Identifier: GPL-3.0-or-later
"""Make .env/numpy-without-blas: Blender as in .env/blender-5.2, but with a NumPy that was built without a BLAS.

    .env/blender-5.2/bin/python tools/numpy_without_blas.py

Some builds of Blender come with such a NumPy. `make bench-without-blas` measures with it. NumPy is compiled from
source, which needs a C and a C++ compiler and takes some minutes.
"""

import importlib.metadata
import subprocess
import sys
import sysconfig
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / ".env" / "numpy-without-blas"
PYTHON = FOLDER / "bin" / "python"

BUILD_SETTINGS = ("-Dblas=none", "-Dlapack=none", "-Dallow-noblas=true")


def main():
    """Make the environment unless it is complete, and share everything but NumPy with this interpreter's."""
    version = importlib.metadata.version("numpy")
    stamp = FOLDER / "complete"
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == version:
        return
    print(f"Compiling NumPy {version} without BLAS; this takes some minutes", flush=True)
    subprocess.run([sys.executable, "-m", "venv", "--clear", FOLDER], check=True)
    settings = [f"--config-settings=setup-args={setting}" for setting in BUILD_SETTINGS]
    # No cache: pip would take a NumPy that was built with other settings from it.
    pip_install = [PYTHON, "-m", "pip", "install", "--no-cache-dir"]
    subprocess.run([*pip_install, "--no-binary=numpy", *settings, f"numpy=={version}"], check=True)
    own = Path(sysconfig.get_path("purelib", vars={"base": FOLDER, "platbase": FOLDER}))
    # Found after the environment's own packages, so that its NumPy is the one in use.
    (own / "everything_else.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    stamp.write_text(version, encoding="utf-8")


if __name__ == "__main__":
    main()
