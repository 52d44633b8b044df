# SPDX-License-Identifier: Apache-2.0
"""Inflation of bodies, so that they are visible around others at the same place."""

from __future__ import annotations

from dataclasses import replace

from urdf import Box, Capsule, Cylinder, Geometry, Mesh, Shape, Sphere

__all__ = ['inflated']

MESH_SIZE_M = 0.3
"""The assumed size of meshes, whose actual size is only known once they are read."""


def inflated(shape: Shape, margin_m: float) -> Shape:
    """
    Enlarge a body, so that its whole surface moves outwards by a margin.

    Parameters
    ----------
    shape
        The body. A mesh is scaled as if it were 0.3 m large.
    margin_m
        The margin, in m.

    """
    return replace(shape, geometry=_inflated(shape.geometry, margin_m)) if margin_m else shape


def _inflated(body: Geometry, margin_m: float) -> Geometry:
    if isinstance(body, Box):
        x, y, z = body.size
        return Box((x + 2 * margin_m, y + 2 * margin_m, z + 2 * margin_m))
    if isinstance(body, Cylinder):
        return Cylinder(body.radius + margin_m, body.length + 2 * margin_m)
    if isinstance(body, Capsule):
        return Capsule(body.radius + margin_m, body.length)
    if isinstance(body, Sphere):
        return Sphere(body.radius + margin_m)
    factor = 1.0 + 2 * margin_m / MESH_SIZE_M
    x, y, z = body.scale
    return Mesh(body.file, (x * factor, y * factor, z * factor))
