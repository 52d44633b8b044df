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
"""Turns a rod, which stands, so that it lies along x."""

Parts = list[Part]


def box(
    size: Vector, at: Vector, rgb: Vector, *, turn: Vector = (0.0, 0.0, 0.0), hits: bool = True
) -> Part:
    """Return a box by its size and centre."""
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
    """Return a cylinder by its size and centre."""
    return Part('cylinder', (radius, height), at, turn, (*rgb, 1.0), collides=hits, shine=shine)


def mesh(name: str, size: Vector, at: Vector, rgb: Vector, shine: float = 0.0) -> Part:
    """Return a mesh, which is seen only."""
    return Part(MESH, size, at, colour_rgba=(*rgb, 1.0), collides=False, mesh=name, shine=shine)


def darker(rgb: Vector, by: float = 0.75) -> Vector:
    """Return a darker colour."""
    return tuple(by * part for part in rgb)


def lighter(rgb: Vector) -> Vector:
    """Return a lighter colour."""
    return tuple(part + 0.15 * (1.0 - part) for part in rgb)
