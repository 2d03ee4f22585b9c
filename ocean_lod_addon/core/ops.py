# SPDX-License-Identifier: GPL-3.0-or-later
"""The operations that shader formulas are written over.

A formula takes `ops` as its first argument and uses the operators + - * / on its values and the functions
below. `NumpyOps` evaluates it on arrays; `nodes.graph.GraphOps` emits the same formula as shader nodes, so
the reference and the shader cannot drift apart. Only what a shader's math nodes can do is here: no erf.
"""

from typing import Any, Protocol

import numpy as np


class Ops(Protocol):
    """What a shader formula may use. Values are scalars per shading point, or per array element."""

    def constant(self, value: float) -> Any: ...
    def multiply_add(self, a, b, c) -> Any:
        """a b + c, one math node."""

    def sqrt(self, a) -> Any: ...
    def exp(self, a) -> Any: ...
    def absolute(self, a) -> Any: ...
    def minimum(self, a, b) -> Any: ...
    def maximum(self, a, b) -> Any: ...
    def power(self, base, exponent) -> Any: ...
    def less_than(self, a, b) -> Any:
        """1 where a < b, else 0."""

    def where(self, condition, if_true, if_false) -> Any:
        """if_true where condition is 1, if_false where it is 0; both are evaluated: both must be finite."""

    def label(self, value, name: str) -> Any:
        """The value itself, named for whoever reads the node tree."""

    def vector(self, x, y, z) -> Any:
        """The vector (x, y, z): on arrays, the first axis counts x, y, z."""

    def dot(self, a, b) -> Any:
        """The scalar a . b of two vectors."""


class NumpyOps:
    """`Ops` on NumPy arrays, in the precision of `dtype`."""

    def __init__(self, dtype=np.float64):
        self.dtype = np.dtype(dtype)

    def constant(self, value):
        return self.dtype.type(value)

    def multiply_add(self, a, b, c):
        return a * b + c

    def sqrt(self, a):
        return np.sqrt(a)

    def exp(self, a):
        return np.exp(a)

    def absolute(self, a):
        return np.abs(a)

    def minimum(self, a, b):
        return np.minimum(a, b)

    def maximum(self, a, b):
        return np.maximum(a, b)

    def power(self, base, exponent):
        return np.power(base, exponent)

    def less_than(self, a, b):
        return np.less(a, b).astype(self.dtype)

    def where(self, condition, if_true, if_false):
        return np.where(np.asarray(condition) > 0.5, if_true, if_false).astype(self.dtype, copy=False)

    def label(self, value, name):
        return value

    def vector(self, x, y, z):
        return np.stack(np.broadcast_arrays(x, y, z)).astype(self.dtype, copy=False)

    def dot(self, a, b):
        return (a * b).sum(axis=0)
