# SPDX-License-Identifier: Apache-2.0
"""The shapes that all objects in a scene consist of."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_simulation.errors import SimulationError

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
                f'A surface cannot have {self.pattern} of {self.tile_m:g} m. Give one of '
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
            raise SimulationError(f'There is no {self.shape} with a size {self.size_m}.')
        numbers = (*self.size_m, *self.position_m, *self.orientation_rpy_rad, *self.colour_rgba)
        if not all(map(math.isfinite, numbers)):
            raise SimulationError(f'A {self.shape} has a number that is not finite: {numbers}.')
        if min(self.size_m) <= 0.0:
            raise SimulationError(f'A {self.shape} needs a size above zero, not {self.size_m}.')
        if (self.shape == MESH) != bool(self.mesh) or (self.mesh and self.collides):
            raise SimulationError('A mesh needs a name, and does not collide.')

    @property
    def box_m(self) -> Vector:
        """Return the length, width and height of its bounding box, in its own axes."""
        if self.shape == 'sphere':
            return (2.0 * self.size_m[0],) * 3
        if self.shape == 'cylinder':
            radius, height = self.size_m
            return (2.0 * radius, 2.0 * radius, height)
        return self.size_m
