# SPDX-License-Identifier: Apache-2.0
"""Where rays meet markers, and how markers look that are highlighted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Optional

import numpy as np
from rviz_common.selection import Ray
from rviz_default_plugins.bodies import HIGHLIGHT_COLOR
from rviz_default_plugins.markers.drawing import ARROW
from rviz_default_plugins.markers.look import Look
from rviz_default_plugins.markers.mesh import mesh_of
from rviz_default_plugins.ray_hits import (
    hit_box,
    hit_cylinder,
    hit_sphere,
    hit_triangles,
    unscaled,
)
from visualization_msgs.msg import Marker

__all__ = ['highlighted', 'hit_look']

HitUnit = Callable[[Ray, Look], Optional[float]]
"""Intersects a ray, in the axes of a marker before it was scaled, with its body."""

MARGIN = 1.02
"""The scale of what covers a body, so that it is outside of it."""


def hit_look(ray: Ray, look: Look) -> float | None:
    """
    Intersect a ray with a marker; lines, points, texts and arrows between points are never met.

    Parameters
    ----------
    ray
        The ray, in the axes of the marker.
    look
        The look of the marker.

    Returns
    -------
    float | None
        How many times the direction the marker is from the origin of the ray; None if the ray
        passes it by.

    """
    if look.kind in LISTS:
        return _hit_copies(ray, look, LISTS[look.kind])
    hit = SINGLE.get(look.kind)
    scaled = unscaled(ray, look.scale)
    return None if hit is None or scaled is None else hit(scaled, look)


def highlighted(look: Look) -> Look:
    """
    Return the look of what covers a marker that is highlighted.

    Parameters
    ----------
    look
        The look of the marker.

    """
    red, green, blue, alpha = HIGHLIGHT_COLOR
    x, y, z = look.scale
    factor = MARGIN if look.kind in COVERED else 1.0
    return replace(
        look,
        color=(round(red * 255), round(green * 255), round(blue * 255)),
        alpha=alpha,
        colors=None,
        alphas=None,
        scale=(x * factor, y * factor, z * factor),
        mesh=(look.mesh[0], False),
    )


def _hit_box(ray: Ray, look: Look) -> float | None:
    return hit_box(ray, (1.0, 1.0, 1.0))


def _hit_sphere(ray: Ray, look: Look) -> float | None:
    return hit_sphere(ray, 0.5)


def _hit_cylinder(ray: Ray, look: Look) -> float | None:
    return hit_cylinder(ray, 0.5, 1.0)


def _hit_arrow(ray: Ray, look: Look) -> float | None:
    return None if len(look.points) else hit_triangles(ray, *ARROW)


def _hit_triangles(ray: Ray, look: Look) -> float | None:
    faces = np.arange(len(look.points)).reshape(-1, 3)
    return hit_triangles(ray, look.points, faces)


def _hit_mesh(ray: Ray, look: Look) -> float | None:
    surfaces = mesh_of(look.mesh[0]).surfaces
    hits = [hit_triangles(ray, each.vertices, each.faces) for each in surfaces]
    return min((hit for hit in hits if hit is not None), default=None)


def _hit_copies(ray: Ray, look: Look, hit: HitUnit) -> float | None:
    """Intersect a ray with copies of a body at the points of a marker."""
    hits = []
    for x, y, z in look.points.tolist():
        a, b, c = ray.origin
        scaled = unscaled(Ray((a - x, b - y, c - z), ray.direction), look.scale)
        hits.append(None if scaled is None else hit(scaled, look))
    return min((each for each in hits if each is not None), default=None)


SINGLE: dict[int, HitUnit] = {
    Marker.ARROW: _hit_arrow,
    Marker.CUBE: _hit_box,
    Marker.SPHERE: _hit_sphere,
    Marker.CYLINDER: _hit_cylinder,
    Marker.MESH_RESOURCE: _hit_mesh,
    Marker.TRIANGLE_LIST: _hit_triangles,
}
LISTS: dict[int, HitUnit] = {Marker.CUBE_LIST: _hit_box, Marker.SPHERE_LIST: _hit_sphere}
COVERED = (Marker.CUBE, Marker.SPHERE, Marker.CYLINDER, Marker.CUBE_LIST, Marker.SPHERE_LIST)
