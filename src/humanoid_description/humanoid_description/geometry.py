# SPDX-License-Identifier: Apache-2.0
"""Points, mass and area of a robot that stands still."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

from humanoid_description.robot import Array, Robot, Shape
import numpy as np

# A cylinder is as good as a prism of so many edges.
EDGES = 24
_AXES: Array = np.vstack([np.eye(3), -np.eye(3)])
_SIGNS: Array = np.array(list(product((-1.0, 1.0), repeat=3)))


def centre_of_mass(robot: Robot, poses: dict[str, Array]) -> Array:
    """Return the centre of mass in the root."""
    total: Array = np.zeros(3)
    for link in robot.links:
        if link.body:
            total += link.body.mass_kg * (poses[link.name] @ link.body.pose)[:3, 3]
    return total / robot.mass_kg


def outline(shapes: Iterable[Shape], pose: Array) -> Array:
    """Return the corners of shapes on a link, one a row, in the frame of the link's pose."""
    corners = [_placed(_corners(shape), pose @ shape.pose) for shape in shapes]
    return np.vstack([np.zeros((0, 3)), *corners])


def _placed(points: Array, pose: Array) -> Array:
    """Return points in the frame in which the pose is given."""
    placed: Array = points @ pose[:3, :3].T + pose[:3, 3]
    return placed


def _corners(shape: Shape) -> Array:
    """Return points on the outside of a shape, in its own frame; of a mesh there are none."""
    if shape.kind == 'box':
        edges: Array = np.array(shape.size_m)
        return _SIGNS * edges / 2
    if shape.kind == 'cylinder':
        radius, length = shape.size_m
        return np.vstack([_ring(radius, -length / 2), _ring(radius, length / 2)])
    if shape.kind == 'sphere':
        radius = shape.size_m[0]
        return _AXES * radius
    return np.zeros((0, 3))


def _ring(radius: float, height: float) -> Array:
    """Return points on a circle about z."""
    angles = np.linspace(0.0, 2 * np.pi, EDGES, endpoint=False)
    return np.column_stack(
        [radius * np.cos(angles), radius * np.sin(angles), np.full(EDGES, height)]
    )


def margin_inside(point: Array, corners: Array) -> float:
    """Return how deep a point lies in the convex hull of corners; negative outside."""
    hull = convex_hull(corners)
    edges = np.roll(hull, -1, axis=0) - hull
    lengths = np.linalg.norm(edges, axis=1)
    to_point = point - hull
    crosses = edges[:, 0] * to_point[:, 1] - edges[:, 1] * to_point[:, 0]
    return float(np.min(crosses / lengths))


def convex_hull(points: Array) -> Array:
    """Return the corners of the hull of points in a plane, anticlockwise."""
    ordered = sorted({(float(x), float(y)) for x, y in points})
    lower, upper = _half_hull(ordered), _half_hull(ordered[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _half_hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the points that a string stretched below the points touches."""
    hull: list[tuple[float, float]] = []
    for point in points:
        while len(hull) > 1 and not _turns_left(hull[-2], hull[-1], point):
            hull.pop()
        hull.append(point)
    return hull


def _turns_left(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> bool:
    """Tell whether the way from a over b to c bends to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
