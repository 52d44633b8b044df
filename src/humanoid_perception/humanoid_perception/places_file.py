# SPDX-License-Identifier: Apache-2.0
"""Find and read YAML files of named places."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_common.paths import expanded_path
from humanoid_common.tables import is_vector, load_table, Table
from humanoid_perception.places import Fixture, Outline, Places, Room, Surface, TOLERANCE_M

__all__ = ['load_places', 'places_path']

_PREFIX = 'places_'


def places_path(given: str) -> Path | None:
    """
    Resolve the file of named places; None if none is given.

    Parameters
    ----------
    given
        A path, the name of a file of this package (`apartment` is config/places_apartment.yaml),
        or empty.

    Raises
    ------
    UserError
        There is no such file.

    """
    if not given:
        return None
    path = expanded_path(given)
    if path.is_file():
        return path
    folder = Path(get_package_share_directory('humanoid_perception')) / 'config'
    path = folder / f'{_PREFIX}{given}.yaml'
    if path.is_file():
        return path
    known = sorted(path.stem.removeprefix(_PREFIX) for path in folder.glob(f'{_PREFIX}*.yaml'))
    hint = f' {question}' if (question := did_you_mean(given, known)) else ''
    raise UserError(
        f"File of named places '{given}' not found.{hint} Set "
        f'places_file to the path of one, the name of one in this package ({", ".join(known)}), '
        'or leave it empty for none.'
    )


def load_places(path: Path) -> Places:
    """
    Read a YAML file of named places.

    Parameters
    ----------
    path
        The file, as `places_path` finds it.

    Raises
    ------
    TableError
        The file cannot be read, or has missing or invalid entries.

    """
    table = load_table(path)
    table.allow('frame', 'surfaces', 'rooms')
    seen: set[str] = set()
    for entry in (*_entries(table, 'surfaces'), *_entries(table, 'rooms')):
        name = entry.text('name')
        if name in seen:
            raise entry.at('name').error(
                f"two places are named '{name}'. Give each a unique name."
            )
        seen.add(name)
    return Places(
        table.text('frame', 'map'),
        tuple(map(_surface, _entries(table, 'surfaces'))),
        tuple(map(_room, _entries(table, 'rooms'))),
    )


def _entries(table: Table, name: str) -> Iterator[Table]:
    """Return the items of a list, which may be left empty."""
    return table.tables(name) if table.has(name) else iter(())


def _surface(table: Table) -> Surface:
    table.allow('name', 'outline', 'height', 'tolerance', 'depth', 'container', 'fixtures')
    is_container = table.value('container') if table.has('container') else False
    if not isinstance(is_container, bool):
        raise table.at('container').wrong('true or false', is_container)
    return Surface(
        table.text('name'),
        _outline(table),
        table.number('height'),
        abs(table.number('tolerance', TOLERANCE_M)),
        abs(table.number('depth', 0.0)),
        is_container,
        tuple(map(_fixture, _entries(table, 'fixtures'))),
    )


def _fixture(table: Table) -> Fixture:
    table.allow('outline', 'height')
    return Fixture(_outline(table), abs(table.number('height')))


def _room(table: Table) -> Room:
    table.allow('name', 'outline')
    return Room(table.text('name'), _outline(table))


def _outline(table: Table) -> Outline:
    if not table.has('outline'):
        raise table.place.missing('outline')
    corners = table.value('outline')
    is_list = isinstance(corners, list) and len(corners) >= 3
    if not is_list or not all(is_vector(corner, 2) for corner in corners):
        raise table.at('outline').wrong('three or more corners [x, y] in metres', corners)
    return tuple((float(x), float(y)) for x, y in corners)
