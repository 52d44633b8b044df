# SPDX-License-Identifier: Apache-2.0
"""Where rays meet bodies, compared with trimesh where it is not plain."""

from __future__ import annotations

import numpy as np
import pytest
from rviz_common.selection import Ray
from rviz_default_plugins.ray_hits import (
    hit_box,
    hit_capsule,
    hit_cylinder,
    hit_sphere,
    hit_triangles,
    unscaled,
)
import trimesh

FROM_ABOVE = Ray((0.0, 0.0, 10.0), (0.0, 0.0, -1.0))
FROM_THE_SIDE = Ray((10.0, 0.0, 0.0), (-1.0, 0.0, 0.0))
AWAY = Ray((10.0, 0.0, 0.0), (1.0, 0.0, 0.0))
BESIDE = Ray((10.0, 0.0, 5.0), (-1.0, 0.0, 0.0))
WITHIN = Ray((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ('hit', 'size', 'above', 'side'),
    [
        (hit_box, ((2.0, 4.0, 6.0),), 7.0, 9.0),
        (hit_sphere, (1.5,), 8.5, 8.5),
        (hit_cylinder, (0.5, 4.0), 8.0, 9.5),
        (hit_capsule, (0.5, 4.0), 7.5, 9.5),
    ],
)
def test_bodies_are_met_from_outside_and_from_within(
    hit: object, size: tuple[object, ...], above: float, side: float
) -> None:
    """A ray that goes away, or passes by, meets nothing."""
    assert callable(hit)
    assert hit(FROM_ABOVE, *size) == pytest.approx(above)
    assert hit(FROM_THE_SIDE, *size) == pytest.approx(side)
    assert hit(WITHIN, *size) == pytest.approx(10.0 - side)
    assert hit(AWAY, *size) is None
    assert hit(BESIDE, *size) is None


def test_distances_are_multiples_of_the_direction() -> None:
    """A direction of length 2 has half the distance."""
    ray = Ray((10.0, 0.0, 0.0), (-2.0, 0.0, 0.0))
    assert hit_sphere(ray, 1.0) == pytest.approx(4.5)


def test_bodies_and_their_meshes_are_met_at_the_same_place() -> None:
    """Oblique rays meet a body where they meet its triangles, or both not."""
    random = np.random.default_rng(7)
    cylinder = trimesh.creation.cylinder(radius=0.5, height=2.0, sections=400)
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    met = 0
    for _ in range(60):
        origin = random.normal(size=3) * 3.0
        ray = Ray(tuple(origin), tuple(random.normal(size=3) * 0.7 - origin))
        for body, mesh in (
            (hit_cylinder(ray, 0.5, 2.0), cylinder),
            (hit_box(ray, (1.0, 2.0, 3.0)), box),
        ):
            triangles = hit_triangles(ray, mesh.vertices, mesh.faces)
            if body is not None and triangles is not None:
                met += 1
                assert triangles == pytest.approx(body, abs=2e-3)
    assert met > 40


def test_triangles_are_met_from_both_sides() -> None:
    """Only the first of several triangles counts; no triangle at all is not met."""
    corners = np.array([[0, -1, -1], [0, 1, -1], [0, 0, 1]], np.float32)
    vertices = np.concatenate([corners, corners + [-2, 0, 0]])
    faces = np.array([[0, 1, 2], [5, 4, 3]], np.uint32)
    assert hit_triangles(FROM_THE_SIDE, vertices, faces) == pytest.approx(10.0)
    other = Ray((-10.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert hit_triangles(other, vertices, faces) == pytest.approx(8.0)
    assert hit_triangles(BESIDE, vertices, faces) is None
    assert hit_triangles(other, vertices, faces[:0]) is None


def test_a_scaled_body_is_met_where_it_is() -> None:
    """A sphere that is stretched along x is met earlier; one without size is not met."""
    stretched = unscaled(FROM_THE_SIDE, (4.0, 1.0, 1.0))
    assert stretched is not None
    assert hit_sphere(stretched, 0.5) == pytest.approx(8.0)
    assert unscaled(FROM_THE_SIDE, (0.0, 1.0, 1.0)) is None
