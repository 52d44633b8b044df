# SPDX-License-Identifier: Apache-2.0
"""Which ids objects have: new ones, and those of objects that were dropped and are found again."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_perception.remembered import RememberedThing

__all__ = ['ObjectIds']

_LOST_S = 600.0
"""How long the id of an object that is gone is reserved for it."""


@dataclass(frozen=True)
class _Lost:
    """An object that was dropped, whose id may be reused for it."""

    object_id: str
    class_id: str
    colour: str
    time_s: float


class ObjectIds:
    """The ids of objects, of colour, class and number, such as `red_mug_2`."""

    def __init__(self) -> None:
        self._lost: list[_Lost] = []
        self._counts: dict[str, int] = {}

    def new(self, thing: RememberedThing) -> str:
        """
        Make an id that no object has had yet.

        Parameters
        ----------
        thing
            The object that gets it.

        """
        stem = '_'.join(filter(None, (thing.colour, thing.class_id))).replace(' ', '_')
        self._counts[stem] = self._counts.get(stem, 0) + 1
        return f'{stem}_{self._counts[stem]}'

    def lose(self, thing: RememberedThing, time_s: float) -> None:
        """
        Reserve the id of an object that is dropped.

        Parameters
        ----------
        thing
            The object.
        time_s
            The current time.

        """
        self._lost.append(_Lost(thing.object_id, thing.class_id, thing.colour, time_s))

    def found_again(self, thing: RememberedThing, time_s: float) -> str:
        """
        Take the id of the object of the same class and colour that was dropped last.

        Parameters
        ----------
        thing
            The object that gets the id.
        time_s
            The current time.

        Returns
        -------
        str
            The id; empty if no such object was dropped lately.

        """
        kind = thing.class_id, thing.colour
        for lost in reversed(self._lost):
            if (lost.class_id, lost.colour) == kind and time_s - lost.time_s < _LOST_S:
                self._lost.remove(lost)
                return lost.object_id
        return ''

    def keep(self, count: int) -> None:
        """
        Reserve no more than some ids: those of the objects that were dropped last.

        Parameters
        ----------
        count
            How many.

        """
        del self._lost[:-count]
