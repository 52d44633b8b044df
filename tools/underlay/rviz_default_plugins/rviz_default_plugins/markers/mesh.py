# SPDX-License-Identifier: Apache-2.0
"""How meshes of markers reach the page: those of files, and triangles with vertex colours."""

from __future__ import annotations

from concurrent.futures import Future
from functools import lru_cache
import json
from pathlib import Path
import struct
from threading import Lock, Thread
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_common.canvas import Canvas
from rviz_default_plugins.bodies import opacity_of
from rviz_default_plugins.markers.look import Look
from rviz_default_plugins.robot.mesh_file import find_mesh
from rviz_default_plugins.robot.mesh_loading import DrawnMesh, load_mesh

__all__ = ['MeshIsBeingRead', 'draw_mesh', 'glb_of', 'mesh_of']

WHITE = (1.0, 1.0, 1.0, 1.0)
ONE_AT_A_TIME = Lock()

ARRAY_BUFFER, FLOAT, SHORT = 34962, 5126, 5123


class MeshIsBeingRead(ValueError):
    """The mesh has not been read yet."""


def draw_mesh(canvas: Canvas, name: str, look: Look) -> None:
    """
    Draw the mesh that a marker names, in the colours of its file if the marker wants that.

    The file is read in the background.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The prefix of the names of the nodes, below the root of the canvas.
    look
        The look of the marker.

    Raises
    ------
    ValueError
        The mesh cannot be found or read.
    MeshIsBeingRead
        It has not been read yet. This is also a ValueError.

    """
    resource, has_own_colors = look.mesh
    if not resource:
        raise ValueError('its mesh_resource is empty.')
    mesh = mesh_of(resource)
    for index, surface in enumerate(mesh.surfaces):
        path = f'{name}_{index}'
        if has_own_colors and surface.glb is not None:
            canvas.put('glb', path, glb_data=surface.glb, scale=look.scale)
            continue
        color, alpha = look.color, look.alpha
        if has_own_colors:
            red, green, blue, alpha = surface.color or WHITE
            color = round(red * 255), round(green * 255), round(blue * 255)
        canvas.put(
            'mesh_simple',
            path,
            vertices=surface.vertices,
            faces=surface.faces,
            color=color,
            opacity=opacity_of(alpha),
            scale=look.scale,
            flat_shading=mesh.is_flat,
            side='double',
        )


def mesh_of(resource: str) -> DrawnMesh:
    """
    Return the mesh that a marker names; the file is read in the background.

    Parameters
    ----------
    resource
        The name of the file.

    Raises
    ------
    ValueError
        The mesh cannot be found or read.
    MeshIsBeingRead
        It has not been read yet. This is also a ValueError.

    """
    path = find_mesh(resource)
    try:
        changed_ns = path.stat().st_mtime_ns
    except OSError as error:
        raise ValueError(f"'{resource}' cannot be read: {error.strerror}.") from None
    reading = _reading(path, resource, changed_ns)
    if not reading.done():
        raise MeshIsBeingRead(f"'{resource}' is being read.")
    return reading.result()


@lru_cache(maxsize=256)
def _reading(path: Path, resource: str, changed_ns: int) -> Future[DrawnMesh]:
    """Start reading a mesh in the background, which may take seconds."""
    reading: Future[DrawnMesh] = Future()

    def read() -> None:
        try:
            with ONE_AT_A_TIME:
                reading.set_result(load_mesh(path, resource))
        except OSError as error:
            reading.set_exception(ValueError(f"'{resource}' cannot be read: {error.strerror}."))
        except Exception as error:  # the exception is passed on to those waiting for the mesh
            reading.set_exception(error)

    Thread(target=read, name='mesh', daemon=True).start()
    return reading


def glb_of(vertices: NDArray[np.float32], colors: NDArray[np.uint8]) -> bytes:
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

    Returns
    -------
    bytes
        The contents of the file.

    """
    positions = np.ascontiguousarray(vertices, np.float32)
    paints = np.ascontiguousarray(_linear(np.asarray(colors, np.uint8)))
    count = len(positions)
    material = {
        'doubleSided': True,
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
