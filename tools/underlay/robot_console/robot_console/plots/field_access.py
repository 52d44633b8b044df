# SPDX-License-Identifier: Apache-2.0
"""How values take the steps of a path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Union

from robot_console.plots.field_path import PathError
from urdf.did_you_mean import did_you_mean

__all__ = ['Access', 'FieldAccess', 'NameAccess', 'OwnNameAccess', 'PlaceAccess']

MAX_NAMED = 8


@dataclass(frozen=True)
class FieldAccess:
    """Goes to a field."""

    name: str

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Get the field from a message.

        Parameters
        ----------
        value
            The message.
        passed
            Not used.

        """
        return getattr(value, self.name)


@dataclass(frozen=True)
class PlaceAccess:
    """Finds an element by its place."""

    place: int

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Get the element at the index.

        Parameters
        ----------
        value
            The list.
        passed
            Not used.

        Raises
        ------
        PathError
            The list is too short.

        """
        try:
            return value[self.place]
        except IndexError:
            raise PathError(f'There is no [{self.place}]: the list has {len(value)}.') from None


@dataclass(frozen=True)
class NameAccess:
    """Finds an element by a name, which is in one of some lists of messages on the way."""

    key: str
    lists: tuple[tuple[int, str], ...]

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Get the element that a parallel list of names gives this name.

        Parameters
        ----------
        value
            The list of elements.
        passed
            The values on the way to the list, the whole message first; some of them have the
            names.

        Raises
        ------
        PathError
            There is no such name, or the list has no element for it.

        """
        known: list[str] = []
        for depth, field in self.lists:
            names = getattr(passed[depth], field)
            if self.key in names:
                place = names.index(self.key)
                if place < len(value):
                    return value[place]
                raise PathError(f"'{self.key}' is named, but the list has only {len(value)}.")
            known.extend(names)
        raise _nothing_named(self.key, known)


@dataclass(frozen=True)
class OwnNameAccess:
    """Finds an element by the name that it has itself."""

    key: str
    field: str

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Get the element whose own name field has this name.

        Parameters
        ----------
        value
            The list of elements.
        passed
            Not used.

        Raises
        ------
        PathError
            No element has this name.

        """
        for element in value:
            if getattr(element, self.field) == self.key:
                return element
        raise _nothing_named(self.key, [getattr(element, self.field) for element in value])


Access = Union[FieldAccess, PlaceAccess, NameAccess, OwnNameAccess]
"""`of` returns the value after a step; `passed` are the values on the way, the message first."""


def _nothing_named(key: str, known: Sequence[str]) -> PathError:
    if not known:
        return PathError(f"Nothing is named '{key}': the list is empty.")
    more = f' and {len(known) - MAX_NAMED} more' if len(known) > MAX_NAMED else ''
    shown = ', '.join(known[:MAX_NAMED]) + more
    return PathError(f"Nothing is named '{key}', but {shown}.{did_you_mean(key, known)}")
