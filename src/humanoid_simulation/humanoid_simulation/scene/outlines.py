# SPDX-License-Identifier: Apache-2.0
"""Polygons on the ground."""

from __future__ import annotations

from collections.abc import Iterator
import math

Point = tuple[float, float]
Outline = tuple[Point, ...]
"""The corners of a polygon, in order."""


def edges(outline: Outline) -> Iterator[tuple[Point, Point]]:
    """Yield the sides of a polygon."""
    yield from zip(outline, (*outline[1:], outline[0]))


def area_m2(outline: Outline) -> float:
    """Return the area of a polygon, by the shoelace formula."""
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges(outline))) / 2.0


def contains(outline: Outline, point: Point) -> bool:
    """Whether a point is inside of a polygon: a ray from it crosses an odd number of sides."""
    x, y = point
    inside = False
    for (x1, y1), (x2, y2) in edges(outline):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
            inside = not inside
    return inside


def rectangle(centre: Point, length_m: float, width_m: float, yaw_rad: float) -> Outline:
    """Return a rectangle; its length is along its heading."""
    return tuple(
        turned((sx * length_m / 2.0, sy * width_m / 2.0), yaw_rad, centre)
        for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))
    )


def turned(point: Point, yaw_rad: float, origin: Point = (0.0, 0.0)) -> Point:
    """Return a point that is given in axes which are turned, and begin at an origin."""
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return origin[0] + c * point[0] - s * point[1], origin[1] + s * point[0] + c * point[1]


def rectangles_of(outline: Outline) -> list[tuple[Point, Point]]:
    """
    Return rectangles, each by two opposite corners, that fill a polygon of right angles.

    A polygon with a side across the axes has none.
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
