# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a pixel foam hides, written over `ops` for shader nodes and arrays alike.

Foam F of whitecaps is broken up by a texture q with values spread evenly over 0 to 1: white where q < F, so that
the share of white is F. Fresh foam is dense, old foam thin: what is white hides the water to the degree F. Uniform
foam far away has neither texture nor age; whitecaps of all ages hide EFFECTIVE_SHARE of what they cover.
"""

from .whitecap_law import EFFECTIVE_SHARE

NOISE_MEAN, NOISE_DEVIATION = 0.5, 0.082
"""Of Blender's normalised noise with the detail and roughness that the foam's texture has."""

NOISE_DETAIL, NOISE_ROUGHNESS = 6.0, 0.6

_DENSEST = 0.9
"""White share of the freshest foam: it has holes, too."""

_SOFT_EDGE = 0.2
"""Values of q over which an edge of foam fades; less in thin foam, so that bare water stays bare."""

_MELTING = 3.0
"""Times the size of a pixel over the texture's grain: how far the pattern has melted into its mean."""

_SMALLEST_WIDTH = 1e-4
"""Keeps a quotient finite where there is no foam."""

_SMALLEST_FADE = 1e-3
"""Keeps a quotient finite where there are no whitecaps."""


def filaments(ops, noise):
    """q: the distance of a noise from its mean as the share of noise that is nearer to it.

    Contour lines of a noise make a web that thins out evenly. The share is erf(z / sqrt(2)) for z deviations,
    here tanh(0.85 z), within 0.02.
    """
    z = ops.absolute(noise - NOISE_MEAN) * (1.0 / NOISE_DEVIATION)
    e = ops.exp(z * -1.7)
    return (1.0 - e) / (1.0 + e)


def white_share(ops, foam, texture, pixel_over_grain):
    """Share of the pixel that is white: a softened step where the texture falls below the foam's share."""
    share = ops.label(foam * _DENSEST, "white share")
    width = ops.maximum(ops.minimum(share * 2.0, _SOFT_EDGE), _SMALLEST_WIDTH)
    step = ops.minimum(ops.maximum((share - texture) / width + 0.5, 0.0), 1.0)
    melted = ops.minimum(pixel_over_grain * _MELTING, 1.0)
    return ops.multiply_add(share - step, melted, step)


def hidden_share(ops, foam, whitecaps, coverage, texture, pixel_over_grain):
    """Share of the light from the water that foam replaces.

    foam        attribute: whitecaps F + (1 - whitecaps) coverage
    whitecaps   attribute: how much of it is whitecaps
    coverage    share of the whole sea that is white
    """
    uniform = (1.0 - whitecaps) * coverage
    own = ops.maximum(foam - uniform, 0.0) / ops.maximum(whitecaps, _SMALLEST_FADE)
    own = ops.label(ops.minimum(own, 1.0), "foam of whitecaps")
    broken = own * white_share(ops, own, texture, pixel_over_grain)
    return ops.multiply_add(broken, whitecaps, uniform * EFFECTIVE_SHARE)
