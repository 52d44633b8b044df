# SPDX-License-Identifier: Apache-2.0
"""
The meshes of a scene: bodies of revolution, which fill a box of 1 x 1 x 1 m about the origin.

The files in `meshes/`, which viewers read, are written by `python3 -m
humanoid_simulation.scene.meshes FOLDER`.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
import struct
import sys

import numpy as np
from numpy.typing import NDArray

Triangles = NDArray[np.float32]
"""(n, 3, 3): corners of n triangles, counter-clockwise seen from outside"""

SEGMENTS = 24

PROFILES: dict[str, Sequence[tuple[float, float]]] = {
    'mug': ((0, -0.5), (0.47, -0.5), (0.5, -0.46), (0.5, 0.5), (0.44, 0.5), (0.44, -0.42),
            (0, -0.42)),
    'bottle': ((0, -0.5), (0.47, -0.5), (0.5, -0.48), (0.5, 0.14), (0.44, 0.22), (0.22, 0.32),
               (0.19, 0.36), (0.19, 0.5), (0, 0.5)),
    'bowl': ((0, -0.5), (0.25, -0.5), (0.27, -0.42), (0.4, -0.18), (0.48, 0.16), (0.5, 0.5),
             (0.47, 0.5), (0.44, 0.18), (0.36, -0.14), (0.22, -0.36), (0, -0.42)),
    'shade': ((0.28, 0.5), (0.5, -0.5), (0.47, -0.5), (0.25, 0.5)),
    'trunk': ((0, -0.5), (0.42, -0.5), (0.43, -0.3), (0.39, -0.12), (0.44, 0.14), (0.5, 0.34),
              (0.46, 0.44), (0.28, 0.49), (0, 0.5)),
}  # fmt: skip
"""Radius and height, along the outline of half a section; a shade is open, others begin and end
on the axis."""


def triangles_of(name: str) -> Triangles:
    """
    Build the surface of a mesh.

    Parameters
    ----------
    name
        One of `PROFILES`.

    Returns
    -------
    Triangles
        Corners (n, 3, 3), in a box of 1 x 1 x 1 m about the origin.

    """
    profile = PROFILES[name]
    is_open = profile[0][0] > 0.0
    return revolved([*profile, profile[0]] if is_open else profile, SEGMENTS)


def revolved(profile: Sequence[tuple[float, float]], segments: int) -> Triangles:
    """
    Build the surface of revolution of a profile about the z axis.

    Parameters
    ----------
    profile
        Radii and heights along the outline of half a section, in m.
    segments
        How many straight segments make a circle.

    Returns
    -------
    Triangles
        Corners (n, 3, 3), in m, counter-clockwise seen from outside of the solid.

    """
    radii_heights = np.array(profile, dtype=np.float64)
    angles = 2.0 * np.pi * np.arange(segments + 1) / segments
    angles[-1] = 0.0
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    rings = np.empty((len(radii_heights), segments + 1, 3))
    rings[..., :2] = radii_heights[:, None, :1] * circle
    rings[..., 2] = radii_heights[:, 1:]
    low, high = rings[:-1], rings[1:]
    a, b, c, d = low[:, :-1], low[:, 1:], high[:, 1:], high[:, :-1]
    both = np.concatenate(
        [np.stack(corners, axis=2).reshape(-1, 3, 3) for corners in ([a, b, c], [a, c, d])]
    )
    areas = np.linalg.norm(np.cross(both[:, 1] - both[:, 0], both[:, 2] - both[:, 0]), axis=1)
    solid = both[areas > 1e-9].astype(np.float32)
    return np.asarray(solid if _volume(solid) > 0.0 else solid[:, ::-1], dtype=np.float32)


def _volume(triangles: Triangles) -> float:
    """Return the signed volume inside of triangles."""
    a, b, c = (triangles[:, corner].astype(np.float64) for corner in range(3))
    return float(np.einsum('ij,ij->', a, np.cross(b, c))) / 6.0


def stl_of(triangles: Triangles) -> bytes:
    """
    Encode triangles as a binary STL file.

    Parameters
    ----------
    triangles
        Corners (n, 3, 3), counter-clockwise seen from outside.

    """
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    records = np.zeros(len(triangles), dtype=[('vectors', '<f4', (4, 3)), ('attribute', '<u2')])
    records['vectors'][:, 0] = normals
    records['vectors'][:, 1:] = triangles
    return b'humanoid_simulation'.ljust(80) + struct.pack('<I', len(triangles)) + records.tobytes()


def main(argv: Sequence[str]) -> None:
    """
    Write all meshes as STL files.

    Parameters
    ----------
    argv
        The folder to write to, as the only argument.

    """
    for name in PROFILES:
        (Path(argv[0]) / f'{name}.stl').write_bytes(stl_of(triangles_of(name)))


if __name__ == '__main__':
    main(sys.argv[1:])
