# SPDX-License-Identifier: Apache-2.0
"""Write ONNX files of networks with a constant output, for tests, without the package onnx."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ['write_constant_network']

_FLOAT, _UINT8, _FLOAT16 = 1, 2, 10
_TYPES = {'float32': _FLOAT, 'uint8': _UINT8, 'float16': _FLOAT16}


def write_constant_network(
    path: Path,
    output: npt.ArrayLike,
    shape: Sequence[int | str] = (1, 3, 320, 320),
    metadata: Mapping[str, str] | None = None,
    kind: str = 'float32',
) -> Path:
    """
    Write a network with the same output for every image, and return its path.

    Parameters
    ----------
    path
        The file to write.
    output
        The constant output.
    shape
        The shape of its input `images`; a dimension that is a name is dynamic.
    metadata
        The metadata of the model, such as `names`.
    kind
        The type of the input: `float32`, `float16` or `uint8`.

    """
    values = np.ascontiguousarray(output, dtype='<f4')
    tensor = b''.join(_number(1, size) for size in values.shape)
    tensor += _number(2, _FLOAT) + _bytes(8, b'constant') + _bytes(9, values.tobytes())
    node = _bytes(1, b'constant') + _bytes(2, b'output0') + _bytes(4, b'Identity')
    graph = _bytes(1, node) + _bytes(2, b'graph') + _bytes(5, tensor)
    graph += _bytes(11, _value('images', _TYPES[kind], shape))
    graph += _bytes(12, _value('output0', _FLOAT, values.shape))
    model = _number(1, 8) + _bytes(7, graph) + _bytes(8, _number(2, 17))
    for key, text in (metadata or {}).items():
        model += _bytes(14, _bytes(1, key.encode()) + _bytes(2, text.encode()))
    path.write_bytes(model)
    return path


def _value(name: str, kind: int, shape: Sequence[Any]) -> bytes:
    """Encode a ValueInfoProto."""
    dimensions = b''.join(
        _bytes(1, _number(1, size) if isinstance(size, int) else _bytes(2, size.encode()))
        for size in shape
    )
    return _bytes(1, name.encode()) + _bytes(
        2, _bytes(1, _number(1, kind) + _bytes(2, dimensions))
    )


def _number(field: int, value: int) -> bytes:
    """Encode a protocol buffer field with an integer."""
    return _varint(field << 3) + _varint(value)


def _bytes(field: int, content: bytes) -> bytes:
    """Encode a protocol buffer field with a string, bytes or a message."""
    return _varint(field << 3 | 2) + _varint(len(content)) + content


def _varint(value: int) -> bytes:
    groups = bytearray()
    while value > 0x7F:
        groups.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*groups, value])
