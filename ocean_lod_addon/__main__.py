# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m ocean_lod_addon`: the command line, with the bpy module."""

import os
import sys

from .cli import main

if __name__ == "__main__":
    code = main(sys.argv[1:])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # the bpy module of Blender 4.5 can hang while the interpreter ends
