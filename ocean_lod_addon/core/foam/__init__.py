# SPDX-License-Identifier: GPL-3.0-or-later
"""Whitecaps: where waves break, how much foam the wind makes of them, and how long it stays.

Foam is where the water was compressed. To first order in the steepness the Jacobian of the surface is

    J = 1 - c,    c = sum k A cos(psi)      (for circular orbits; psi the phase of a wave)

and c is also the downward acceleration of the water in units of g, by which crests break. c is looked at at past
instants of the same water, since the undisturbed position is what water keeps as it moves: foam made there then is
carried here now. A frame needs no other frame for that.
"""
