# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluates a built node group with NumPy, node by node, as a renderer's float32 arithmetic would.

Knows the nodes that formulas are made of; anything else (closures, geometry) is an error. What it returns can
then be compared with the same formula evaluated by `core.ops.NumpyOps`.
"""

import numpy as np

MATH = {
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "DIVIDE": lambda a, b: np.divide(a, b, out=np.zeros(np.broadcast(a, b).shape, a.dtype), where=b != 0),
    "POWER": np.power,
    "MINIMUM": np.minimum,
    "MAXIMUM": np.maximum,
    "LESS_THAN": lambda a, b: (a < b).astype(a.dtype),
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "SQRT": np.sqrt,
    "EXPONENT": np.exp,
    "ABSOLUTE": np.abs,
}

VECTOR_MATH = {
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "MULTIPLY": lambda a, b: a * b,
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "CROSS_PRODUCT": np.cross,
    "DOT_PRODUCT": lambda a, b: np.sum(a * b, axis=-1),
    "LENGTH": lambda a: np.sqrt(np.sum(a * a, axis=-1)),
    "NORMALIZE": lambda a: a / np.sqrt(np.sum(a * a, axis=-1, keepdims=True)),
}


class TreeInterpreter:
    """Output values of a group for given inputs: scalars of shape (n,), vectors and colours (n, 3)."""

    def __init__(self, tree, inputs: dict, dtype=np.float32):
        self.tree, self.inputs, self.dtype = tree, inputs, np.dtype(dtype)
        self.cache = {}

    def output(self, name):
        """The value of the group output called `name`."""
        (node,) = [node for node in self.tree.nodes if node.bl_idname == "NodeGroupOutput"]
        return self.input_value(node.inputs[name])

    def input_value(self, socket):
        if socket.is_linked:
            value = self.output_value(socket.links[0].from_socket)
            is_broadcast = socket.type == "VECTOR" and socket.links[0].from_socket.type == "VALUE"
            return value[..., None] * np.ones(3, self.dtype) if is_broadcast else value
        value = socket.default_value
        return np.asarray(value if socket.type == "VALUE" else list(value)[:3], self.dtype)

    def output_value(self, socket):
        key = (socket.node.name, socket.identifier)
        if key not in self.cache:
            self.cache[key] = np.asarray(self.evaluate(socket.node, socket), self.dtype)
        return self.cache[key]

    def evaluate(self, node, socket):
        match node.bl_idname:
            case "NodeGroupInput":
                return self.inputs[socket.name]
            case "ShaderNodeMath":
                operands = [self.input_value(operand) for operand in node.inputs if operand.enabled]
                return MATH[node.operation](*operands)
            case "ShaderNodeMix":
                factor, a, b = (self.input_value(node.inputs[index]) for index in (0, 2, 3))
                return a * (1 - factor) + b * factor
            case "ShaderNodeVectorMath":
                operands = [self.input_value(operand) for operand in node.inputs if operand.enabled]
                if node.operation == "SCALE":
                    return operands[0] * operands[1][..., None]
                return VECTOR_MATH[node.operation](*operands)
            case "ShaderNodeSeparateXYZ":
                index = [output.name for output in node.outputs].index(socket.name)
                return self.input_value(node.inputs[0])[..., index]
            case "ShaderNodeCombineXYZ":
                return np.stack(np.broadcast_arrays(*(self.input_value(i) for i in node.inputs)), axis=-1)
            case "ShaderNodeGroup":
                inner = {item.name: self.input_value(item) for item in node.inputs}
                return TreeInterpreter(node.node_tree, inner, self.dtype).output(socket.name)
        raise NotImplementedError(f"{node.bl_idname} in {self.tree.name}")
