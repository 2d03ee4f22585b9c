# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees written as arithmetic.

A `Graph` fills one shader node tree. Its values carry the operators + - * /, so that a formula reads like
the equation it implements, and each operation becomes one node:

- numbers are plain floats: an operation on numbers alone is done in Python and leaves no node, nor does
  x + 0, x * 1 or x / 1;
- the same operation on the same values is emitted once, however often the formula states it;
- `section` puts the nodes made inside it into a named frame, with group inputs of its own;
- everything gets a name that depends on the order of building alone: two builds give the same tree.

Cycles runs nodes in the order they are made in, and has room for 255 numbers that wait for their last use. It
converts between numbers, vectors and colours only after all nodes that need no conversion, which keeps what they
made waiting: take a colour apart by its `components`, and let * alone combine a number with a vector.

`GraphOps` is `core.ops.Ops` on a graph, for the formulas that NumPy evaluates as well;
`groups.ensure_group` decides when a tree is built.
"""

import math
from contextlib import contextmanager
from dataclasses import dataclass

COMMUTATIVE = frozenset({"ADD", "MULTIPLY", "MINIMUM", "MAXIMUM", "DOT_PRODUCT"})

MIX_FACTOR, MIX_FLOAT_A, MIX_FLOAT_B = 0, 2, 3
"""Socket numbers of a Mix node that mixes floats; its sockets share names between data types."""


@dataclass(frozen=True, eq=False)
class Value:
    """An output socket of a node, or an input of the group; `key` identifies it within its graph."""

    graph: "Graph"
    key: tuple


class Scalar(Value):
    """A number per shading point."""

    def __add__(self, other):
        return self.graph.math("ADD", self, other)

    def __radd__(self, other):
        return self.graph.math("ADD", other, self)

    def __sub__(self, other):
        return self.graph.math("SUBTRACT", self, other)

    def __rsub__(self, other):
        return self.graph.math("SUBTRACT", other, self)

    def __mul__(self, other):
        return self.graph.math("MULTIPLY", self, other)

    def __rmul__(self, other):
        return self.graph.math("MULTIPLY", other, self)

    def __truediv__(self, other):
        return self.graph.math("DIVIDE", self, other)

    def __rtruediv__(self, other):
        return self.graph.math("DIVIDE", other, self)

    def __neg__(self):
        return self.graph.math("MULTIPLY", self, -1.0)


class Vector(Value):
    """Three numbers per shading point; * and / take a scalar, + and - another vector."""

    def __add__(self, other):
        return self.graph.vector_math("ADD", self, other)

    def __sub__(self, other):
        return self.graph.vector_math("SUBTRACT", self, other)

    def __mul__(self, factor):
        return self.graph.vector_math("SCALE", self, scale=factor)

    __rmul__ = __mul__

    def __truediv__(self, divisor):
        return self * (1.0 / divisor)

    def dot(self, other) -> Scalar:
        return self.graph.vector_math("DOT_PRODUCT", self, other)

    def cross(self, other) -> "Vector":
        return self.graph.vector_math("CROSS_PRODUCT", self, other)

    def length(self) -> Scalar:
        return self.graph.vector_math("LENGTH", self)

    def normalized(self) -> "Vector":
        return self.graph.vector_math("NORMALIZE", self)

    def times(self, other) -> "Vector":
        """The product component by component."""
        return self.graph.vector_math("MULTIPLY", self, other)

    def components(self) -> tuple[Scalar, Scalar, Scalar]:
        return self.graph.components(self)


class Color(Vector):
    """A linear RGB colour."""


class Shader(Value):
    """A closure."""


_ENDS = frozenset({"NodeGroupOutput", "ShaderNodeOutputMaterial"})
"""Nodes that exist for what they receive."""

_VALUE_TYPES = {"VALUE": Scalar, "INT": Scalar, "VECTOR": Vector, "RGBA": Color, "SHADER": Shader}
_INPUT_TYPES = {"FLOAT": Scalar, "VECTOR": Vector, "COLOR": Color, "SHADER": Shader}

_FOLDED = {
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "DIVIDE": lambda a, b: a / b,
    "POWER": lambda a, b: a**b,
    "SQRT": math.sqrt,
    "EXPONENT": math.exp,
    "ABSOLUTE": abs,
    "MINIMUM": min,
    "MAXIMUM": max,
    "LESS_THAN": lambda a, b: float(a < b),
}


def _is(value, number) -> bool:
    return is_number(value) and value == number


def is_number(value) -> bool:
    """Whether a value is known while building."""
    return not isinstance(value, Value)


class Graph:
    """Fills `tree`, which must be empty of nodes and have its sockets already."""

    def __init__(self, tree):
        self.tree = tree
        self._sockets = {}
        self._emitted = {}
        self._frame_title = None
        self._frames = {}
        self._group_inputs = {}
        self._input_types = {}
        self._group_output = None

    # Sections

    @contextmanager
    def section(self, title: str):
        """Nodes made inside go into a frame called `title`. Sections do not nest and are not reopened."""
        if self._frame_title is not None or title in self._frames:
            raise RuntimeError(f"section {title!r} opened inside {self._frame_title!r} or twice")
        self._frame_title = title
        self._frames[title] = None
        yield self
        self._frame_title = None

    def _enter_frame(self, node):
        if self._frame_title is None:
            return
        frame = self._frames[self._frame_title]
        if frame is None:
            frame = self.tree.nodes.new("NodeFrame")
            frame.name = frame.label = self._frame_title
            self._frames[self._frame_title] = frame
        node.parent = frame

    # Nodes and links

    def node(self, node_type: str, label: str = "", inputs: dict | None = None, **properties):
        """A new node of `node_type` with its properties set and its inputs, by name or number, connected."""
        node = self.tree.nodes.new(node_type)
        node.label = label
        self._enter_frame(node)
        for name, value in properties.items():
            setattr(node, name, value)
        for socket, value in (inputs or {}).items():
            self.connect(value, node.inputs[socket])
        return node

    def output_of(self, node, socket=0) -> Value:
        """The value of an output socket, by name or number, of a node."""
        socket = node.outputs[socket]
        key = (node.name, socket.identifier)
        self._sockets[key] = socket
        return _VALUE_TYPES[socket.type](self, key)

    def connect(self, value, socket):
        """Link a value to an input socket, or store a number (or a tuple of numbers) in it."""
        if is_number(value):
            socket.default_value = value
        else:
            self.tree.links.new(self._socket_of(value), socket)

    def _socket_of(self, value):
        if value.key[0] is not None:
            return self._sockets[value.key]
        return self._group_input_node().outputs[value.key[1]]

    def _node_of(self, value):
        return None if value.key[0] is None else self.tree.nodes[value.key[0]]

    def _once(self, key, make) -> Value:
        if key not in self._emitted:
            self._emitted[key] = make()
        return self._emitted[key]

    # The group's own sockets

    def declare_input(self, name: str, kind: str):
        """Make known an input of the group, which `input` can then be asked for."""
        self._input_types[name] = _INPUT_TYPES[kind]

    def input(self, name: str) -> Value:
        """The group's input called `name`."""
        return self._input_types[name](self, (None, name))

    def output(self, name: str, value):
        """Give the group's output called `name` its value."""
        if self._group_output is None:
            self._group_output = self.tree.nodes.new("NodeGroupOutput")
        self.connect(value, self._group_output.inputs[name])

    def _group_input_node(self):
        title = self._frame_title
        if title not in self._group_inputs:
            node = self.tree.nodes.new("NodeGroupInput")
            self._enter_frame(node)
            self._group_inputs[title] = node
        return self._group_inputs[title]

    def finish(self):
        """Drop what no output uses, show only the linked sockets of Group Inputs, leave nothing selected."""
        self._remove_unused_nodes()
        for node in self.tree.nodes:
            node.select = False
            if node.bl_idname == "NodeGroupInput":
                for socket in node.outputs:
                    socket.hide = not socket.is_linked

    def _remove_unused_nodes(self):
        sources = {}
        for link in self.tree.links:
            sources.setdefault(link.to_node.name, []).append(link.from_node.name)
        used = set()
        waiting = [node.name for node in self.tree.nodes if node.bl_idname in _ENDS]
        while waiting:
            name = waiting.pop()
            if name not in used:
                used.add(name)
                waiting.extend(sources.get(name, ()))
        used |= {self.tree.nodes[name].parent.name for name in used if self.tree.nodes[name].parent}
        for node in [node for node in self.tree.nodes if node.name not in used]:
            self.tree.nodes.remove(node)

    # Arithmetic

    def math(self, operation: str, *operands):
        """One Math node, or the number it would give where the operands are numbers."""
        if all(map(is_number, operands)):
            return float(_FOLDED[operation](*operands))
        unchanged = _unchanged_operand(operation, *operands) if len(operands) == 2 else None
        if unchanged is not None:
            return unchanged
        key = ("math", operation, *_operand_keys(operation, operands))
        return self._once(key, lambda: self._emit_math(operation, operands))

    def _emit_math(self, operation, operands):
        node = self.node("ShaderNodeMath", inputs=dict(enumerate(operands)), operation=operation)
        return self.output_of(node)

    def multiply_add(self, a, b, c):
        """a b + c, in one node unless numbers make it simpler."""
        trivial = any(_is(factor, number) for factor in (a, b) for number in (0.0, 1.0)) or _is(c, 0.0)
        if trivial or (is_number(a) and is_number(b)):
            return a * b + c
        return self.math("MULTIPLY_ADD", a, b, c)

    def mix(self, factor, if_zero, if_one):
        """if_zero (1 - factor) + if_one factor, for a factor from 0 to 1."""
        if is_number(factor):
            return if_one if factor > 0.5 else if_zero
        key = ("mix", *_operand_keys("MIX", (factor, if_zero, if_one)))
        return self._once(key, lambda: self._emit_mix(factor, if_zero, if_one))

    def _emit_mix(self, factor, if_zero, if_one):
        inputs = {MIX_FACTOR: factor, MIX_FLOAT_A: if_zero, MIX_FLOAT_B: if_one}
        return self.output_of(self.node("ShaderNodeMix", inputs=inputs, data_type="FLOAT"))

    # Vectors

    def vector_math(self, operation: str, a, b=None, scale=None):
        """One Vector Math node; scalar results (dot product, length) come as scalars."""
        if operation == "SCALE" and is_number(scale) and scale == 1.0:
            return a
        operands = tuple(operand for operand in (a, b) if operand is not None)
        key = ("vector", operation, *_operand_keys(operation, operands), _key(scale))
        return self._once(key, lambda: self._emit_vector_math(operation, operands, scale))

    def _emit_vector_math(self, operation, operands, scale):
        node = self.node("ShaderNodeVectorMath", inputs=dict(enumerate(operands)), operation=operation)
        if scale is not None:
            self.connect(scale, node.inputs["Scale"])
        return self.output_of(node, "Value" if operation in ("DOT_PRODUCT", "LENGTH") else "Vector")

    def components(self, vector) -> tuple[Scalar, Scalar, Scalar]:
        """x, y and z of a vector, or red, green and blue of a colour."""
        return self._once(("components", vector.key), lambda: self._emit_components(vector))

    def _emit_components(self, vector):
        node_type = "ShaderNodeSeparateColor" if isinstance(vector, Color) else "ShaderNodeSeparateXYZ"
        node = self.node(node_type, inputs={0: vector})
        return tuple(self.output_of(node, index) for index in range(3))

    def vector(self, x, y, z) -> Vector:
        """The vector (x, y, z)."""
        key = ("combine", _key(x), _key(y), _key(z))
        return self._once(key, lambda: self._emit_vector(x, y, z))

    def _emit_vector(self, x, y, z):
        return self.output_of(self.node("ShaderNodeCombineXYZ", inputs={0: x, 1: y, 2: z}))

    # Closures

    def add_shaders(self, first: Shader, *others: Shader) -> Shader:
        """The sum of closures."""
        total = first
        for other in others:
            total = self.output_of(self.node("ShaderNodeAddShader", inputs={0: total, 1: other}))
        return total

    def mix_shaders(self, factor: Scalar, if_zero: Shader, if_one: Shader) -> Shader:
        """if_zero (1 - factor) + if_one factor."""
        inputs = {0: factor, 1: if_zero, 2: if_one}
        return self.output_of(self.node("ShaderNodeMixShader", inputs=inputs))

    # Reading

    def label(self, value, name: str):
        """The value itself; its node is called `name` unless it already has a name."""
        node = None if is_number(value) else self._node_of(value)
        if node is not None and not node.label:
            node.label = name
        return value


