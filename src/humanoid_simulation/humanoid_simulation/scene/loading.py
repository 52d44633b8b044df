# SPDX-License-Identifier: Apache-2.0
"""Read a scene from a YAML file."""

from __future__ import annotations

import math
from pathlib import Path

from humanoid_simulation.choosing import named
from humanoid_simulation.files import share
from humanoid_simulation.scene.scene import Floor, Scene, SIZES, Thing
from humanoid_simulation.scene.terrain import Plates, plates_of, Ramp, ramp_of
from humanoid_simulation.tables import load_table, Table


def load_scene(name: str = 'flat') -> Scene:
    """
    Return a scene.

    :param name: that of an installed scene, or the path of a file, which ends with .yaml
    """
    if name.endswith(('.yaml', '.yml')):
        path = Path(name)
    else:
        path = named('scene', name, installed_scenes())
    return scene_of(load_table(path), path.stem)


def installed_scenes() -> dict[str, Path]:
    """Return the files of the scenes that are installed, by name."""
    return {path.stem: path for path in sorted((share() / 'scenes').glob('*.yaml'))}


def scene_of(table: Table, name: str) -> Scene:
    """Build a scene from the content of a file."""
    table.allow('floor', 'things', 'ramps', 'plates')
    return Scene(
        name,
        _floor(table.table('floor')),
        (
            *map(_thing, table.tables('things')),
            *(thing for ramp in table.tables('ramps') for thing in ramp_of(_ramp(ramp))),
            *(thing for plates in table.tables('plates') for thing in plates_of(_plates(plates))),
        ),
    )


def _floor(table: Table) -> Floor:
    """Read the floor."""
    table.allow('friction', 'colours', 'tile')
    default = Floor()
    colours = table.table('colours')
    colours.allow('first', 'second')
    first, second = default.colours_rgb
    return Floor(
        table.number('friction', default.friction),
        (colours.vector('first', 3, first), colours.vector('second', 3, second)),
        table.number('tile', default.tile_m),
    )


def _thing(table: Table) -> Thing:
    """Read a thing."""
    table.allow('name', 'shape', 'size', 'position', 'turn_deg', 'colour', 'mass', 'friction')
    shape = table.choice('shape', tuple(SIZES))
    roll, pitch, yaw = table.vector('turn_deg', 3, (0.0, 0.0, 0.0))
    return Thing(
        table.text('name'),
        shape,
        table.vector('size', len(SIZES[shape])),
        table.vector('position', 3),
        (math.radians(roll), math.radians(pitch), math.radians(yaw)),
        (*table.vector('colour', 3, (0.6, 0.6, 0.6)), 1.0),
        table.number('mass', 0.0),
        table.number('friction', 1.0),
    )


def _ramp(table: Table) -> Ramp:
    """Read a ramp."""
    table.allow('name', 'start', 'direction_deg', 'slope_deg', 'length', 'width', 'top')
    return Ramp(
        table.text('name'),
        table.vector('start', 2),
        math.radians(table.number('direction_deg', 0.0)),
        math.radians(table.number('slope_deg')),
        table.number('length'),
        table.number('width'),
        table.number('top', 0.0),
    )


def _plates(table: Table) -> Plates:
    """Read a field of plates."""
    table.allow('name', 'seed', 'from', 'to', 'edge', 'height', 'cover')
    return Plates(
        table.text('name'),
        table.integer('seed', 0),
        table.vector('from', 2),
        table.vector('to', 2),
        table.vector('edge', 2),
        table.number('height'),
        table.number('cover', 1.0),
    )
