# SPDX-License-Identifier: Apache-2.0
"""Build walls with doors, floors and ceilings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import math

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.outlines import Point, rectangles_of, turned
from humanoid_simulation.scene.parts import Finish, Part, Vector
from humanoid_simulation.scene.scene import COMPOSED, Room, room_at, Thing, WALL

CEILING = 'ceiling'
FLOORING = 'flooring'
NARROWEST_DOOR_M = 0.9
"""The narrowest door that the robot fits through, including its arms."""
_PAPER_M = 0.002
_FRAME_M = 0.045
_FRAME_RGBA = (0.93, 0.92, 0.88, 1.0)
_SHORTEST_M = 0.02


@dataclass(frozen=True)
class Door:
    """A doorway: an opening in a wall, without a door leaf."""

    at_m: float
    """The distance of its centre from the start of the wall."""
    width_m: float = 1.0
    height_m: float = 2.0


@dataclass(frozen=True)
class Wall:
    """A straight wall between two points on its centre line."""

    name: str
    from_m: Point
    to_m: Point
    height_m: float = 2.3
    thickness_m: float = 0.1
    rgb: Vector = (0.9, 0.89, 0.86)
    doors: tuple[Door, ...] = ()

    def __post_init__(self) -> None:
        """Validate the dimensions and the doors."""
        if not (self.length_m > 0.1 and 0.1 <= self.height_m <= 10.0):
            raise SimulationError(f"Wall '{self.name}' needs a length and a height above 0.1 m.")
        if not 0.02 <= self.thickness_m <= 1.0:
            raise SimulationError(f"Wall '{self.name}' needs a thickness of 0.02 to 1 m.")
        end_m = 0.0
        for door in self.doors:
            if door.width_m < NARROWEST_DOOR_M:
                raise SimulationError(
                    f"Wall '{self.name}' has a door of {door.width_m:g} m. The robot needs "
                    f'{NARROWEST_DOOR_M:g} m or more.'
                )
            start_m = door.at_m - door.width_m / 2.0
            if start_m < end_m - 1e-9 or door.at_m + door.width_m / 2.0 > self.length_m + 1e-9:
                raise SimulationError(
                    f"Wall '{self.name}' has no room for the door at {door.at_m:g} m: doors must "
                    f'lie within its {self.length_m:g} m, in order, without overlap.'
                )
            end_m = door.at_m + door.width_m / 2.0

    @property
    def length_m(self) -> float:
        """Return the length of the wall, between its two points."""
        return math.dist(self.from_m, self.to_m)

    @property
    def yaw_rad(self) -> float:
        """Return the heading from its start to its end."""
        return math.atan2(self.to_m[1] - self.from_m[1], self.to_m[0] - self.from_m[0])

    def pieces(self) -> Iterator[tuple[float, float, float, float]]:
        """Yield the solid pieces of the wall: start and end along it, bottom and top."""
        start_m = -self.thickness_m / 2.0  # so that walls that meet leave no notch
        for door in self.doors:
            left_m, right_m = door.at_m - door.width_m / 2.0, door.at_m + door.width_m / 2.0
            yield start_m, left_m, 0.0, self.height_m
            if door.height_m < self.height_m:
                yield left_m, right_m, door.height_m, self.height_m
            start_m = right_m
        yield start_m, self.length_m + self.thickness_m / 2.0, 0.0, self.height_m


def wall_of(wall: Wall, rooms: Sequence[Room]) -> Thing:
    """
    Build a wall with its doorways, papered with the finishes of the rooms that it faces.

    Parameters
    ----------
    wall
        Its geometry.
    rooms
        All rooms of the scene.

    Returns
    -------
    Thing
        A fixed object with its origin at the start of the wall, x along it.

    """
    parts: list[Part] = []
    for start_m, end_m, low_m, high_m in wall.pieces():
        if end_m - start_m < _SHORTEST_M:
            continue
        size = (end_m - start_m, wall.thickness_m, high_m - low_m)
        middle = ((start_m + end_m) / 2.0, 0.0, (low_m + high_m) / 2.0)
        parts.append(Part('box', size, middle, colour_rgba=(*wall.rgb, 1.0)))
        for side in (1.0, -1.0):
            parts.extend(_papers(wall, rooms, side, (start_m, end_m), (low_m, high_m)))
    for door in wall.doors:
        parts.extend(_frame(wall, door))
    return Thing(
        wall.name,
        COMPOSED,
        (wall.length_m, wall.thickness_m, wall.height_m),
        (*wall.from_m, 0.0),
        (0.0, 0.0, wall.yaw_rad),
        (*wall.rgb, 1.0),
        kind=WALL,
        details=tuple(parts),
    )


def _papers(
    wall: Wall,
    rooms: Sequence[Room],
    side: float,
    along_m: tuple[float, float],
    up_m: tuple[float, float],
) -> Iterator[Part]:
    """Yield the wallpaper on a side of a piece, one part per adjacent room."""
    beside_m = side * (wall.thickness_m / 2.0 + 0.05)
    for start_m, end_m in _stretches(wall, rooms, along_m):
        point = turned(((start_m + end_m) / 2.0, beside_m), wall.yaw_rad, wall.from_m)
        room = room_at(rooms, *point)
        if room is not None and room.walls is not None:
            middle_m = (start_m + end_m) / 2.0, side * (wall.thickness_m + _PAPER_M) / 2.0
            yield Part(
                'box',
                # On its edge: the finish is on the faces normal to the local z axis.
                (end_m - start_m, up_m[1] - up_m[0], _PAPER_M),
                (*middle_m, (up_m[0] + up_m[1]) / 2.0),
                (math.pi / 2.0, 0.0, 0.0),
                (*room.walls.mean_rgb, 1.0),
                collides=False,
                finish=room.walls,
            )


def _stretches(
    wall: Wall, rooms: Sequence[Room], along_m: tuple[float, float]
) -> Iterator[tuple[float, float]]:
    """Yield the intervals of a piece within which the adjacent room does not change."""
    corners_m = {along_m[0], along_m[1]}
    for room in rooms:
        for x_m, y_m in room.outline_m:
            offset = x_m - wall.from_m[0], y_m - wall.from_m[1]
            here_m, _ = turned(offset, -wall.yaw_rad)
            if along_m[0] < here_m < along_m[1]:
                corners_m.add(here_m)
    ordered_m = sorted(corners_m)
    for start_m, end_m in zip(ordered_m, ordered_m[1:]):
        if end_m - start_m > _SHORTEST_M:
            yield start_m, end_m


def _frame(wall: Wall, door: Door) -> Iterator[Part]:
    """Yield the frame of a door; it does not collide, so it does not narrow the doorway."""
    depth_m = wall.thickness_m + 0.03
    for side in (-1.0, 1.0):
        x_m = door.at_m + side * (door.width_m + _FRAME_M) / 2.0
        yield Part(
            'box',
            (_FRAME_M, depth_m, door.height_m),
            (x_m, 0.0, door.height_m / 2.0),
            colour_rgba=_FRAME_RGBA,
            collides=False,
        )
    yield Part(
        'box',
        (door.width_m + 2.0 * _FRAME_M, depth_m, _FRAME_M),
        (door.at_m, 0.0, door.height_m + _FRAME_M / 2.0),
        colour_rgba=_FRAME_RGBA,
        collides=False,
    )


def flooring_of(room: Room) -> Iterator[Thing]:
    """
    Build the floor and the ceiling of a room, which do not collide.

    Parameters
    ----------
    room
        The room; it gets neither if an edge of its outline is not parallel to an axis.

    Yields
    ------
    Thing
        The floor if the room has a finish for it, then the ceiling if it has a height.

    """
    boxes = rectangles_of(room.outline_m)
    if room.floor is not None and boxes:
        yield _slabs(f'{room.name}_floor', FLOORING, boxes, 0.0, room.floor)
    if room.ceiling_m > 0.0 and boxes:
        white = Finish('plain', (0.95, 0.95, 0.93))
        yield _slabs(f'{room.name}_ceiling', CEILING, boxes, room.ceiling_m, white)


def _slabs(
    name: str,
    kind: str,
    boxes: Sequence[tuple[Point, Point]],
    height_m: float,
    finish: Finish,
) -> Thing:
    """Build thin slabs at a height, as one object."""
    parts = tuple(
        Part(
            'box',
            (x2 - x1, y2 - y1, _PAPER_M),
            ((x1 + x2) / 2.0, (y1 + y2) / 2.0, height_m),
            colour_rgba=(*finish.mean_rgb, 1.0),
            collides=False,
            finish=finish,
        )
        for (x1, y1), (x2, y2) in boxes
    )
    return Thing(
        name, COMPOSED, (1.0, 1.0, _PAPER_M), colour_rgba=parts[0].colour_rgba, kind=kind,
        details=parts,
    )  # fmt: skip
