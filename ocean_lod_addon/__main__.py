# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m ocean_lod_addon`: the command line, with the bpy module."""

import os
import sys
import traceback

from .cli import EXIT_FAILED, main

if __name__ == "__main__":
    try:
        code = main(sys.argv[1:])
    except BaseException:  # noqa: BLE001 - the process ends here, and says why
        traceback.print_exc()
        code = EXIT_FAILED
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # the bpy module of Blender 4.5 can hang while the interpreter ends