def _key(value):
    return value if is_number(value) else value.key


def _operand_keys(operation, operands):
    keys = [_key(operand) for operand in operands]
    return sorted(keys, key=repr) if operation in COMMUTATIVE else keys


def _unchanged_operand(operation, a, b):
    """The operand that x + 0, x - 0, x * 1 and x / 1 leave as it is, or 0 for x * 0; else None."""
    for value, other in ((a, b), (b, a)):
        right_hand = other is b
        if _is(other, 0.0) and (operation == "ADD" or (operation == "SUBTRACT" and right_hand)):
            return value
        if _is(other, 1.0) and (operation == "MULTIPLY" or (operation in ("DIVIDE", "POWER") and right_hand)):
            return value
        if _is(other, 0.0) and operation == "MULTIPLY":
            return 0.0
    return None


class GraphOps:
    """`core.ops.Ops` on the values of a graph."""

    def __init__(self, graph: Graph):
        self._graph = graph

    def constant(self, value):
        return float(value)

    def multiply_add(self, a, b, c):
        return self._graph.multiply_add(a, b, c)

    def sqrt(self, a):
        return self._graph.math("SQRT", a)

    def exp(self, a):
        return self._graph.math("EXPONENT", a)

    def absolute(self, a):
        return self._graph.math("ABSOLUTE", a)

    def minimum(self, a, b):
        return self._graph.math("MINIMUM", a, b)

    def maximum(self, a, b):
        return self._graph.math("MAXIMUM", a, b)

    def power(self, base, exponent):
        return self._graph.math("POWER", base, exponent)

    def less_than(self, a, b):
        return self._graph.math("LESS_THAN", a, b)

    def where(self, condition, if_true, if_false):
        return self._graph.mix(condition, if_false, if_true)

    def label(self, value, name):
        return self._graph.label(value, name)

    def vector(self, x, y, z):
        return self._graph.vector(x, y, z)

    def dot(self, a, b):
        return a.dot(b)
