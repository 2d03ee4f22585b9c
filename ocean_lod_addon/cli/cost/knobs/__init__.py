# SPDX-License-Identifier: GPL-3.0-or-later
"""The accuracy knobs: for each choice between exact and cheap, what its steps cost and what they get wrong.

knob            what a knob is
geometry        waves, mesh density, windows, precision
waves           how a spectrum becomes a set of waves
ripples         the bump
foam            the memory of foam
shading         Fresnel, masking, slope densities
misprints       the equations as printed
in_blender      what only Blender can measure
registry        all of them
"""
