# SPDX-License-Identifier: Apache-2.0
"""Read the rooms, walls, furniture, graspable objects and places of a scene file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
import math
from typing import Any

from humanoid_common.naming import did_you_mean
from humanoid_common.tables import is_vector, Table
from humanoid_simulation.scene.furniture import furniture_of, KINDS, Piece, surfaces_of
from humanoid_simulation.scene.objects import CLASSES, ObjectInstance, thing_of
from humanoid_simulation.scene.outlines import Outline, Point, turned
from humanoid_simulation.scene.parts import COLOURS, Finish, PATTERNS, Vector
from humanoid_simulation.scene.scene import Place, Room, room_at, Surface, Thing
from humanoid_simulation.scene.walls import Door, flooring_of, Wall, wall_of

KEYS = ('rooms', 'walls', 'furniture', 'objects', 'places')
_GAP_M = 0.001
"""Initial clearance of objects above their support, so that none starts in penetration."""


@dataclass
class Home:
    """The rooms, objects, surfaces and places that were read from a scene file."""

    rooms: tuple[Room, ...] = ()
    things: list[Thing] = field(default_factory=list)
    surfaces: dict[str, Surface] = field(default_factory=dict)
    places: tuple[Place, ...] = ()


def home_of(table: Table) -> Home:
    """
    Build the rooms, walls, furniture, objects and places of a scene file.

    Parameters
    ----------
    table
        The content of the file.

    Raises
    ------
    TableError
        The file has a mistake; the message gives the line.

    """
    home = Home(tuple(map(_room, table.tables('rooms'))))
    for room in home.rooms:
        home.things.extend(flooring_of(room))
    for each in table.tables('walls'):
        wall = _wall(each)
        home.things.append(wall_of(wall, home.rooms))
    for each in table.tables('furniture'):
        piece = _piece(each, home.surfaces)
        home.things.append(each.place.checked(partial(furniture_of, piece)))
        home.surfaces.update({surface.name: surface for surface in surfaces_of(piece)})
    for each in table.tables('objects'):
        home.things.append(_object(each, home.surfaces))
    home.places = tuple(_place(each, home) for each in table.tables('places'))
    return home


def _room(table: Table) -> Room:
    """Read a room."""
    table.allow('name', 'outline', 'floor', 'walls', 'ceiling')
    outline = _outline(table)
    return table.place.checked(
        lambda: Room(
            table.text('name'),
            outline,
            _finish(table.table('floor')) if table.has('floor') else None,
            _finish(table.table('walls')) if table.has('walls') else None,
            table.number('ceiling', 0.0),
        )
    )


def _outline(table: Table) -> Outline:
    """Read the corners of a room."""
    corners = table.value('outline')
    if corners is None:
        raise table.place.missing('outline')
    if (
        not isinstance(corners, list)
        or len(corners) < 3
        or not all(is_vector(corner, 2) for corner in corners)
    ):
        raise table.at('outline').wrong('a list of at least 3 points [x, y]', corners)
    return tuple((float(x), float(y)) for x, y in corners)


def _finish(table: Table) -> Finish:
    """Read the finish of a floor or wall."""
    table.allow('pattern', 'first', 'second', 'tile')
    default = Finish()
    first = colour_in(table, 'first', default.first_rgb)[1]
    return table.place.checked(
        lambda: Finish(
            table.choice('pattern', PATTERNS, default.pattern),
            first,
            colour_in(table, 'second', first)[1],
            table.number('tile', default.tile_m),
        )
    )


def _wall(table: Table) -> Wall:
    """Read a wall."""
    table.allow('name', 'from', 'to', 'height', 'thickness', 'colour', 'doors')
    doors = tuple(map(_door, table.tables('doors')))
    return table.place.checked(
        lambda: Wall(
            table.text('name'),
            _point(table, 'from'),
            _point(table, 'to'),
            table.number('height', Wall.height_m),
            table.number('thickness', Wall.thickness_m),
            colour_in(table, 'colour', Wall.rgb)[1],
            doors,
        )
    )


def _door(table: Table) -> Door:
    """Read a door."""
    table.allow('at', 'width', 'height')
    return Door(
        table.number('at'),
        table.number('width', Door.width_m),
        table.number('height', Door.height_m),
    )


def _piece(table: Table, surfaces: Mapping[str, Surface]) -> Piece:
    """Read a piece of furniture, which may stand on another one."""
    table.allow('name', 'kind', 'at', 'facing_deg', 'size', 'colour', 'stands_on', 'height')
    kind = table.choice('kind', tuple(KINDS))
    raised_m = table.number('height', 0.0)
    if table.has('stands_on'):
        raised_m += _surface(table, 'stands_on', surfaces).height_m
    size = table.vector('size', 3) if table.has('size') else None
    colour = colour_in(table, 'colour', KINDS[kind].rgb)[1]
    x_m, y_m = _point(table, 'at')
    yaw_rad = math.radians(table.number('facing_deg', 0.0))
    return Piece(table.text('name'), kind, x_m, y_m, yaw_rad, size, colour, raised_m)


def _object(table: Table, surfaces: Mapping[str, Surface]) -> Thing:
    """Read a graspable object, which stands on a surface or on the floor."""
    table.allow('name', 'class', 'colour', 'stands_on', 'at', 'turn_deg', 'size')
    kind = table.choice('class', tuple(CLASSES))
    name, rgb = colour_in(table, 'colour', None)
    size = table.vector('size', 3) if table.has('size') else None
    at, yaw_rad, height_m = _point(table, 'at'), math.radians(table.number('turn_deg', 0.0)), 0.0
    if table.has('stands_on'):
        surface = _surface(table, 'stands_on', surfaces)
        origin, direction_rad = _axes(surface)
        at = turned(at, direction_rad, origin)
        yaw_rad, height_m = yaw_rad + direction_rad, surface.height_m
        if not surface.contains(*at):
            raise table.at('at').error(
                f"'{table.text('name')}' would not stand on '{surface.name}'. Give a point on the "
                'surface, relative to its centre, with x towards its front.'
            )
    bottom = (*at, height_m + _GAP_M)
    graspable = ObjectInstance(table.text('name'), kind, name, rgb, bottom, yaw_rad, size)
    return table.place.checked(lambda: thing_of(graspable))


def _axes(surface: Surface) -> tuple[Point, float]:
    """Return the centre of a surface, and the heading of the furniture that it belongs to."""
    (x1, y1), (x2, y2), *_ = surface.outline_m
    return surface.centre_m, math.atan2(y1 - y2, x1 - x2)


def _place(table: Table, home: Home) -> Place:
    """Read a place, which must be in a room if the scene has rooms."""
    table.allow('name', 'stand', 'facing_deg', 'surface')
    x_m, y_m = _point(table, 'stand')
    surface = _surface(table, 'surface', home.surfaces) if table.has('surface') else None
    room = room_at(home.rooms, x_m, y_m)
    if home.rooms and room is None:
        raise table.at('stand').error(
            f"place '{table.text('name')}' is not in any room: [{x_m:g}, {y_m:g}]."
        )
    yaw_rad = math.radians(table.number('facing_deg', 0.0))
    return Place(table.text('name'), room.name if room else '', x_m, y_m, yaw_rad, surface)


def _surface(table: Table, key: str, surfaces: Mapping[str, Surface]) -> Surface:
    """Look up the surface that the value of a key names."""
    name = table.text(key)
    if name not in surfaces:
        known = ', '.join(surfaces) or 'none yet'
        hint = did_you_mean(name, surfaces) or f'Surfaces of the furniture above: {known}.'
        raise table.at(key).error(f"there is no surface '{name}'. {hint}")
    return surfaces[name]


def _point(table: Table, key: str) -> Point:
    """Read a point on the ground."""
    x_m, y_m = table.vector(key, 2)
    return x_m, y_m


def colour_in(table: Table, key: str, default: Vector | None) -> tuple[str, Vector]:
    """
    Read a colour, which is a name of `COLOURS` or a list of red, green and blue.

    Parameters
    ----------
    table, key
        The table and its key that hold the colour.
    default
        Red, green and blue, 0 to 1, if the key is not set; None makes the key mandatory.

    Returns
    -------
    str, Vector
        The name, empty for a colour without one, and red, green and blue, 0 to 1.

    Raises
    ------
    TableError
        There is no such colour, a value is not in 0 to 1, or a mandatory key is not set.

    """
    value: Any = table.value(key)
    if isinstance(value, str):
        name = table.choice(key, tuple(COLOURS))
        return name, COLOURS[name]
    rgb = table.vector(key, 3, default)
    if not all(0.0 <= part <= 1.0 for part in rgb):
        raise table.at(key).error(
            f'{table.at(key).key} must have components from 0 to 1, not {rgb}.'
        )
    return next((name for name, known in COLOURS.items() if known == rgb), ''), rgb
