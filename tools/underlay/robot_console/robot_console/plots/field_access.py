# SPDX-License-Identifier: Apache-2.0
"""Accessors for the steps of a field path."""

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
    """Accessor for a field of a message."""

    name: str

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Return the field of a message.

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
    """Accessor for a list element by index."""

    place: int

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Return the element at the index.

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
    """Accessor for a list element by a name from a parallel list in an enclosing message."""

    key: str
    lists: tuple[tuple[int, str], ...]

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Return the element whose name is found in a parallel list of names.

        Parameters
        ----------
        value
            The list of elements.
        passed
            The values along the path to the list, starting with the whole message; some of them
            contain the names.

        Raises
        ------
        PathError
            The name is unknown, or the list has no element for it.

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
    """Accessor for a list element by its own name field."""

    key: str
    field: str

    def of(self, value: Any, passed: Sequence[Any]) -> Any:
        """
        Return the element whose name field matches.

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
"""Accessors; `of` returns the value after a step, given the values along the path so far."""


def _nothing_named(key: str, known: Sequence[str]) -> PathError:
    if not known:
        return PathError(f"Nothing is named '{key}': the list is empty.")
    more = f' and {len(known) - MAX_NAMED} more' if len(known) > MAX_NAMED else ''
    shown = ', '.join(known[:MAX_NAMED]) + more
    return PathError(f"Nothing is named '{key}', but {shown}.{did_you_mean(key, known)}")
