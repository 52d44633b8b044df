# SPDX-License-Identifier: Apache-2.0
"""
The trained network as an ONNX graph, with normalisation folded into the convolutions.

The weights of 3x3 convolutions are stored as int8 with a scale for each output channel, others as
fp16. Both are turned into fp32 by nodes whose inputs are constant: onnxruntime computes them
once, when it loads the file.
"""

from __future__ import annotations

from typing import Any

from boxes import Cells
from jax_operations import EPSILON, Statistics, Weights
from network import (
    HEIGHT_PX,
    LARGEST_EXPONENT,
    network,
    OUTPUTS,
    SIZE_OF_STRIDE,
    STRIDES,
    WIDTH_PX,
)
import numpy as np
from numpy.typing import NDArray
import onnx
from onnx import helper, numpy_helper, TensorProto
from pictures import CLASSES

INPUT, OUTPUT = 'images', 'output0'
_OPSET, _IR_VERSION = 17, 8
_INT8_ABOVE = 3000
"""A convolution with more weights than this is stored as int8."""

Array = NDArray[Any]


def model_of(weights: Weights, statistics: Statistics, metadata: dict[str, str]) -> Any:
    """
    Build the ONNX model, whose output is that of YOLOv8: [1, 4 + classes, cells].

    Boxes are centre x, y, width and height in pixels of the input, scores 0 to 1.

    Parameters
    ----------
    weights
        What was trained.
    statistics
        The mean and variance of what comes out of the convolutions.
    metadata
        What the file says of itself besides `names`, `imgsz`, `stride` and `task`.

    Returns
    -------
    Any
        The checked `onnx.ModelProto`.

    """
    graph = _Graph(weights, statistics)
    levels = network(graph, INPUT)
    output = graph.decoded(levels)
    count = len(Cells.of(HEIGHT_PX, WIDTH_PX).centres_px)
    model = helper.make_model(
        helper.make_graph(
            graph.nodes,
            'apartment_things',
            [_tensor(INPUT, [1, 3, HEIGHT_PX, WIDTH_PX])],
            [_tensor(output, [1, OUTPUTS, count])],
            graph.constants,
        ),
        opset_imports=[helper.make_opsetid('', _OPSET)],
        ir_version=_IR_VERSION,
        producer_name='humanoid tools/training',
    )
    said = {
        'names': str(dict(enumerate(CLASSES))),
        'imgsz': str([HEIGHT_PX, WIDTH_PX]),
        'stride': str(max(STRIDES) * 2),
        'task': 'detect',
        **metadata,
    }
    helper.set_model_props(model, said)
    onnx.checker.check_model(model, full_check=True)
    return model


def _tensor(name: str, shape: list[int]) -> Any:
    """Return the description of an input or output."""
    return helper.make_tensor_value_info(name, TensorProto.FLOAT, shape)


