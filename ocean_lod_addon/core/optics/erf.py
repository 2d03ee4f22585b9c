# SPDX-License-Identifier: GPL-3.0-or-later
"""The error function, which neither NumPy nor a shader's math nodes have.

`erfc` and `erfcx` are exact to float64. What a shader can afford is `erfc_eq19` and, better and as cheap, the
Abramowitz-Stegun polynomial inside `smith.masked_area`.
"""

import math

import numpy as np

_STEP = 0.5
_NODES = (np.arange(13) + 0.5) * _STEP
_POLE_LIMIT = math.pi / _STEP
_LARGEST = 1e150
"""Beyond it x^2 would overflow; erfcx is 1/(x sqrt(pi)) there to every digit."""


def erfcx(x) -> np.ndarray:
    """exp(x^2) erfc(x) for x >= 0 (any shape, infinity included), to a few ulp, as float64.

    Trapezoidal rule for (x/pi) int exp(-y^2)/(y^2 + x^2) dy at half-integer multiples of the step h; the pole
    at y = i x adds 2 exp(x^2)/(1 + exp(2 pi x/h)) while x < pi/h. The error of the rule is exp(-pi^2/h^2),
    7e-18 for h = 1/2, and no term is negative, so nothing cancels.
    """
    x = np.minimum(np.asarray(x, dtype=np.float64), _LARGEST)
    squares = _NODES**2
    terms = np.exp(-squares) / (squares + np.square(x)[..., np.newaxis])
    near = np.minimum(x, _POLE_LIMIT)
    pole = 2.0 * np.exp(near**2) / (1.0 + np.exp(2.0 * np.pi * near / _STEP))
    return 2.0 * _STEP / np.pi * x * terms.sum(axis=-1) + np.where(x < _POLE_LIMIT, pole, 0.0)


def erfc(x) -> np.ndarray:
    """The complementary error function for any real x (any shape), relative error below 1e-15 (1 + x^2)."""
    x = np.asarray(x, dtype=np.float64)
    size = np.minimum(np.abs(x), _LARGEST)
    tail = np.exp(-(size**2)) * erfcx(size)
    return np.where(x < 0.0, 2.0 - tail, tail)


def erfc_eq19(ops, x):
    """The paper's erfc for x >= 0 (Eq. 19), 2 exp(-x^2)/(2.319 x + sqrt(4 + 1.52 x^2)), within 0.28 %."""
    return 2.0 * ops.exp(-(x * x)) / (2.319 * x + ops.sqrt(4.0 + 1.52 * x * x))
