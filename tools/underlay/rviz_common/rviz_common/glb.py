# SPDX-License-Identifier: Apache-2.0
"""Triangles with a colour at each vertex, loose or as a surface, as a GLB file for a page."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ['glb_of', 'surface_glb']

ARRAY_BUFFER, INDEX_BUFFER = 34962, 34963
FLOAT, SHORT, INT = 5126, 5123, 5125
UNLIT = 'KHR_materials_unlit'
MATT = {'pbrMetallicRoughness': {'metallicFactor': 0.0, 'roughnessFactor': 1.0}}


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
    attributes: dict[str, NDArray[Any]] = {
        'POSITION': np.ascontiguousarray(vertices, np.float32),
        'COLOR_0': _linear(np.asarray(colors, np.uint8)),
    }
    material: dict[str, Any] = {
        'doubleSided': is_lit,
        'alphaMode': 'BLEND' if (colors[:, 3] < 255).any() else 'OPAQUE',
        **MATT,
    }
    if not is_lit:
        material['extensions'] = {UNLIT: {}}
    return _file(attributes, None, material)


def surface_glb(
    vertices: NDArray[np.float32], faces: NDArray[np.uint32], colors: NDArray[np.uint8]
) -> bytes:
    """
    Encode a closed, opaque surface with a colour at each vertex as a GLB file.

    Triangles that share a vertex are shaded as one smooth surface there. They are seen from where
    their vertices run counterclockwise.

    Parameters
    ----------
    vertices
        The vertices (N, 3) in m.
    faces
        The indices of the vertices of each triangle (M, 3).
    colors
        Red, green, blue and alpha of each vertex (N, 4) in sRGB.

    Returns
    -------
    bytes
        The contents of the file.

    """
    positions = np.ascontiguousarray(vertices, np.float32)
    attributes: dict[str, NDArray[Any]] = {
        'POSITION': positions,
        'NORMAL': _normals(positions, faces),
        'COLOR_0': _linear(np.asarray(colors, np.uint8)),
    }
    return _file(attributes, np.ascontiguousarray(faces, np.uint32), MATT)


def _normals(vertices: NDArray[np.float32], faces: NDArray[np.uint32]) -> NDArray[np.float32]:
    """Return the unit normals at vertices: the mean of the triangles there, by their areas."""
    a, b, c = (vertices[faces[:, corner]].astype(np.float64) for corner in range(3))
    areas = np.repeat(np.cross(b - a, c - a), 3, axis=0)
    at = faces.ravel()
    columns = [np.bincount(at, areas[:, axis], len(vertices)) for axis in range(3)]
    sums = np.stack(columns, axis=1)
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    units = np.where(lengths > 0.0, sums / np.where(lengths > 0.0, lengths, 1.0), (0.0, 0.0, 1.0))
    return np.ascontiguousarray(units, np.float32)


def _file(
    attributes: dict[str, NDArray[Any]], faces: NDArray[np.uint32] | None, material: dict[str, Any]
) -> bytes:
    """Return the file of one mesh; without faces, each three vertices are a triangle."""
    arrays = list(attributes.values())
    primitive: dict[str, Any] = {
        'attributes': {name: index for index, name in enumerate(attributes)},
        'material': 0,
    }
    accessors = [_accessor(index, each) for index, each in enumerate(arrays)]
    positions = attributes['POSITION']
    accessors[0] |= {'min': positions.min(axis=0).tolist(), 'max': positions.max(axis=0).tolist()}
    if faces is not None:
        primitive['indices'] = len(arrays)
        accessors.append(_accessor(len(arrays), faces.reshape(-1, 1)))
        arrays.append(faces)
    ends = np.cumsum([0, *(each.nbytes for each in arrays)]).tolist()
    content: dict[str, Any] = {
        'asset': {'version': '2.0'},
        'scene': 0,
        'scenes': [{'nodes': [0]}],
        'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [primitive]}],
        'materials': [material],
        'accessors': accessors,
        'bufferViews': [
            _view(start, each.nbytes, INDEX_BUFFER if each is faces else ARRAY_BUFFER)
            for start, each in zip(ends, arrays)
        ],
        'buffers': [{'byteLength': ends[-1]}],
    }
    if extensions := material.get('extensions'):
        content['extensionsUsed'] = list(extensions)
    return _packed(json.dumps(content).encode(), b''.join(each.tobytes() for each in arrays))


def _accessor(view: int, array: NDArray[Any]) -> dict[str, Any]:
    """Return what the file says about an array (N, 1, 3 or 4); colours are the only shorts."""
    kind = {np.dtype(np.float32): FLOAT, np.dtype(np.uint16): SHORT}.get(array.dtype, INT)
    accessor = {
        'bufferView': view,
        'componentType': kind,
        'count': len(array),
        'type': {1: 'SCALAR', 3: 'VEC3', 4: 'VEC4'}[array.shape[1]],
    }
    return {**accessor, 'normalized': True} if kind == SHORT else accessor


def _linear(colors: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Convert colours (n, 4) from sRGB to linear; the last column, alpha, is unchanged."""
    parts = colors / 255.0
    light = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    light[:, 3] = parts[:, 3]
    return np.asarray((65535.0 * light).round(), dtype=np.uint16)


def _view(offset: int, length: int, target: int) -> dict[str, int]:
    return {'buffer': 0, 'byteOffset': offset, 'byteLength': length, 'target': target}


def _packed(text: bytes, data: bytes) -> bytes:
    """Assemble the file: a header, and two chunks whose lengths are multiples of four."""
    text += b' ' * (-len(text) % 4)
    chunks = struct.pack('<I4s', len(text), b'JSON') + text
    chunks += struct.pack('<I4s', len(data), b'BIN\0') + data
    return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks
