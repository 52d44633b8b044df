# SPDX-License-Identifier: Apache-2.0
"""Polygons on the ground."""

from __future__ import annotations

from collections.abc import Iterator
import math

Point = tuple[float, float]
Outline = tuple[Point, ...]
"""The corners of a polygon, in order."""


def edges(outline: Outline) -> Iterator[tuple[Point, Point]]:
    """
    List the edges of a polygon, the last of which closes it.

    Parameters
    ----------
    outline
        The polygon.

    Yields
    ------
    Point, Point
        Start and end of an edge.

    """
    yield from zip(outline, (*outline[1:], outline[0]))


def area_m2(outline: Outline) -> float:
    """
    Compute the area of a polygon by the shoelace formula.

    Parameters
    ----------
    outline
        The polygon, in m.

    """
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges(outline))) / 2.0


def contains(outline: Outline, point: Point) -> bool:
    """
    Check whether a point is inside a polygon, by ray casting.

    Parameters
    ----------
    outline
        The polygon.
    point
        The point, in the frame of the polygon.

    """
    x, y = point
    inside = False
    for (x1, y1), (x2, y2) in edges(outline):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
            inside = not inside
    return inside


def rectangle(centre: Point, length_m: float, width_m: float, yaw_rad: float) -> Outline:
    """
    Build a rectangle from its centre, size and heading.

    Parameters
    ----------
    centre
        Its centre (x, y), in m.
    length_m, width_m
        Its edges along and across the heading.
    yaw_rad
        The heading.

    Returns
    -------
    Outline
        Front left, back left, back right and front right corner.

    """
    return tuple(
        turned((sx * length_m / 2.0, sy * width_m / 2.0), yaw_rad, centre)
        for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))
    )


def turned(point: Point, yaw_rad: float, origin: Point = (0.0, 0.0)) -> Point:
    """
    Transform a point from a rotated frame to its parent frame.

    Parameters
    ----------
    point
        The point in the rotated frame.
    yaw_rad, origin
        The pose of the rotated frame in the parent frame.

    """
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return origin[0] + c * point[0] - s * point[1], origin[1] + s * point[0] + c * point[1]


def rectangles_of(outline: Outline) -> list[tuple[Point, Point]]:
    """
    Decompose a rectilinear polygon into axis-aligned rectangles.

    Parameters
    ----------
    outline
        The polygon.

    Returns
    -------
    list of (Point, Point)
        Lower left and upper right corners; empty if an edge is not parallel to an axis.

    """
    if any(abs(a[0] - b[0]) > 1e-9 and abs(a[1] - b[1]) > 1e-9 for a, b in edges(outline)):
        return []
    xs = sorted({x for x, _ in outline})
    ys = sorted({y for _, y in outline})
    return [
        ((x1, y1), (x2, y2))
        for x1, x2 in zip(xs, xs[1:])
        for y1, y2 in zip(ys, ys[1:])
        if contains(outline, ((x1 + x2) / 2.0, (y1 + y2) / 2.0))
    ]
