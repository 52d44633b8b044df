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
    """Triangles, with their colour if they have one; `glb` has all colours and textures."""

    vertices: Vertices
    faces: Faces
    color: Color | None = None
    glb: bytes | None = None


@dataclass(frozen=True)
class DrawnMesh:
    """The contents of a mesh file, in metres; `warning` reports if they are incomplete."""

    surfaces: tuple[Surface, ...]
    is_flat: bool = False
    warning: str = ''

    @property
    def triangle_count(self) -> int:
        """The number of triangles."""
        return sum(len(surface.faces) for surface in self.surfaces)
