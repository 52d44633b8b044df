# SPDX-License-Identifier: Apache-2.0
"""A scene: a floor, and things on it."""

from __future__ import annotations

from dataclasses import dataclass, field
import math

from humanoid_simulation.errors import SimulationError

Vector = tuple[float, ...]
SIZES = {
    'box': ('length', 'width', 'height'),
    'sphere': ('radius',),
    'cylinder': ('radius', 'height'),
}
"""What the numbers of a size mean, by shape."""
FLOOR = 'floor'
WORLD = 'world'
"""What everything in it hangs on."""


@dataclass(frozen=True)
class Thing:
    """A box, sphere or cylinder; without a mass it is fixed. The position is of its centre."""

    name: str
    shape: str
    size_m: Vector
    position_m: Vector = (0.0, 0.0, 0.0)
    orientation_rpy_rad: Vector = (0.0, 0.0, 0.0)
    colour_rgba: Vector = (0.6, 0.6, 0.6, 1.0)
    mass_kg: float = 0.0
    friction: float = 1.0

    def __post_init__(self) -> None:
        """Refuse a thing that cannot be."""
        if self.shape not in SIZES or len(self.size_m) != len(SIZES[self.shape]):
            raise SimulationError(f"'{self.name}' is no {self.shape} with a size {self.size_m}.")
        numbers = (*self.size_m, *self.position_m, *self.orientation_rpy_rad, *self.colour_rgba)
        if not all(map(math.isfinite, (*numbers, self.mass_kg, self.friction))):
            raise SimulationError(f"'{self.name}' has a number that is not finite: {self}.")
        if min(self.size_m) <= 0.0 or self.mass_kg < 0.0 or self.friction < 0.0:
            raise SimulationError(
                f"'{self.name}' needs a size above zero, and no negative mass or friction: {self}."
            )

    @property
    def is_fixed(self) -> bool:
        """Tell whether nothing can move it."""
        return self.mass_kg == 0.0


@dataclass(frozen=True)
class Floor:
    """The ground at height zero."""

    friction: float = 1.0
    colours_rgb: tuple[Vector, Vector] = ((0.35, 0.4, 0.45), (0.25, 0.3, 0.35))
    """Of the two kinds of its tiles."""
    tile_m: float = 0.5

    def __post_init__(self) -> None:
        """Refuse a floor that cannot be."""
        if not 0.0 <= self.friction <= 10.0:
            raise SimulationError(
                f'The floor cannot have a friction of {self.friction:g}. Give one from 0 to 10; '
                '1 is rough, 0.3 is slippery.'
            )
        if not 0.01 <= self.tile_m <= 100.0:
            raise SimulationError(
                f'The floor cannot have tiles of {self.tile_m:g} m. Give 0.01 to 100 m.'
            )


@dataclass(frozen=True)
class Scene:
    """A floor, and things each of which has a name of its own."""

    name: str = 'flat'
    floor: Floor = field(default_factory=Floor)
    things: tuple[Thing, ...] = ()

    def __post_init__(self) -> None:
        """Refuse names that several things have."""
        names = [FLOOR, WORLD, *(thing.name for thing in self.things)]
        for name in names:
            if not name or names.count(name) > 1 or '/' in name:
                raise SimulationError(
                    f"Scene '{self.name}' cannot call a thing '{name}'. Every thing needs a name "
                    f"of its own, without a '/'; '{FLOOR}' is the floor, '{WORLD}' is all of it."
                )
