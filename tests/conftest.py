# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps the tests away from the user's own Blender: its settings and extensions live in a temporary folder."""

import os
import shutil
import tempfile

# Before anything imports bpy, which reads these variables once.
for variable in ("CONFIG", "SCRIPTS", "EXTENSIONS", "DATAFILES"):
    os.environ.pop(f"BLENDER_USER_{variable}", None)
os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="ocean_lod_tests_")


def pytest_unconfigure() -> None:
    """The process ends without running exit handlers (tools/run_tests.py), so the folder goes here."""
    shutil.rmtree(os.environ["BLENDER_USER_RESOURCES"], ignore_errors=True)
