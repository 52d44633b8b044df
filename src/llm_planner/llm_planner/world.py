# SPDX-License-Identifier: Apache-2.0
"""World model of the planner: places, remembered objects, and what the robot can do."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
import math

__all__ = [
    'ANYTHING', 'KnownObject', 'ObjectDescription', 'World', 'base_name', 'in_words', 'listed',
    'spoken_places',
]  # fmt: skip

ANYTHING = 'thing'
"""The most general class: any object."""
_PLURALS = {'box': 'boxes', 'person': 'people'}


@dataclass(frozen=True)
class KnownObject:
    """
    A remembered object.

    Attributes
    ----------
    object_id, class_id, colour
        Its id, class and colour; the colour may be empty.
    place, room
        The surface and the room where it is; may be empty.
    position_m, size_m
        Its centre in the map, and the length, width and height of its bounding box; m.

    """

    object_id: str
    class_id: str
    colour: str = ''
    place: str = ''
    room: str = ''
    position_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    size_m: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def name(self) -> str:
        """Return the name in natural language: red mug."""
        colour = self.colour if self.colour != self.class_id else ''
        return f'{colour} {self.class_id}'.strip()


@dataclass(frozen=True)
class ObjectDescription:
    """
    An object as described by a user; fields that were not mentioned are empty.

    Attributes
    ----------
    class_id, colour, which, place
        `mug`, `red`, `biggest`, `kitchen_table`.
    object_id
        The id of a single remembered object, when it is known which one is meant.
    is_definite
        Whether a particular one is meant (the mug), not any (a mug).

    """

    class_id: str = ANYTHING
    colour: str = ''
    which: str = ''
    place: str = ''
    object_id: str = ''
    is_inside: bool = False
    """Whether the place is a room or a container, which has objects in it, not on it."""
    is_definite: bool = True

    @property
    def text(self) -> str:
        """Return the description as text that can be parsed again: `the red mug on the desk`."""
        article = 'the' if self.is_definite else 'a'
        return self._worded(article, in_words(self.class_id))

    @property
    def plural_text(self) -> str:
        """Return the description in the plural: `red mugs on the desk`."""
        return self._worded('', _PLURALS.get(self.class_id, f'{self.class_id}s'))

    def _worded(self, article: str, noun: str) -> str:
        where = f'{"in" if self.is_inside else "on"} the {in_words(self.place)}'
        words = (article, self.which, self.colour, noun, self.place and where)
        return ' '.join(filter(None, words))

    def names(self, name: str) -> bool:
        """
        Check whether the description can mean an object with a name, wherever it is.

        Parameters
        ----------
        name
            A class, or a colour and a class, such as `red mug`.

        """
        words = name.split()
        return (
            bool(words) and self.class_id in (ANYTHING, words[-1]) and self.colour in ('', *words)
        )

    def fits(self, thing: KnownObject) -> bool:
        """
        Check whether the description fits an object, regardless of `which`.

        Parameters
        ----------
        thing
            A remembered object. If the description has an `object_id`, only that is compared.

        """
        if self.object_id:
            return thing.object_id == self.object_id
        return (
            self.class_id in (ANYTHING, thing.class_id)
            and self.colour in ('', thing.colour)
            and self.place in ('', base_name(thing.place), thing.room)
            and (self.class_id != ANYTHING or thing.class_id != 'person')
        )

    def among(
        self, things: Iterable[KnownObject], robot: tuple[float, float, float] | None = None
    ) -> list[KnownObject]:
        """
        Return the objects that the description fits, best first.

        Parameters
        ----------
        things
            All remembered objects.
        robot
            The pose of the robot in the map (x and y in m, yaw in rad), from which `leftmost` and
            `nearest` are judged.

        """
        found = [each for each in things if self.fits(each)]
        if not self.which or not found:
            return found
        found.sort(key=_orders(robot or (0.0, 0.0, 0.0))[self.which])
        return found[:1]


@dataclass(frozen=True)
class World:
    """
    Snapshot of what is known when a plan is made.

    Attributes
    ----------
    places
        The named surfaces, each with the room in which it is.
    rooms
        The named rooms.
    things
        The remembered objects.
    missing
        The reasons why skills are unavailable now, by name; the others are available.
    inhibition
        Why the robot cannot walk now; empty if it can.
    holding
        The name of the held object; empty if there is none.
    robot
        The pose of the robot in the map: x and y in m, yaw in rad; None if it is unknown.
    containers
        The named surfaces that objects are put into, not onto.

    """

    places: Mapping[str, str] = field(default_factory=dict)
    rooms: tuple[str, ...] = ()
    things: tuple[KnownObject, ...] = ()
    missing: Mapping[str, str] = field(default_factory=dict)
    inhibition: str = ''
    holding: str = ''
    robot: tuple[float, float, float] | None = None
    containers: tuple[str, ...] = ()

    @property
    def place_names(self) -> tuple[str, ...]:
        """Return the names of surfaces and rooms."""
        return (*self.places, *self.rooms)


def base_name(place: str) -> str:
    """
    Strip the board from the name of a surface: `shelf` from `shelf/1`.

    Parameters
    ----------
    place
        The name of a surface or room.

    Returns
    -------
    str
        The name of the piece of furniture; a name without a board is unchanged.

    """
    return place.partition('/')[0]


def in_words(name: str) -> str:
    """
    Convert a name to spoken words: `kitchen_table` to kitchen table, `shelf/1` to shelf.

    Parameters
    ----------
    name
        The name of a place, or the class of an object.

    """
    return base_name(name).replace('_', ' ')


def listed(names: Sequence[str], last: str = 'and') -> str:
    """
    Join names to a list in natural language: a, b and c; empty for none.

    Parameters
    ----------
    names, last
        The names, and the word before the last one.

    """
    if len(names) < 2:
        return names[0] if names else ''
    return f'{", ".join(names[:-1])} {last} {names[-1]}'


def spoken_places(world: World, more: Mapping[str, Iterable[str]]) -> dict[str, tuple[str, ...]]:
    """
    Map the spoken names of places to the places that each of them can mean.

    A place is called by its name, and by its last word: `counter`, and `table` for each of several
    tables.

    Parameters
    ----------
    world
        The state of the world, which has the places.
    more
        Further words by the names of places; those of unknown places are ignored.

    """
    meant: dict[str, list[str]] = {}
    for name in world.place_names:
        for text in dict.fromkeys((in_words(name), *more.get(name, ()))):
            meant.setdefault(text, []).append(name)
    for name in world.places:
        last = in_words(name).split()[-1]
        if last not in world.rooms and name not in meant.get(last, ()):
            meant.setdefault(last, []).append(name)
    return {text: tuple(names) for text, names in meant.items()}


def _orders(robot: tuple[float, float, float]) -> Mapping[str, Callable[[KnownObject], float]]:
    """Return the sort key of objects for each word that selects one of them."""
    x, y, yaw = robot

    def distance(thing: KnownObject) -> float:
        return math.hypot(thing.position_m[0] - x, thing.position_m[1] - y)

    def bearing(thing: KnownObject) -> float:
        angle = math.atan2(thing.position_m[1] - y, thing.position_m[0] - x)
        return math.remainder(angle - yaw, math.tau)

    return {
        'biggest': lambda thing: -math.prod(thing.size_m),
        'smallest': lambda thing: math.prod(thing.size_m),
        'tallest': lambda thing: -thing.size_m[2],
        'leftmost': lambda thing: -bearing(thing),
        'rightmost': bearing,
        'nearest': distance,
        'farthest': lambda thing: -distance(thing),
    }
