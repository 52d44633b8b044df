# SPDX-License-Identifier: Apache-2.0
"""
Where rays meet bodies: boxes, spheres, cylinders, capsules and triangles.

All functions return how many times the direction the body is from the origin of the ray, or None
if the ray passes it by. The direction may have any length, so that a ray can be scaled.
"""

from __future__ import annotations

from collections.abc import Sequence
import math

import numpy as np
from numpy.typing import NDArray
from rviz_common.selection import Point, Ray

__all__ = [
    'hit_box',
    'hit_capsule',
    'hit_cylinder',
    'hit_sphere',
    'hit_triangles',
    'unscaled',
]

TINY = 1e-12
Span = tuple[float, float]
"""Between which distances a ray is within a body."""


def hit_box(ray: Ray, size: Sequence[float]) -> float | None:
    """
    Intersect a ray with a box around the origin.

    Parameters
    ----------
    ray
        The ray, in the axes of the box.
    size
        The lengths of the edges along x, y and z.

    """
    spans = [
        _slab(start, step, -0.5 * length, 0.5 * length)
        for start, step, length in zip(ray.origin, ray.direction, size)
    ]
    return _first(_common(spans))


def hit_sphere(ray: Ray, radius: float, height: float = 0.0) -> float | None:
    """
    Intersect a ray with a sphere on the z axis.

    Parameters
    ----------
    ray
        The ray, in the axes of the sphere.
    radius
        The radius.
    height
        The z coordinate of the centre.

    """
    x, y, z = ray.origin
    return _first(_round((x, y, z - height), ray.direction, radius))


def hit_cylinder(ray: Ray, radius: float, length: float) -> float | None:
    """
    Intersect a ray with a cylinder along z, centred at the origin.

    Parameters
    ----------
    ray
        The ray, in the axes of the cylinder.
    radius, length
        Its size.

    """
    (x, y, z), (dx, dy, dz) = ray.origin, ray.direction
    side = _round((x, y), (dx, dy), radius)
    return _first(_common([side, _slab(z, dz, -0.5 * length, 0.5 * length)]))


def hit_capsule(ray: Ray, radius: float, length: float) -> float | None:
    """
    Intersect a ray with a capsule along z: a cylinder between two hemispheres.

    Parameters
    ----------
    ray
        The ray, in the axes of the capsule.
    radius, length
        The size of the cylinder.

    """
    hits = (
        hit_cylinder(ray, radius, length),
        hit_sphere(ray, radius, 0.5 * length),
        hit_sphere(ray, radius, -0.5 * length),
    )
    return min((hit for hit in hits if hit is not None), default=None)


def hit_triangles(
    ray: Ray, vertices: NDArray[np.floating], faces: NDArray[np.integer]
) -> float | None:
    """
    Intersect a ray with triangles, of which both sides count.

    Parameters
    ----------
    ray
        The ray, in the axes of the vertices.
    vertices
        The vertices (N, 3).
    faces
        The indices of the vertices of each triangle (M, 3).

    References
    ----------
    T. Moeller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.

    """
    corners = np.asarray(vertices, np.float64)[faces]
    origin, direction = np.array(ray.origin), np.array(ray.direction)
    along, across = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(direction, across)
    volume = np.einsum('ij,ij->i', along, normal)
    with np.errstate(divide='ignore', invalid='ignore'):
        to_origin = origin - corners[:, 0]
        first = np.einsum('ij,ij->i', to_origin, normal) / volume
        turned = np.cross(to_origin, along)
        second = turned @ direction / volume
        distances = np.einsum('ij,ij->i', across, turned) / volume
        is_within = (first >= 0.0) & (second >= 0.0) & (first + second <= 1.0)
    is_hit = is_within & (distances >= 0.0)
    return float(distances[is_hit].min()) if is_hit.any() else None


def unscaled(ray: Ray, scale: Sequence[float]) -> Ray | None:
    """
    Express a ray in the axes of a body before it was scaled; distances stay the same.

    Parameters
    ----------
    ray
        The ray, in the axes of the body.
    scale
        The scale along x, y and z.

    Returns
    -------
    Ray | None
        None for a scale of zero.

    """
    if not all(scale):
        return None
    return Ray(_divided(ray.origin, scale), _divided(ray.direction, scale))


def _divided(vector: Point, scale: Sequence[float]) -> Point:
    x, y, z = (part / factor for part, factor in zip(vector, scale))
    return x, y, z


def _slab(start: float, step: float, low: float, high: float) -> Span | None:
    """Return where a coordinate that grows along a ray is between two values."""
    if abs(step) < TINY:
        return (-math.inf, math.inf) if low <= start <= high else None
    ends = (low - start) / step, (high - start) / step
    return min(ends), max(ends)


def _round(origin: Sequence[float], direction: Sequence[float], radius: float) -> Span | None:
    """Return where a ray is within a circle or sphere around the origin."""
    square = sum(step * step for step in direction)
    beyond = sum(start * start for start in origin) - radius * radius
    if square < TINY * TINY:
        return (-math.inf, math.inf) if beyond <= 0.0 else None
    half = sum(start * step for start, step in zip(origin, direction)) / square
    root = half * half - beyond / square
    if root < 0.0:
        return None
    return -half - math.sqrt(root), -half + math.sqrt(root)


def _common(spans: Sequence[Span | None]) -> Span | None:
    """Return the intersection of spans."""
    start, end = -math.inf, math.inf
    for span in spans:
        if span is None:
            return None
        start, end = max(start, span[0]), min(end, span[1])
    return (start, end) if start <= end else None


def _first(span: Span | None) -> float | None:
    """Return where a ray first meets the surface of a body, from outside or from within."""
    if span is None or span[1] < 0.0:
        return None
    return span[0] if span[0] >= 0.0 else span[1]
