# SPDX-License-Identifier: Apache-2.0
"""The shapes and colours that furniture is made of."""

from __future__ import annotations

import math

from humanoid_simulation.scene.parts import MESH, Part, Vector

WOOD = (0.55, 0.38, 0.22)
DARK = (0.2, 0.2, 0.22)
WHITE = (0.93, 0.93, 0.91)
STEEL = (0.72, 0.73, 0.75)
BOARD_M = 0.03
"""The thickness of a board."""
ACROSS = (0.0, math.pi / 2.0, 0.0)
"""The orientation that lays an upright rod along x."""

Parts = list[Part]


def box(
    size: Vector, at: Vector, rgb: Vector, *, turn: Vector = (0.0, 0.0, 0.0), hits: bool = True
) -> Part:
    """
    Build a box.

    Parameters
    ----------
    size
        Length (x), width (y) and height (z), in m.
    at
        Its centre (3,) in the axes of the piece, in m.
    rgb
        Red, green and blue, 0 to 1.
    turn
        Roll, pitch and yaw, in rad.
    hits
        Whether it collides.

    """
    return Part('box', size, at, turn, (*rgb, 1.0), collides=hits)


def rod(
    radius: float,
    height: float,
    at: Vector,
    rgb: Vector,
    *,
    turn: Vector = (0.0, 0.0, 0.0),
    hits: bool = True,
    shine: float = 0.0,
) -> Part:
    """
    Build a cylinder.

    Parameters
    ----------
    radius, height
        Its size, in m; its axis is z before it is turned.
    at, rgb, turn, hits
        As for `box`.
    shine
        Emission of light, 0 to 1.

    """
    return Part('cylinder', (radius, height), at, turn, (*rgb, 1.0), collides=hits, shine=shine)


def mesh(name: str, size: Vector, at: Vector, rgb: Vector, shine: float = 0.0) -> Part:
    """
    Build a mesh, which does not collide.

    Parameters
    ----------
    name
        One of `meshes.PROFILES`.
    size
        The box that it fills: length (x), width (y) and height (z), in m.
    at, rgb
        As for `box`.
    shine
        Emission of light, 0 to 1.

    """
    return Part(MESH, size, at, colour_rgba=(*rgb, 1.0), collides=False, mesh=name, shine=shine)


def darker(rgb: Vector, by: float = 0.75) -> Vector:
    """
    Darken a colour.

    Parameters
    ----------
    rgb
        Red, green and blue, 0 to 1.
    by
        The factor to scale it by, 0 to 1: the smaller, the darker.

    """
    return tuple(by * part for part in rgb)


def lighter(rgb: Vector) -> Vector:
    """
    Lighten a colour by 15 % of its distance from white.

    Parameters
    ----------
    rgb
        Red, green and blue, 0 to 1.

    """
    return tuple(part + 0.15 * (1.0 - part) for part in rgb)
