# SPDX-License-Identifier: Apache-2.0
"""Query remembered objects by class, colour, place or id."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from humanoid_perception.detection import COLOURS
from humanoid_perception.places import Places
from humanoid_perception.remembered import RememberedThing
from humanoid_perception.sighting import greatest_sigma_m

__all__ = ['ObjectQuery', 'QuestionError', 'find', 'place_of']


class QuestionError(UserError):
    """A query names an unknown class, colour, place or id; the message suggests a known one."""


@dataclass(frozen=True)
class ObjectQuery:
    """A query for objects; empty fields match all objects."""

    class_id: str = ''
    colour: str = ''
    place: str = ''
    object_id: str = ''


def place_of(thing: RememberedThing, places: Places) -> tuple[str, str]:
    """
    Find the surface and the room of an object.

    Parameters
    ----------
    thing
        The object, in the frame of the places.
    places
        The named surfaces and rooms.

    Returns
    -------
    tuple of str
        The names of the surface that the object stands on and of its room; empty if none.

    """
    x, y, z = (float(each) for each in thing.position_m)
    bottom = z - 0.5 * float(thing.size_m[2])
    sigma_m = greatest_sigma_m(thing.map_covariance_m2)
    return places.surface_at(x, y, bottom, sigma_m), places.room_at(x, y)


def find(
    question: ObjectQuery,
    things: Sequence[RememberedThing],
    places: Places,
    classes: Iterable[str] = (),
) -> list[RememberedThing]:
    """
    Find the objects that match a query, the most recently seen first.

    Parameters
    ----------
    question
        The query.
    things, places
        The remembered objects, and the named places.
    classes
        The valid classes, in addition to those of the objects; if empty, any class is valid.

    Raises
    ------
    QuestionError
        The query names an unknown class, colour, place or id.

    """
    known = {*classes, *(thing.class_id for thing in things)}
    if list(classes):
        _check(question.class_id, known, 'class')
    _check(question.colour, COLOURS, 'colour')
    if question.place and not places.names:
        raise QuestionError(
            f"There is no place named '{shortened(question.place)}': no places are loaded. Set "
            'places_file of object_memory to a file of named places.'
        )
    _check(question.place, places.names, 'place')
    _check(question.object_id, [thing.object_id for thing in things], 'remembered object')
    found = [thing for thing in things if _fits(question, thing, places)]
    return sorted(found, key=lambda thing: -thing.last_seen_s)


def _fits(question: ObjectQuery, thing: RememberedThing, places: Places) -> bool:
    pairs = (
        (question.class_id, (thing.class_id,)),
        (question.colour, (thing.colour,)),
        (question.object_id, (thing.object_id,)),
        (question.place, place_of(thing, places) if question.place else ()),
    )
    return all(not asked or asked in given for asked, given in pairs)


def _check(name: str, known: Iterable[str], what: str) -> None:
    """Raise `QuestionError` if a name is neither empty nor known."""
    names = sorted(known)
    if not name or name in names:
        return
    hint = did_you_mean(name, names) or (
        f'Known names: {", ".join(names)}.' if names else 'There is none yet.'
    )
    raise QuestionError(f"There is no {what} named '{shortened(name)}'. {hint}")
