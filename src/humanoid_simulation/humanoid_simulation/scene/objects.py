# SPDX-License-Identifier: Apache-2.0
"""
The classes of graspable objects.

Round objects collide as cylinders or spheres. An upright cylinder stands on three small feet:
three contacts are cheaper to compute than those of a rim, and do not rock.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import math

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.parts import MESH, Part, Vector
from humanoid_simulation.scene.scene import COMPOSED, Thing

_GREEN = (0.25, 0.5, 0.2)
_PAPER = (0.95, 0.94, 0.88)
_LID = (0.9, 0.9, 0.9)
_STEM = (0.35, 0.25, 0.15)

Parts = tuple[Part, ...]


@dataclass(frozen=True)
class Class:
    """A class of graspable objects: builder, and default size, mass, colour and friction."""

    build: Callable[[Vector, Vector], Parts]
    size_m: Vector
    """Length, width and height."""
    mass_kg: float
    colour: str
    """The name of its default colour."""
    friction: float = 0.8


@dataclass(frozen=True)
class ObjectInstance:
    """An object of a class with its colour and pose: upright, with its bottom at a point."""

    name: str
    kind: str
    colour: str
    rgb: Vector
    bottom_m: Vector
    yaw_rad: float = 0.0
    size_m: Vector | None = None


def thing_of(graspable: ObjectInstance) -> Thing:
    """
    Build a graspable object; a size other than that of its class scales the mass by volume.

    Parameters
    ----------
    graspable
        The object; its kind is one of `CLASSES`.

    Returns
    -------
    Thing
        A movable object with its origin at half its height.

    Raises
    ------
    SimulationError
        An edge of its size is not in 5 mm to 1 m.

    """
    kind = CLASSES[graspable.kind]
    size_m = graspable.size_m or kind.size_m
    if not all(0.005 <= edge <= 1.0 for edge in size_m):
        raise SimulationError(f"'{graspable.name}' needs edges of 5 mm to 1 m, not {size_m}.")
    x_m, y_m, z_m = graspable.bottom_m
    ratio = math.prod(a / b for a, b in zip(size_m, kind.size_m))
    return Thing(
        graspable.name,
        COMPOSED,
        size_m,
        (x_m, y_m, z_m + size_m[2] / 2.0),
        (0.0, 0.0, graspable.yaw_rad),
        (*graspable.rgb, 1.0),
        kind.mass_kg * ratio,
        kind.friction,
        graspable.kind,
        graspable.colour,
        kind.build(size_m, graspable.rgb),
    )


def _seen(shape: str, size: Vector, at: Vector, rgb: Vector, mesh: str = '') -> Part:
    """Return a visual part, which does not collide."""
    return Part(shape, size, at, colour_rgba=(*rgb, 1.0), collides=False, mesh=mesh)


def _upright(size: Vector, rgb: Vector, is_shown: bool) -> Parts:
    """Return a cylinder on three feet."""
    length, width, height = size
    radius, foot = min(length, width) / 2.0, min(0.006, height / 6.0)
    feet = (
        Part(
            'sphere',
            (foot,),
            (turn[0] * 0.8 * radius, turn[1] * 0.8 * radius, foot - height / 2.0),
            is_shown=False,
        )
        for turn in ((1.0, 0.0), (-0.5, math.sqrt(0.75)), (-0.5, -math.sqrt(0.75)))
    )
    gap = 0.25 * foot
    body = Part(
        'cylinder',
        (radius, height - gap),
        (0.0, 0.0, gap / 2.0),
        colour_rgba=(*rgb, 1.0),
        is_shown=is_shown,
    )
    return (body, *feet)


def _mug(size: Vector, rgb: Vector) -> Parts:
    """Return a hollow mug with a handle."""
    length, width, height = size
    radius = min(length, width) / 2.0
    handle = (0.4 * radius, 0.3 * radius, 0.6 * height)
    return (
        *_upright(size, rgb, False),
        _seen(MESH, size, (0, 0, 0), rgb, 'mug'),
        _seen('box', (handle[0], handle[1], 0.012), (1.2 * radius, 0, 0.27 * height), rgb),
        _seen('box', (handle[0], handle[1], 0.012), (1.2 * radius, 0, -0.22 * height), rgb),
        _seen('box', (0.012, handle[1], 0.6 * height), (1.4 * radius, 0, 0.02 * height), rgb),
    )


def _bottle(size: Vector, rgb: Vector) -> Parts:
    """Return a bottle with a neck, a label and a lid."""
    length, width, height = size
    radius = min(length, width) / 2.0
    return (
        *_upright(size, rgb, False),
        _seen(MESH, size, (0, 0, 0), rgb, 'bottle'),
        _seen('cylinder', (1.01 * radius, 0.2 * height), (0, 0, -0.12 * height), _PAPER),
        _seen('cylinder', (0.42 * radius, 0.07 * height), (0, 0, 0.475 * height), _LID),
    )


def _can(size: Vector, rgb: Vector) -> Parts:
    """Return a can between two rims."""
    length, width, height = size
    radius = min(length, width) / 2.0
    rims = (
        _seen('cylinder', (0.92 * radius, 0.006), (0, 0, side * (height / 2 - 0.001)), _LID)
        for side in (-1, 1)
    )
    return (*_upright(size, rgb, True), *rims)


def _bowl(size: Vector, rgb: Vector) -> Parts:
    """Return a bowl, which collides as if it were full."""
    return (*_upright(size, rgb, False), _seen(MESH, size, (0, 0, 0), rgb, 'bowl'))


def _ball(size: Vector, rgb: Vector) -> Parts:
    """Return a sphere."""
    return (Part('sphere', (min(size) / 2.0,), colour_rgba=(*rgb, 1.0)),)


def _fruit(size: Vector, rgb: Vector) -> Parts:
    """Return a sphere with a stem and a leaf."""
    radius = min(size) / 2.0
    return (
        *_ball(size, rgb),
        _seen('cylinder', (0.003, 0.4 * radius), (0, 0, 1.1 * radius), _STEM),
        _seen(
            'box', (0.5 * radius, 0.25 * radius, 0.004), (0.3 * radius, 0, 1.2 * radius), _GREEN
        ),
    )


def _box(size: Vector, rgb: Vector) -> Parts:
    """Return a box with a strip of tape."""
    length, width, height = size
    return (
        Part('box', size, colour_rgba=(*rgb, 1.0)),
        _seen('box', (1.004 * length, 0.2 * width, 1.004 * height), (0, 0, 0), _PAPER),
    )


def _cube(size: Vector, rgb: Vector) -> Parts:
    """Return a toy brick."""
    return (Part('box', size, colour_rgba=(*rgb, 1.0)),)


def _book(size: Vector, rgb: Vector) -> Parts:
    """Return a book that lies flat, with its pages visible on three sides."""
    length, width, height = size
    return (
        Part('box', size, colour_rgba=(*rgb, 1.0)),
        _seen('box', (0.99 * length, width, 0.7 * height), (0.008 * length, 0, 0), _PAPER),
        _seen('box', (0.5 * length, 0.6 * width, 0.001), (0, 0, 0.5 * height), _PAPER),
    )


CLASSES: dict[str, Class] = {
    'mug': Class(_mug, (0.08, 0.08, 0.1), 0.25, 'white'),
    'bottle': Class(_bottle, (0.07, 0.07, 0.24), 0.4, 'green'),
    'can': Class(_can, (0.066, 0.066, 0.12), 0.35, 'red'),
    'bowl': Class(_bowl, (0.16, 0.16, 0.07), 0.3, 'blue'),
    'ball': Class(_ball, (0.1, 0.1, 0.1), 0.15, 'red'),
    'apple': Class(_fruit, (0.075, 0.075, 0.075), 0.16, 'red'),
    'orange': Class(_fruit, (0.08, 0.08, 0.08), 0.18, 'orange'),
    'box': Class(_box, (0.16, 0.1, 0.08), 0.25, 'brown'),
    'cube': Class(_cube, (0.06, 0.06, 0.06), 0.1, 'blue'),
    'book': Class(_book, (0.14, 0.2, 0.03), 0.35, 'blue'),
}
"""All classes, by their names in scene files."""
