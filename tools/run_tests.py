# SPDX-License-Identifier: GPL-3.0-or-later
"""Run pytest with the given arguments and end the process at once.

Blender 4.5 as a Python module can hang while the interpreter shuts down, after all tests have passed.
"""

import os
import sys

import pytest

exit_code = pytest.main(sys.argv[1:])
sys.stdout.flush()
sys.stderr.flush()
os._exit(exit_code)
