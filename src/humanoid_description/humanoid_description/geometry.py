# SPDX-License-Identifier: Apache-2.0
"""Geometry of a robot at rest: centre of mass, corners of shapes, and convex hulls."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

from humanoid_description.robot import Array, Robot, Shape
import numpy as np

# Number of edges of the prism that approximates a cylinder.
EDGES = 24
_AXES: Array = np.vstack([np.eye(3), -np.eye(3)])
_SIGNS: Array = np.array(list(product((-1.0, 1.0), repeat=3)))


def centre_of_mass(robot: Robot, poses: dict[str, Array]) -> Array:
    """
    Compute the centre of mass of a robot.

    Parameters
    ----------
    robot
        A model with mass.
    poses
        The pose (4, 4) of each link in the root by its name, as from `kinematics.poses`.

    Returns
    -------
    Array
        Position (3,) in m, in the frame of the root.

    """
    total: Array = np.zeros(3)
    for link in robot.links:
        if link.body:
            total += link.body.mass_kg * (poses[link.name] @ link.body.pose)[:3, 3]
    return total / robot.mass_kg


def outline(shapes: Iterable[Shape], pose: Array) -> Array:
    """
    Compute the corners of the shapes of a link.

    A cylinder counts as a prism of 24 edges, a sphere as its six points on the axes; a mesh has no
    corners.

    Parameters
    ----------
    shapes
        Visual or collision shapes.
    pose
        The pose (4, 4) of their link in any frame.

    Returns
    -------
    Array
        Points (n, 3) in m, in that frame.

    """
    corners = [_placed(_corners(shape), pose @ shape.pose) for shape in shapes]
    return np.vstack([np.zeros((0, 3)), *corners])


def _placed(points: Array, pose: Array) -> Array:
    """Transform points by a pose."""
    placed: Array = points @ pose[:3, :3].T + pose[:3, 3]
    return placed


def _corners(shape: Shape) -> Array:
    """Return the corners of a shape in its own frame; a mesh has none."""
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
    """
    Compute the stability margin of a point: its distance from the edges of a convex hull.

    Parameters
    ----------
    point
        x and y in m (2,).
    corners
        Points (n, 2) in m that span the hull, in the same frame.

    Returns
    -------
    float
        Distance in m from the nearest edge; positive inside the hull, negative outside.

    """
    hull = convex_hull(corners)
    edges = np.roll(hull, -1, axis=0) - hull
    lengths = np.linalg.norm(edges, axis=1)
    to_point = point - hull
    crosses = edges[:, 0] * to_point[:, 1] - edges[:, 1] * to_point[:, 0]
    return float(np.min(crosses / lengths))


def convex_hull(points: Array) -> Array:
    """
    Compute the convex hull of points in a plane (Andrew's monotone chain).

    Parameters
    ----------
    points
        The points (n, 2), in any order.

    Returns
    -------
    Array
        The corners (m, 2) of the hull, anticlockwise.

    """
    ordered = sorted({(float(x), float(y)) for x, y in points})
    lower, upper = _half_hull(ordered), _half_hull(ordered[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _half_hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Compute the lower half of the hull of ordered points, or the upper half if reversed."""
    hull: list[tuple[float, float]] = []
    for point in points:
        while len(hull) > 1 and not _turns_left(hull[-2], hull[-1], point):
            hull.pop()
        hull.append(point)
    return hull


def _turns_left(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> bool:
    """Check whether the path from a via b to c turns left."""
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
