# SPDX-License-Identifier: GPL-3.0-or-later
"""The physics of the sea: NumPy and the standard library only, never bpy."""
