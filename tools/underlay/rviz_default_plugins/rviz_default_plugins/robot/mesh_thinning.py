# SPDX-License-Identifier: Apache-2.0
"""Mesh simplification."""

from __future__ import annotations

from math import isqrt

import numpy as np
from rviz_default_plugins.robot.mesh import Faces, Vertices

__all__ = ['thinned']

STEP = 0.7


def thinned(vertices: Vertices, faces: Faces, limit: int) -> tuple[Vertices, Faces]:
    """
    Simplify a mesh by vertex clustering: the vertices in each cell of a lattice become one.

    Parameters
    ----------
    vertices
        The vertices (N, 3).
    faces
        The indices of the vertices of each triangle (M, 3).
    limit
        The maximum number of triangles of the result.

    Returns
    -------
    tuple[Vertices, Faces]
        Fewer vertices and triangles, in the same format.

    """
    lowest = vertices.min(axis=0)
    extent = float(np.ptp(vertices, axis=0).max()) or 1.0
    cells = 2 * isqrt(limit) + 1
    while len(faces) > limit and cells > 1:
        lattice = np.floor((vertices - lowest) / extent * cells).astype(np.int64)
        vertices, faces = _merged(vertices, faces, lattice @ np.array(_weights(cells)))
        cells = int(cells * STEP)
    return vertices, faces[:limit]


def _weights(cells: int) -> tuple[int, int, int]:
    """Return the index strides that give each cell a unique number."""
    return 1, cells + 1, (cells + 1) ** 2


def _merged(
    vertices: Vertices, faces: Faces, cell_of: np.ndarray[tuple[int, ...], np.dtype[np.int64]]
) -> tuple[Vertices, Faces]:
    """Merge the vertices of each cell into their mean; drop triangles that collapse."""
    _, cells, counts = np.unique(cell_of, return_inverse=True, return_counts=True)
    cells = cells.ravel()
    sums = [np.bincount(cells, weights=vertices[:, axis]) for axis in range(3)]
    means = (np.stack(sums, axis=1) / counts[:, None]).astype(np.float32)
    moved = cells[faces].astype(np.uint32)
    a, b, c = moved.T
    kept = moved[(a != b) & (b != c) & (a != c)]
    _, first = np.unique(np.sort(kept, axis=1), axis=0, return_index=True)
    return means, kept[np.sort(first)]
