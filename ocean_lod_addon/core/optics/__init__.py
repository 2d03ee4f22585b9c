# SPDX-License-Identifier: GPL-3.0-or-later
"""How the sea reflects light: slope statistics, masking, Fresnel and the Ross BRDF.

Formulas that shading uses take `ops` first and run on arrays and as shader nodes alike; a vector is a tuple of
its components (x, y, z) in axes with z up and x along the wind (downwind). Functions without `ops` are NumPy
references.
"""
