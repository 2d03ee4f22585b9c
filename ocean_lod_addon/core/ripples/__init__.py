# SPDX-License-Identifier: GPL-3.0-or-later
"""The bump level: waves between the mesh and the BRDF, as slopes.

spectrum    which slopes: the sea's own directional spectrum, brought to the slope variance that the wind makes
layout      into which bands of wavelengths it is cut, and which two bands share an image
synthesis   an image of slopes at a time, by inverse FFT
handover    what each vertex leaves to the bump, and what to the BRDF
bump        all of that for one ocean
shading     the formulas that the shader shares with NumPy: fading by pixel footprint, visible slopes, the normal
budget      how much slope variance each level shows at a distance
"""
