# SPDX-License-Identifier: Apache-2.0
"""A scene: a floor, the objects on it, and its named rooms and places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
import math
from typing import Protocol, TypeVar

from humanoid_simulation.errors import named, SimulationError
from humanoid_simulation.scene.outlines import area_m2, contains, Outline, Point
from humanoid_simulation.scene.parts import Finish, Part, SIZES, Vector

__all__ = [
    'FLOOR',
    'SIZES',
    'WORLD',
    'Floor',
    'Place',
    'Room',
    'Scene',
    'Surface',
    'Thing',
    'Vector',
]

FLOOR = 'floor'
WORLD = 'world'
"""The name of the world itself, to which all objects are attached."""
COMPOSED = 'composed'
"""The shape of an object that consists of its details only."""
WALL = 'wall'
"""The class of walls, which are cut in views into the rooms."""


@dataclass(frozen=True)
class Thing:
    """
    An object: a body of one shape and optional details; without a mass it is fixed.

    The position is that of the centre of the shape, and the initial one of a movable object.
    Details are in the frame of the object, and have no mass unless it consists of details only.
    """

    name: str
    shape: str
    size_m: Vector
    position_m: Vector = (0.0, 0.0, 0.0)
    orientation_rpy_rad: Vector = (0.0, 0.0, 0.0)
    colour_rgba: Vector = (0.6, 0.6, 0.6, 1.0)
    mass_kg: float = 0.0
    friction: float = 1.0
    kind: str = ''
    """Its class, such as `mug`, `table` or `wall`; empty if not given."""
    colour: str = ''
    """The name of its colour, if it has one."""
    details: tuple[Part, ...] = ()

    def __post_init__(self) -> None:
        """Validate the shape, its size, and the other numbers."""
        if self.shape == COMPOSED:
            sound = len(self.size_m) == 3 and bool(self.details)
        else:
            sound = self.shape in SIZES and len(self.size_m) == len(SIZES[self.shape])
        if not sound:
            raise SimulationError(
                f"'{self.name}' is invalid: a {self.shape} cannot have the size {self.size_m}."
            )
        numbers = (*self.size_m, *self.position_m, *self.orientation_rpy_rad, *self.colour_rgba)
        if not all(map(math.isfinite, (*numbers, self.mass_kg, self.friction))):
            raise SimulationError(f"'{self.name}' has a value that is not finite: {self}.")
        if min(self.size_m) <= 0.0 or self.mass_kg < 0.0 or self.friction < 0.0:
            raise SimulationError(
                f"'{self.name}' needs a size above zero, and no negative mass or friction: {self}."
            )

    @property
    def is_fixed(self) -> bool:
        """Whether the object is fixed in the world: it has no mass."""
        return self.mass_kg == 0.0

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """All shapes of the object."""
        if self.shape == COMPOSED:
            return self.details
        return (Part(self.shape, self.size_m, colour_rgba=self.colour_rgba), *self.details)

    @property
    def box_m(self) -> Vector:
        """Return the length, width and height of the object, in its own axes."""
        return self.size_m if self.shape == COMPOSED else self.parts[0].box_m


@dataclass(frozen=True)
class Floor:
    """The ground plane at height zero."""

    friction: float = 1.0
    colours_rgb: tuple[Vector, Vector] = ((0.35, 0.4, 0.45), (0.25, 0.3, 0.35))
    """The two colours of its checkered tiles."""
    tile_m: float = 0.5

    def __post_init__(self) -> None:
        """Validate the friction and the size of the tiles."""
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
class Room:
    """A named area of the ground."""

    name: str
    outline_m: Outline
    """The corners, in order; the last one is joined to the first one."""
    floor: Finish | None = None
    walls: Finish | None = None
    """The finish of the wall faces towards the room."""
    ceiling_m: float = 0.0
    """The height of its ceiling; 0 for none."""

    def __post_init__(self) -> None:
        """Validate the name and the outline."""
        if not self.name or len(self.outline_m) < 3 or area_m2(self.outline_m) < 1e-3:
            raise SimulationError(
                f"Room '{self.name}' needs a name, and an outline of at least three corners, in "
                'order and not all on one line.'
            )

    def contains(self, x_m: float, y_m: float) -> bool:
        """
        Check whether a point on the ground is in the room.

        Parameters
        ----------
        x_m, y_m
            The point, in the world frame.

        """
        return contains(self.outline_m, (x_m, y_m))


def room_at(rooms: Sequence[Room], x_m: float, y_m: float) -> Room | None:
    """
    Find the first room that contains a point on the ground.

    Parameters
    ----------
    rooms
        The rooms to search, in this order.
    x_m, y_m
        The point, in the world frame.

    Returns
    -------
    Room or None
        The room; None outside of all rooms.

    """
    return next((room for room in rooms if room.contains(x_m, y_m)), None)


@dataclass(frozen=True)
class Surface:
    """A horizontal surface that objects can stand on."""

    name: str
    """The name of its furniture; lower boards of a shelf add their number, as in `shelf/1`."""
    outline_m: Outline
    height_m: float

    def contains(self, x_m: float, y_m: float) -> bool:
        """
        Check whether a point is on the surface, as seen from above.

        Parameters
        ----------
        x_m, y_m
            The point, in the world frame.

        """
        return contains(self.outline_m, (x_m, y_m))

    @property
    def centre_m(self) -> Point:
        """Return the centre of the bounding box of the outline."""
        xs, ys = zip(*self.outline_m)
        return (min(xs) + max(xs)) / 2.0, (min(ys) + max(ys)) / 2.0


@dataclass(frozen=True)
class Place:
    """A navigation target: a pose to stand at, and the surface within reach from it, if any."""

    name: str
    room: str
    """The room that the pose is in; empty outside of all rooms."""
    x_m: float
    y_m: float
    yaw_rad: float
    surface: Surface | None = None


class _Named(Protocol):
    @property
    def name(self) -> str: ...


N = TypeVar('N', bound=_Named)


@dataclass(frozen=True)
class Scene:
    """A floor, and objects, rooms and places with unique names."""

    name: str = 'flat'
    floor: Floor = field(default_factory=Floor)
    things: tuple[Thing, ...] = ()
    rooms: tuple[Room, ...] = ()
    places: tuple[Place, ...] = ()
    surfaces: tuple[Surface, ...] = ()

    def __post_init__(self) -> None:
        """Reject duplicate, reserved and malformed names."""
        names = [FLOOR, WORLD, *(thing.name for thing in self.things)]
        for name in names:
            if not name or names.count(name) > 1 or '/' in name:
                raise SimulationError(
                    f"Scene '{self.name}' cannot name an object '{name}'. Object names must be "
                    f"unique and without '/'; '{FLOOR}' is the floor, '{WORLD}' is the whole "
                    'scene.'
                )
        for kind, those in (('rooms', self.rooms), ('places', self.places)):
            _refuse_twice(f"Scene '{self.name}' has two {kind} named", those)

    @property
    def objects(self) -> tuple[Thing, ...]:
        """Return the movable objects, at their initial poses."""
        return tuple(thing for thing in self.things if not thing.is_fixed)

    def room(self, name: str) -> Room:
        """
        Look up a room.

        Parameters
        ----------
        name
            Its name.

        Raises
        ------
        SimulationError
            There is no such room; the message suggests others.

        """
        return named('room', name, {room.name: room for room in self.rooms})

    def place(self, name: str) -> Place:
        """
        Look up a place.

        Parameters
        ----------
        name
            Its name.

        Raises
        ------
        SimulationError
            There is no such place; the message suggests others.

        """
        return named('place', name, {place.name: place for place in self.places})

    def thing(self, name: str) -> Thing:
        """
        Look up an object, fixed or movable.

        Parameters
        ----------
        name
            Its name.

        Raises
        ------
        SimulationError
            There is no such object; the message suggests others.

        """
        return named('thing', name, {thing.name: thing for thing in self.things})

    def surface(self, name: str) -> Surface:
        """
        Look up a surface.

        Parameters
        ----------
        name
            Its name: that of its furniture, with a number for lower boards (`shelf/1`).

        Raises
        ------
        SimulationError
            There is no such surface; the message suggests others.

        """
        return named('surface', name, {surface.name: surface for surface in self.surfaces})

    def room_at(self, x_m: float, y_m: float) -> Room | None:
        """
        Find the room that contains a point on the ground.

        Parameters
        ----------
        x_m, y_m
            The point, in the world frame.

        Returns
        -------
        Room or None
            The room; None outside of all rooms.

        """
        return room_at(self.rooms, x_m, y_m)


def _refuse_twice(sentence: str, those: Sequence[N]) -> None:
    """Raise SimulationError for a duplicate name."""
    names = [each.name for each in those]
    for name in names:
        if names.count(name) > 1:
            raise SimulationError(f"{sentence} '{name}'. Give each a unique name.")
