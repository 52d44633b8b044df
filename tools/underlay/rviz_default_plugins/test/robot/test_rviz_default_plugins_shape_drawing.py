# SPDX-License-Identifier: Apache-2.0
"""Bodies that are a little larger than they should be, and those of another colour."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rviz_default_plugins.robot.mesh_loading import DrawnMesh, Surface
from rviz_default_plugins.robot.shape_drawing import draw_shape, inflated
from urdf import Box, Capsule, Cylinder, Geometry, Mesh, Shape, Sphere


@pytest.mark.parametrize(
    ('body', 'larger'),
    [
        (Box((1.0, 2.0, 3.0)), Box((1.5, 2.5, 3.5))),
        (Cylinder(1.0, 2.0), Cylinder(1.25, 2.5)),
        (Capsule(1.0, 2.0), Capsule(1.25, 2.0)),
        (Sphere(1.0), Sphere(1.25)),
    ],
)
def test_each_side_is_farther_out(body: Geometry, larger: Geometry) -> None:
    """The margin is added on each side."""
    assert inflated(Shape(body), 0.25) == Shape(larger)
    assert inflated(Shape(body), 0.0) == Shape(body)


def test_meshes_are_scaled() -> None:
    """A mesh becomes larger by a factor, in the proportions that it has."""
    mesh = inflated(Shape(Mesh('a.stl', (1.0, -2.0, 3.0))), 0.003).geometry
    assert isinstance(mesh, Mesh)
    assert mesh.scale == pytest.approx((1.02, -2.04, 3.06))


@pytest.mark.parametrize(
    ('is_closed', 'scale', 'side'),
    [
        (True, (1.0, 1.0, 1.0), 'front'),
        (True, (-2.0, -1.0, 1.0), 'front'),
        (True, (1.0, -1.0, 1.0), 'double'),
        (False, (1.0, 1.0, 1.0), 'double'),
    ],
)
def test_back_faces_are_left_out(
    is_closed: bool, scale: tuple[float, float, float], side: str
) -> None:
    """The back of the triangles of a closed mesh is not drawn, unless a mirror turns them over."""
    drawn: list[str] = []
    scene: Any = SimpleNamespace(add_mesh_simple=lambda *args, side, **kwargs: drawn.append(side))
    surface = Surface(
        np.zeros((3, 3), np.float32), np.zeros((1, 3), np.uint32), is_closed=is_closed
    )
    shape = Shape(Mesh('a.stl', scale))
    draw_shape(scene, '/a', shape, 1.0, {'a.stl': DrawnMesh((surface,))}, None)
    assert drawn == [side]
