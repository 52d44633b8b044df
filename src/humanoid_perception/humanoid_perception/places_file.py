# SPDX-License-Identifier: Apache-2.0
"""Find and read YAML files of named places."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import math
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_common.paths import expanded_path
from humanoid_perception.places import Fixture, Outline, Places, Room, Surface, TOLERANCE_M
import yaml

__all__ = ['PlacesError', 'load_places', 'places_path']

_PREFIX = 'places_'


class PlacesError(UserError):
    """A file of named places cannot be used; the message states why."""


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
    PlacesError
        There is no such file.
    UserError
        The path begins with a home folder that does not exist.

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
    raise PlacesError(
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
    PlacesError
        The file cannot be read, or has missing or invalid entries.

    """
    try:
        table = yaml.safe_load(path.read_text(encoding='utf-8'))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise PlacesError(f'The named places in {path} cannot be read: {error}') from error
    try:
        return _places(table)
    except PlacesError as error:
        raise PlacesError(f'The named places in {path} cannot be used: {error}') from None


def _places(table: Any) -> Places:
    keys = ('frame', 'surfaces', 'rooms')
    entries = _checked(table, 'the file', keys, ())
    frame = entries.get('frame', 'map')
    if not isinstance(frame, str) or not frame:
        raise PlacesError(f'frame is {frame!r}. Give the name of a frame, such as map.')
    places = Places(
        frame,
        tuple(_surface(each) for each in _list(entries, 'surfaces')),
        tuple(_room(each) for each in _list(entries, 'rooms')),
    )
    for name in places.names:
        if places.names.count(name) > 1:
            raise PlacesError(f"two places are named '{name}'. Give each a unique name.")
    return places


def _surface(entry: Any) -> Surface:
    keys = ('name', 'outline', 'height', 'tolerance', 'depth', 'container', 'fixtures')
    known = _checked(entry, 'a surface', keys, ('name', 'outline', 'height'))
    name, is_container = _name(known), known.get('container', False)
    if not isinstance(is_container, bool):
        raise PlacesError(f'container of {name} is {is_container!r}, but must be true or false.')
    return Surface(
        name,
        _outline(known['outline'], name),
        _number(known['height'], f'the height of {name}'),
        abs(_number(known.get('tolerance', TOLERANCE_M), f'the tolerance of {name}')),
        abs(_number(known.get('depth', 0.0), f'the depth of {name}')),
        is_container,
        tuple(_fixture(each, name) for each in _list(known, 'fixtures')),
    )


def _fixture(entry: Any, surface: str) -> Fixture:
    what, keys = f'what stands on {surface}', ('outline', 'height')
    known = _checked(entry, what, keys, keys)
    height_m = abs(_number(known['height'], f'the height of {what}'))
    return Fixture(_outline(known['outline'], what), height_m)


def _room(entry: Any) -> Room:
    known = _checked(entry, 'a room', ('name', 'outline'), ('name', 'outline'))
    name = _name(known)
    return Room(name, _outline(known['outline'], name))


def _checked(
    entry: Any, what: str, keys: Iterable[str], needed: Iterable[str]
) -> Mapping[str, Any]:
    """Validate the keys of a table: no unknown ones, and none missing."""
    if not isinstance(entry, dict):
        raise PlacesError(f'{what} is {entry!r}, but must be a table of {", ".join(keys)}.')
    for key in entry:
        if key not in keys:
            question = did_you_mean(str(key), keys)
            raise PlacesError(f"{what} has no '{key}'. {question or ', '.join(keys)}")
    for key in needed:
        if key not in entry:
            raise PlacesError(f"{what} needs '{key}': {entry!r}.")
    return entry


def _list(table: Mapping[str, Any], key: str) -> list[Any]:
    value = table.get(key) or []
    if not isinstance(value, list):
        raise PlacesError(f'{key} is {value!r}, but must be a list.')
    return value


def _name(entry: Mapping[str, Any]) -> str:
    if not isinstance(entry['name'], str) or not entry['name']:
        raise PlacesError(f'a name is {entry["name"]!r}, but must be a string.')
    return entry['name']


def _number(value: Any, what: str) -> float:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not math.isfinite(value):
        raise PlacesError(f'{what} is {value!r}, but must be a number of metres.')
    return float(value)


def _outline(value: Any, name: str) -> Outline:
    is_list = isinstance(value, list) and len(value) >= 3
    if not is_list or any(not isinstance(each, list) or len(each) != 2 for each in value):
        raise PlacesError(
            f'the outline of {name} is {value!r}, but must be three or more corners [x, y].'
        )
    what = f'a corner of {name}'
    return tuple((_number(x, what), _number(y, what)) for x, y in value)
