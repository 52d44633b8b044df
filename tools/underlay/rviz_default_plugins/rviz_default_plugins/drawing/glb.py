# SPDX-License-Identifier: Apache-2.0
"""Triangles in many colours, as a file of the kind GLB, which has them."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ['glb_of']

ARRAY_BUFFER, FLOAT, BYTE = 34962, 5126, 5121


def glb_of(vertices: NDArray[np.float32], colors: NDArray[np.uint8]) -> bytes:
    """Return a file; each three vertices are a triangle, each has red, green, blue, alpha."""
    positions = np.ascontiguousarray(vertices, np.float32)
    paints = np.ascontiguousarray(colors, np.uint8)
    count = len(positions)
    material = {
        'doubleSided': True,
        'alphaMode': 'BLEND' if (paints[:, 3] < 255).any() else 'OPAQUE',
        'pbrMetallicRoughness': {'metallicFactor': 0.0, 'roughnessFactor': 1.0},
    }
    content: dict[str, Any] = {
        'asset': {'version': '2.0'},
        'scene': 0,
        'scenes': [{'nodes': [0]}],
        'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'COLOR_0': 1}, 'material': 0}]}],
        'materials': [material],
        'accessors': [
            {
                'bufferView': 0,
                'componentType': FLOAT,
                'count': count,
                'type': 'VEC3',
                'min': positions.min(axis=0).tolist(),
                'max': positions.max(axis=0).tolist(),
            },
            {
                'bufferView': 1,
                'componentType': BYTE,
                'normalized': True,
                'count': count,
                'type': 'VEC4',
            },
        ],
        'bufferViews': [
            _view(0, positions.nbytes),
            _view(positions.nbytes, paints.nbytes),
        ],
        'buffers': [{'byteLength': positions.nbytes + paints.nbytes}],
    }
    return _packed(json.dumps(content).encode(), positions.tobytes() + paints.tobytes())


def _view(offset: int, length: int) -> dict[str, int]:
    return {'buffer': 0, 'byteOffset': offset, 'byteLength': length, 'target': ARRAY_BUFFER}


def _packed(text: bytes, data: bytes) -> bytes:
    """Return the file: a header, and two chunks whose lengths are multiples of four."""
    text += b' ' * (-len(text) % 4)
    chunks = struct.pack('<I4s', len(text), b'JSON') + text
    chunks += struct.pack('<I4s', len(data), b'BIN\0') + data
    return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks
