# SPDX-License-Identifier: Apache-2.0
"""Triangulate the surfaces of shapes, for renderers of a scene."""

from __future__ import annotations

from functools import lru_cache
import math

from humanoid_control.dynamics.rotations import from_rpy
from humanoid_simulation.scene.meshes import revolved, Triangles, triangles_of
from humanoid_simulation.scene.parts import Part
from humanoid_simulation.scene.scene import Thing
import numpy as np

_SEGMENTS = 16
_RINGS = 8
_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def triangles_in_world(thing: Thing, part: Part) -> Triangles:
    """
    Triangulate the surface of a part of an object at the initial pose of the object.

    Parameters
    ----------
    thing
        The object, at its initial pose in the world.
    part
        One of its parts.

    Returns
    -------
    Triangles
        Corners (n, 3, 3), in m in the world frame.

    """
    unit = _unit(part.mesh or part.shape)
    own = (
        unit.reshape(-1, 3) * part.box_m @ from_rpy(*part.orientation_rpy_rad).T + part.position_m
    )
    placed = own @ from_rpy(*thing.orientation_rpy_rad).T + thing.position_m
    return np.asarray(placed.reshape(-1, 3, 3), dtype=np.float32)


@lru_cache(maxsize=32)
def _unit(shape: str) -> Triangles:
    """Triangulate a shape or mesh that fills a box of 1 x 1 x 1 m."""
    if shape == 'box':
        quads = np.array([_CORNERS[list(side)] for side in _SIDES])
        return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.float32)
    if shape == 'cylinder':
        return revolved([(0.0, -0.5), (0.5, -0.5), (0.5, 0.5), (0.0, 0.5)], _SEGMENTS)
    if shape == 'sphere':
        angles = [math.pi * ring / _RINGS for ring in range(_RINGS + 1)]
        circle = [(0.5 * math.sin(each), -0.5 * math.cos(each)) for each in angles]
        return revolved(circle, _SEGMENTS)
    return triangles_of(shape)
