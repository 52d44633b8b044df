# SPDX-License-Identifier: Apache-2.0
"""Named places from a YAML file: surfaces that objects stand on, and rooms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
import math
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_common.naming import did_you_mean
import yaml

__all__ = [
    'Fixture', 'Outline', 'Places', 'PlacesError', 'Point', 'Room', 'Surface', 'load_places',
    'places_path', 'sides',
]  # fmt: skip

Point = tuple[float, float]
Outline = tuple[Point, ...]
_PREFIX = 'places_'
_TOLERANCE_M = 0.08
_MOST_SIGMA_M = 0.1
"""Largest position uncertainty that widens the tolerance of a surface."""


class PlacesError(Exception):
    """A file of named places cannot be used; the message states why."""


class _Area:
    """Base class of areas with an outline in the map."""

    outline_m: Outline

    @property
    def middle_m(self) -> Point:
        """Return the mean of the corners, in the map."""
        return _mean(self.outline_m)

    def distance_m(self, point_m: Point) -> float:
        """
        Compute the horizontal distance of a point from the area.

        Parameters
        ----------
        point_m
            x and y in the map.

        Returns
        -------
        float
            The distance in m; 0 within the outline.

        """
        if _contains(self.outline_m, point_m):
            return 0.0
        return min(_to_side_m(a, b, point_m) for a, b in sides(self.outline_m))


@dataclass(frozen=True)
class Fixture(_Area):
    """
    A permanent object on a surface, such as a television.

    Attributes
    ----------
    outline_m
        Its outline in the map.
    height_m
        Its height above the surface.

    """

    outline_m: Outline
    height_m: float


@dataclass(frozen=True)
class Surface(_Area):
    """
    A named horizontal surface.

    Attributes
    ----------
    name
        Its name.
    outline_m, height_m
        Its outline and height in the map.
    tolerance_m
        The tolerance of outline and height.
    depth_m
        Its thickness, as of a table top; zero for a body down to the floor, such as a cabinet.
    is_container
        Whether it is the opening of a container, such as a bin: an object put there falls in.
    fixtures
        The permanent objects on it.

    """

    name: str
    outline_m: Outline
    height_m: float
    tolerance_m: float = _TOLERANCE_M
    depth_m: float = 0.0
    is_container: bool = False
    fixtures: tuple[Fixture, ...] = ()

    def misfit_m(self, x_m: float, y_m: float, bottom_m: float, sigma_m: float = 0.0) -> float:
        """
        Compute the height difference between the underside of an object and the surface.

        Parameters
        ----------
        x_m, y_m, bottom_m
            The centre of its underside, in the map.
        sigma_m
            The standard deviation of its position.

        Returns
        -------
        float
            The height difference in m; infinite if the object is farther above, below or beside
            the surface than the tolerance and two standard deviations.

        """
        above_m = abs(bottom_m - self.height_m)
        reach_m = self.tolerance_m + 2.0 * min(sigma_m, _MOST_SIGMA_M)
        is_on = above_m <= reach_m and self.distance_m((x_m, y_m)) <= reach_m
        return above_m if is_on else math.inf


@dataclass(frozen=True)
class Room(_Area):
    """A named part of the floor, with its outline in the map."""

    name: str
    outline_m: Outline


@dataclass(frozen=True)
class Places:
    """All named places, in a frame."""

    frame: str = 'map'
    surfaces: tuple[Surface, ...] = ()
    rooms: tuple[Room, ...] = ()

    @property
    def names(self) -> list[str]:
        """Return the names of the surfaces and rooms."""
        return [*(each.name for each in self.surfaces), *(each.name for each in self.rooms)]

    def surface_at(self, x_m: float, y_m: float, bottom_m: float, sigma_m: float = 0.0) -> str:
        """
        Find the surface below an object; return its name, or empty if it stands on none.

        Parameters
        ----------
        x_m, y_m, bottom_m
            The centre of its underside, in the map.
        sigma_m
            The standard deviation of its position.

        """
        fits = [(each.misfit_m(x_m, y_m, bottom_m, sigma_m), each.name) for each in self.surfaces]
        best = min(fits, default=(math.inf, ''))
        return best[1] if best[0] < math.inf else ''

    def room_at(self, x_m: float, y_m: float) -> str:
        """
        Find the room around a point.

        Parameters
        ----------
        x_m, y_m
            The point, in the frame of the places.

        Returns
        -------
        str
            The name of the room; empty outside all rooms.

        """
        return next(
            (each.name for each in self.rooms if _contains(each.outline_m, (x_m, y_m))), ''
        )


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

    """
    if not given:
        return None
    path = Path(given).expanduser()
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
        abs(_number(known.get('tolerance', _TOLERANCE_M), f'the tolerance of {name}')),
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


def sides(outline: Outline) -> Iterable[tuple[Point, Point]]:
    """
    Iterate over the sides of a polygon as pairs of end points; the last one closes it.

    Parameters
    ----------
    outline
        The corners of the polygon, in order.

    """
    return zip(outline, (*outline[1:], outline[0]))


def _contains(outline: Outline, point: Point) -> bool:
    """Whether a point is inside a polygon: a ray from it crosses an odd number of sides."""
    x, y = point
    return (
        sum(
            (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)
            for (x1, y1), (x2, y2) in sides(outline)
        )
        % 2
        == 1
    )


def _to_side_m(a: Point, b: Point, point: Point) -> float:
    """Compute the distance of a point from a line segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length2 = dx * dx + dy * dy
    along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / length2 if length2 else 0.0
    along = max(0.0, min(1.0, along))
    return math.hypot(a[0] + along * dx - point[0], a[1] + along * dy - point[1])


def _mean(outline: Outline) -> Point:
    count = len(outline)
    return sum(each[0] for each in outline) / count, sum(each[1] for each in outline) / count
