# SPDX-License-Identifier: Apache-2.0
"""
Write small networks as ONNX files, without the package onnx.

The layout of the protocol buffers is that of onnx.proto in the ONNX specification.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_IR_VERSION, _OPSET = 8, 17
_TYPES = {'float32': 1, 'uint8': 2, 'float16': 10}


@dataclass(frozen=True)
class Tensor:
    """An input or output of a network; a dimension that is a name is dynamic."""

    name: str
    shape: Sequence[int | str]
    kind: str = 'float32'
    """`float32`, `float16` or `uint8`."""


@dataclass(frozen=True)
class Operation:
    """An operation of ONNX without attributes, such as `MatMul`, `Add` or `Tanh`."""

    kind: str
    inputs: Sequence[str]
    output: str


def onnx_model(
    name: str,
    operations: Sequence[Operation],
    constants: Mapping[str, NDArray[np.float32]],
    inputs: Sequence[Tensor],
    outputs: Sequence[Tensor],
    metadata: Mapping[str, str] = {},
) -> bytes:
    """
    Encode a network as the content of a file.

    Parameters
    ----------
    name
        The name of the network.
    operations
        What the network computes, in an order in which inputs come before outputs.
    constants
        Weights by the names that operations use.
    inputs, outputs
        What the network takes, and what it returns.
    metadata
        What the file says of itself.

    """
    graph = b''.join(_bytes(1, _operation(each)) for each in operations)
    graph += _bytes(2, name.encode())
    graph += b''.join(_bytes(5, _constant(name, value)) for name, value in constants.items())
    graph += b''.join(_bytes(11, _tensor(each)) for each in inputs)
    graph += b''.join(_bytes(12, _tensor(each)) for each in outputs)
    model = _number(1, _IR_VERSION) + _bytes(7, graph) + _bytes(8, _number(2, _OPSET))
    for key, text in metadata.items():
        model += _bytes(14, _bytes(1, key.encode()) + _bytes(2, text.encode()))
    return model


def write_onnx(
    path: Path,
    operations: Sequence[Operation],
    constants: Mapping[str, NDArray[np.float32]],
    inputs: Sequence[Tensor],
    outputs: Sequence[Tensor],
    metadata: Mapping[str, str] = {},
) -> None:
    """
    Write a network as a file.

    Parameters
    ----------
    path
        The file, which is overwritten.
    operations, constants, inputs, outputs, metadata
        As for `onnx_model`.

    """
    path.write_bytes(onnx_model(path.stem, operations, constants, inputs, outputs, metadata))


def _operation(operation: Operation) -> bytes:
    """Encode a NodeProto."""
    inputs = b''.join(_bytes(1, name.encode()) for name in operation.inputs)
    return inputs + _bytes(2, operation.output.encode()) + _bytes(4, operation.kind.encode())


def _constant(name: str, value: NDArray[np.float32]) -> bytes:
    """Encode a TensorProto of float32."""
    values = np.ascontiguousarray(value, dtype='<f4')
    shape = b''.join(_number(1, size) for size in values.shape)
    return (
        shape
        + _number(2, _TYPES['float32'])
        + _bytes(8, name.encode())
        + _bytes(9, values.tobytes())
    )


def _tensor(tensor: Tensor) -> bytes:
    """Encode a ValueInfoProto."""
    dimensions = b''.join(
        _bytes(1, _number(1, size) if isinstance(size, int) else _bytes(2, size.encode()))
        for size in tensor.shape
    )
    kind = _number(1, _TYPES[tensor.kind]) + _bytes(2, dimensions)
    return _bytes(1, tensor.name.encode()) + _bytes(2, _bytes(1, kind))


def _number(field: int, value: int) -> bytes:
    """Encode a protocol buffer field with an integer."""
    return _varint(field << 3) + _varint(value)


def _bytes(field: int, content: bytes) -> bytes:
    """Encode a protocol buffer field with a string, bytes or a message."""
    return _varint(field << 3 | 2) + _varint(len(content)) + content


def _varint(value: int) -> bytes:
    """Encode an integer in groups of seven bits."""
    groups = bytearray()
    while value > 0x7F:
        groups.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*groups, value])
