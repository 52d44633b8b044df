# SPDX-License-Identifier: Apache-2.0
"""Read a scene from a YAML file."""

from __future__ import annotations

import math

from humanoid_common.tables import load_table, Table
from humanoid_simulation.files import scene_path
from humanoid_simulation.scene.home_reading import colour_in, home_of, KEYS
from humanoid_simulation.scene.scene import Floor, Scene, SIZES, Thing, Vector
from humanoid_simulation.scene.terrain import Plates, plates_of, Ramp, ramp_of


def load_scene(name: str = 'flat') -> Scene:
    """
    Load a scene.

    Parameters
    ----------
    name
        The name of an installed scene, or the path of a file that ends with .yaml or .yml.

    Raises
    ------
    SimulationError
        There is no such scene, or its file cannot be read or has a mistake (`TableError`).

    """
    path = scene_path(name)
    return scene_of(load_table(path), path.stem)


def scene_of(table: Table, name: str) -> Scene:
    """
    Build a scene from the content of a file.

    Parameters
    ----------
    table
        The content.
    name
        The name of the scene.

    Raises
    ------
    TableError
        The file has a mistake, such as a name used twice; the message gives the line.

    """
    table.allow('floor', 'things', 'ramps', 'plates', *KEYS)
    floor = _floor(table.table('floor'))
    things = [
        *map(thing_in, table.tables('things')),
        *(thing for ramp in table.tables('ramps') for thing in ramp_of(_ramp(ramp))),
        *(thing for plates in table.tables('plates') for thing in plates_of(_plates(plates))),
    ]
    _refuse_names_twice(table)
    home = home_of(table)
    return table.place.checked(
        lambda: Scene(
            name,
            floor,
            (*things, *home.things),
            home.rooms,
            home.places,
            tuple(home.surfaces.values()),
        )
    )


def _refuse_names_twice(table: Table) -> None:
    """Raise TableError if two objects have the same name; the message gives both lines."""
    lines: dict[str, int] = {}
    for key in ('things', 'walls', 'furniture', 'objects'):
        for each in table.tables(key):
            name = each.text('name')
            if name in lines:
                raise each.at('name').error(
                    f"the name '{name}' is already used on line {lines[name]}. Give each object a "
                    'unique name.'
                )
            lines[name] = each.at('name').line


def _floor(table: Table) -> Floor:
    """Read the floor."""
    table.allow('friction', 'colours', 'tile')
    default = Floor()
    colours = table.table('colours')
    colours.allow('first', 'second')
    first, second = default.colours_rgb
    return table.place.checked(
        lambda: Floor(
            table.number('friction', default.friction),
            (colours.vector('first', 3, first), colours.vector('second', 3, second)),
            table.number('tile', default.tile_m),
        )
    )


def thing_in(table: Table, name: str | None = None, position_m: Vector | None = None) -> Thing:
    """
    Read an object that consists of one shape.

    Parameters
    ----------
    table
        The table of the object in a file.
    name, position_m
        Its name and position (3,) in the world frame if the table does not set them; None makes
        them mandatory.

    Raises
    ------
    TableError
        The table has a mistake; the message gives the line.

    """
    table.allow(
        'name', 'shape', 'size', 'position', 'turn_deg', 'colour', 'mass', 'friction', 'class'
    )
    shape = table.choice('shape', tuple(SIZES))
    roll, pitch, yaw = table.vector('turn_deg', 3, (0.0, 0.0, 0.0))
    colour, rgb = colour_in(table, 'colour', (0.6, 0.6, 0.6))
    return table.place.checked(
        lambda: Thing(
            table.text('name', name),
            shape,
            table.vector('size', len(SIZES[shape])),
            table.vector('position', 3, position_m),
            (math.radians(roll), math.radians(pitch), math.radians(yaw)),
            (*rgb, 1.0),
            table.number('mass', 0.0),
            table.number('friction', 1.0),
            table.text('class', ''),
            colour,
        )
    )


def _ramp(table: Table) -> Ramp:
    """Read a ramp."""
    table.allow('name', 'start', 'direction_deg', 'slope_deg', 'length', 'width', 'top')
    return table.place.checked(
        lambda: Ramp(
            table.text('name'),
            table.vector('start', 2),
            math.radians(table.number('direction_deg', 0.0)),
            math.radians(table.number('slope_deg')),
            table.number('length'),
            table.number('width'),
            table.number('top', 0.0),
        )
    )


def _plates(table: Table) -> Plates:
    """Read a field of plates."""
    table.allow('name', 'seed', 'from', 'to', 'edge', 'height', 'cover')
    return table.place.checked(
        lambda: Plates(
            table.text('name'),
            table.integer('seed', 0),
            table.vector('from', 2),
            table.vector('to', 2),
            table.vector('edge', 2),
            table.number('height'),
            table.number('cover', 1.0),
        )
    )