class _Graph:
    """Writes the nodes of the network; a tensor is its name."""

    def __init__(self, weights: Weights, statistics: Statistics) -> None:
        self._weights, self._statistics = weights, statistics
        self.nodes: list[Any] = []
        self.constants: list[Any] = []

    def conv(self, name: str, x: str, channels: int, size: int = 3, stride: int = 1) -> str:
        variance = np.asarray(self._statistics[f'{name}/variance'])
        gain = np.asarray(self._weights[f'{name}/scale']) / np.sqrt(variance + EPSILON)
        weight = np.asarray(self._weights[f'{name}/weight']) * gain
        mean = np.asarray(self._statistics[f'{name}/mean'])
        bias = np.asarray(self._weights[f'{name}/shift']) - mean * gain
        y = self._convolved(name, x, weight, bias, stride)
        return self._node('Relu', f'{name}_relu', [y])

    def linear(self, name: str, x: str, channels: int) -> str:
        weight = np.asarray(self._weights[f'{name}/weight'])
        return self._convolved(name, x, weight, np.asarray(self._weights[f'{name}/bias']), 1)

    def add(self, name: str, a: str, b: str) -> str:
        return self._node('Add', name, [a, b])

    def double(self, name: str, x: str) -> str:
        scales = self._constant(f'{name}_scales', np.array([1, 1, 2, 2], np.float32))
        return self._node(
            'Resize', name, [x, '', scales], mode='nearest', nearest_mode='floor',
            coordinate_transformation_mode='asymmetric',
        )  # fmt: skip

    def decoded(self, levels: list[str]) -> str:
        """Return the boxes and scores of all cells."""
        cells = Cells.of(HEIGHT_PX, WIDTH_PX)
        shape = self._constant('flat', np.array([1, OUTPUTS, -1], np.int64))
        flat = [self._node('Reshape', f'{each}_flat', [each, shape]) for each in levels]
        raw = self._node('Concat', 'raw', flat, axis=2)
        parts = ['raw_xy', 'raw_wh', 'raw_scores']
        split = self._constant('parts', np.array([2, 2, len(CLASSES)], np.int64))
        self.nodes.append(helper.make_node('Split', [raw, split], parts, axis=1))
        # Whole and half cells, as fp16 exact.
        centres = self._fp32('centres', cells.centres_px.T[None].astype(np.float16))
        strides = self._fp32('strides', cells.strides_px[None, None].astype(np.float16))
        away = self._node('Mul', 'away', [parts[0], strides])
        middle = self._node('Add', 'middle', [away, centres])
        low = self._constant('least', np.array(-LARGEST_EXPONENT, np.float32))
        high = self._constant('greatest', np.array(LARGEST_EXPONENT, np.float32))
        exponent = self._node('Clip', 'exponent', [parts[1], low, high])
        power = self._node('Exp', 'power', [exponent])
        usual = self._constant('usual', np.array(SIZE_OF_STRIDE, np.float32))
        sizes = self._node('Mul', 'usual_sizes', [strides, usual])
        edges = self._node('Mul', 'edges', [power, sizes])
        scores = self._node('Sigmoid', 'scores', [parts[2]])
        return self._node('Concat', OUTPUT, [middle, edges, scores], axis=1)

    def _convolved(self, name: str, x: str, weight: Array, bias: Array, stride: int) -> str:
        """Convolve with weights (height, width, in, out)."""
        ordered = weight.transpose(3, 2, 0, 1)
        stored = self._int8 if ordered.size > _INT8_ABOVE and weight.shape[0] > 1 else self._half
        border = weight.shape[0] // 2
        inputs = [x, stored(f'{name}_weight', ordered)]
        inputs.append(self._constant(f'{name}_bias', bias.astype(np.float32)))
        return self._node(
            'Conv', name, inputs, strides=[stride] * 2, pads=[border] * 4,
            kernel_shape=list(weight.shape[:2]),
        )  # fmt: skip

    def _int8(self, name: str, weight: Array) -> str:
        """Return weights (out, in, height, width), rounded to 255 values for each output."""
        scale = np.abs(weight).max(axis=(1, 2, 3), keepdims=True) / 127.0
        scale = np.maximum(scale, 1e-12).astype(np.float32)
        steps = self._fp32(f'{name}_steps', np.rint(weight / scale).astype(np.int8))
        return self._node('Mul', name, [steps, self._constant(f'{name}_scale', scale)])

    def _half(self, name: str, weight: Array) -> str:
        """Return weights, rounded to fp16."""
        return self._fp32(name, weight.astype(np.float16))

    def _fp32(self, name: str, value: NDArray[Any]) -> str:
        """Return a constant of another type as fp32."""
        stored = self._constant(f'{name}_stored', value)
        return self._node('Cast', name, [stored], to=TensorProto.FLOAT)

    def _constant(self, name: str, value: NDArray[Any]) -> str:
        """Return a constant."""
        self.constants.append(numpy_helper.from_array(np.ascontiguousarray(value), name))
        return name

    def _node(self, operation: str, name: str, inputs: list[str], **attributes: Any) -> str:
        """Return the output of a node."""
        self.nodes.append(helper.make_node(operation, inputs, [name], name, **attributes))
        return name
