# SPDX-License-Identifier: Apache-2.0
"""What viewers are shown of an object: which of its parts, and their surfaces as triangles."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
import math

from humanoid_description.rotations import from_rpy
from humanoid_simulation.scene.furniture import HANGING
from humanoid_simulation.scene.meshes import revolved, Triangles, triangles_of
from humanoid_simulation.scene.parts import Part
from humanoid_simulation.scene.scene import Thing, WALL
from humanoid_simulation.scene.walls import CEILING
import numpy as np

_SEGMENTS = 16
_RINGS = 8
_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def parts_below(thing: Thing, height_m: float) -> tuple[Part, ...]:
    """
    Select the visible parts of an object for a view in which walls are cut at a height.

    Walls are cut. Ceilings, and objects that hang on walls or from ceilings, are left out if they
    reach above that height; all other objects are unchanged.

    Parameters
    ----------
    thing
        The object.
    height_m
        Height of the cut above the ground.

    Returns
    -------
    tuple of Part
        The visible parts, in the frame of the object.

    """
    shown = tuple(part for part in thing.parts if part.is_shown)
    if thing.kind == WALL:
        cut = (_cut(part, height_m - thing.position_m[2]) for part in shown)
        return tuple(part for part in cut if part is not None)
    if thing.kind in (CEILING, *HANGING):
        top_m = thing.position_m[2] + max(map(_top_m, shown))
        return shown if top_m <= height_m else ()
    return shown


def _top_m(part: Part) -> float:
    """Return the height of the highest point of a part, in the frame of its object."""
    return float(part.position_m[2] + part.extent_m[2])


def _cut(part: Part, height_m: float) -> Part | None:
    """Return the piece of an upright box below a height; None if there is none."""
    # Wallpaper is a board that stands on its edge: see `walls`.
    upright = 1 if math.isclose(part.orientation_rpy_rad[0], math.pi / 2.0) else 2
    size, (x_m, y_m, z_m) = list(part.size_m), part.position_m
    if part.shape != 'box':
        return part if _top_m(part) <= height_m else None
    low_m = z_m - size[upright] / 2.0
    top_m = min(z_m + size[upright] / 2.0, height_m)
    if top_m - low_m < 1e-3:
        return None
    size[upright] = top_m - low_m
    return replace(part, size_m=tuple(size), position_m=(x_m, y_m, (low_m + top_m) / 2.0))


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
