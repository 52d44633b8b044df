# SPDX-License-Identifier: Apache-2.0
"""Triangles with a colour at each vertex, as a GLB file, which a page can show."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ['glb_of']

ARRAY_BUFFER, FLOAT, SHORT = 34962, 5126, 5123
UNLIT = 'KHR_materials_unlit'


def glb_of(vertices: NDArray[np.float32], colors: NDArray[np.uint8], is_lit: bool = True) -> bytes:
    """
    Encode triangles with a colour at each vertex as a GLB file.

    Colours are in sRGB, as in markers; in the file they are linear, as glTF 2.0 requires, in
    16 bits, since 8 are too coarse for dark ones.

    Parameters
    ----------
    vertices
        The vertices (N, 3) in m; each three form a triangle.
    colors
        Red, green, blue and alpha of each vertex (N, 4).
    is_lit
        Whether lights shine on the triangles, which are then seen from both sides. Otherwise they
        have exactly their colours, and are seen from where their vertices run counterclockwise.

    Returns
    -------
    bytes
        The contents of the file.

    """
    positions = np.ascontiguousarray(vertices, np.float32)
    paints = np.ascontiguousarray(_linear(np.asarray(colors, np.uint8)))
    count = len(positions)
    material: dict[str, Any] = {
        'doubleSided': is_lit,
        'alphaMode': 'BLEND' if (colors[:, 3] < 255).any() else 'OPAQUE',
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
                'componentType': SHORT,
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
    if not is_lit:
        content['extensionsUsed'] = [UNLIT]
        material['extensions'] = {UNLIT: {}}
    return _packed(json.dumps(content).encode(), positions.tobytes() + paints.tobytes())


def _linear(colors: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Convert colours (n, 4) from sRGB to linear; the last column, alpha, is unchanged."""
    parts = colors / 255.0
    light = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    light[:, 3] = parts[:, 3]
    return np.asarray((65535.0 * light).round(), dtype=np.uint16)


def _view(offset: int, length: int) -> dict[str, int]:
    return {'buffer': 0, 'byteOffset': offset, 'byteLength': length, 'target': ARRAY_BUFFER}


def _packed(text: bytes, data: bytes) -> bytes:
    """Assemble the file: a header, and two chunks whose lengths are multiples of four."""
    text += b' ' * (-len(text) % 4)
    chunks = struct.pack('<I4s', len(text), b'JSON') + text
    chunks += struct.pack('<I4s', len(data), b'BIN\0') + data
    return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks
