# SPDX-License-Identifier: Apache-2.0
"""What all objects in a scene consist of: shapes, finishes and colours."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_description.robot import Array
from humanoid_description.rotations import from_rpy
from humanoid_simulation.errors import SimulationError
import numpy as np

Vector = tuple[float, ...]
SIZES = {
    'box': ('length', 'width', 'height'),
    'sphere': ('radius',),
    'cylinder': ('radius', 'height'),
}
"""The meaning of the components of a size, by shape."""
MESH = 'mesh'
"""The shape of visual parts that are meshes: a file of the folder `meshes`, scaled to a size."""
PATTERNS = ('plain', 'tiles', 'planks', 'stripes', 'carpet')
COLOURS: dict[str, Vector] = {
    'red': (0.82, 0.1, 0.1),
    'blue': (0.1, 0.22, 0.82),
    'green': (0.1, 0.6, 0.16),
    'yellow': (0.95, 0.82, 0.1),
    'orange': (0.95, 0.45, 0.05),
    'purple': (0.45, 0.15, 0.6),
    'pink': (0.95, 0.45, 0.65),
    'brown': (0.45, 0.28, 0.14),
    'white': (0.94, 0.94, 0.92),
    'grey': (0.5, 0.5, 0.52),
    'black': (0.08, 0.08, 0.09),
}
"""The named colours, which are far enough apart to be distinguished in an image."""
WOOD = (0.55, 0.38, 0.22)
DARK = (0.2, 0.2, 0.22)
WHITE = (0.93, 0.93, 0.91)
STEEL = (0.72, 0.73, 0.75)
BOARD_M = 0.03
"""The thickness of a board."""
ACROSS = (0.0, math.pi / 2.0, 0.0)
"""The orientation that lays an upright rod along x."""


@dataclass(frozen=True)
class Finish:
    """The finish of a surface: a pattern in two colours, which repeats every `tile_m`."""

    pattern: str = 'plain'
    first_rgb: Vector = (0.6, 0.6, 0.6)
    second_rgb: Vector = (0.5, 0.5, 0.5)
    tile_m: float = 0.5

    def __post_init__(self) -> None:
        """Validate the pattern and its period."""
        if self.pattern not in PATTERNS or not 0.01 <= self.tile_m <= 100.0:
            raise SimulationError(
                f'A surface pattern cannot be {self.pattern} of {self.tile_m:g} m. Give one of '
                f'{", ".join(PATTERNS)}, which repeats after 0.01 to 100 m.'
            )

    @property
    def mean_rgb(self) -> Vector:
        """Return the mean colour, as seen from far away."""
        if self.pattern == 'plain':
            return self.first_rgb
        return tuple((a + b) / 2.0 for a, b in zip(self.first_rgb, self.second_rgb))


@dataclass(frozen=True)
class Part:
    """
    A shape with its pose in the frame of the object that it belongs to.

    A part that collides but is not shown stands in for a mesh; one that is shown but does not
    collide is decoration.
    """

    shape: str
    size_m: Vector
    """As in `SIZES`; for a mesh the length, width and height."""
    position_m: Vector = (0.0, 0.0, 0.0)
    """The position of its centre."""
    orientation_rpy_rad: Vector = (0.0, 0.0, 0.0)
    colour_rgba: Vector = (0.6, 0.6, 0.6, 1.0)
    collides: bool = True
    is_shown: bool = True
    mesh: str = ''
    """The name of the mesh, if the shape is `MESH`."""
    finish: Finish | None = None
    """For the two faces of a box normal to its local z axis; otherwise its colour is plain."""
    shine: float = 0.0
    """Emission of light, as of a lamp, 0 to 1."""

    def __post_init__(self) -> None:
        """Validate the shape, its size, its numbers and its mesh."""
        count = 3 if self.shape == MESH else len(SIZES.get(self.shape, ()))
        if not count or len(self.size_m) != count:
            raise SimulationError(f'A {self.shape} cannot have the size {self.size_m}.')
        numbers = (*self.size_m, *self.position_m, *self.orientation_rpy_rad, *self.colour_rgba)
        if not all(map(math.isfinite, numbers)):
            raise SimulationError(f'A {self.shape} has a value that is not finite: {numbers}.')
        if min(self.size_m) <= 0.0:
            raise SimulationError(f'A {self.shape} needs a size above zero, not {self.size_m}.')
        if (self.shape == MESH) != bool(self.mesh) or (self.mesh and self.collides):
            raise SimulationError('A mesh needs a name, and cannot collide.')

    @property
    def box_m(self) -> Vector:
        """Return the length, width and height of its bounding box, in its own axes."""
        if self.shape == 'sphere':
            return (2.0 * self.size_m[0],) * 3
        if self.shape == 'cylinder':
            radius, height = self.size_m
            return (2.0 * radius, 2.0 * radius, height)
        return self.size_m

    @property
    def extent_m(self) -> Array:
        """Return how far it reaches from its centre (3,), in the axes of the object."""
        turn = np.abs(from_rpy(*self.orientation_rpy_rad))
        if self.shape == 'sphere':
            return np.full(3, self.size_m[0])
        if self.shape == 'cylinder':
            radius, height = self.size_m
            across = np.hypot(turn[:, 0], turn[:, 1])
            return np.asarray(radius * across + height / 2.0 * turn[:, 2])
        return np.asarray(turn @ self.box_m) / 2.0


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
