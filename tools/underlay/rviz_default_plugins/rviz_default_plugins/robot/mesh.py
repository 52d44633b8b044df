# SPDX-License-Identifier: Apache-2.0
"""A mesh that can be drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from urdf import Color

__all__ = ['DrawnMesh', 'Surface']

Vertices = NDArray[np.float32]
Faces = NDArray[np.uint32]


@dataclass(frozen=True)
class Surface:
    """Triangles of one colour, if the file has one; `glb` is the same with all its colours."""

    vertices: Vertices
    faces: Faces
    color: Color | None = None
    glb: bytes | None = None


@dataclass(frozen=True)
class DrawnMesh:
    """What a file has, in metres; `warning` says if that is not all of it."""

    surfaces: tuple[Surface, ...]
    is_flat: bool = False
    warning: str = ''

    @property
    def triangle_count(self) -> int:
        """Return how many triangles it has."""
        return sum(len(surface.faces) for surface in self.surfaces)
