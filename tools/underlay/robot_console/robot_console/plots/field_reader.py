# SPDX-License-Identifier: Apache-2.0
"""How the number at a field path is found in a message."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

from robot_console.plots.fields import (
    element_type,
    is_message,
    is_number,
    name_field,
    names_fields,
    Schema,
)
from robot_console.plots.series import Element, Field, FieldPath, PathError, Step
from robot_console.plots.units import unit_of
from ros_environment.suggestions import did_you_mean

__all__ = ['FieldReader']

MAX_NAMED = 8


@dataclass(frozen=True)
class _FieldAccess:
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
class _PlaceAccess:
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
class _NameAccess:
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
class _OwnNameAccess:
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


_Access = Union[_FieldAccess, _PlaceAccess, _NameAccess, _OwnNameAccess]
"""Accessors; `of` returns the value after a step, given the values along the path so far."""


def _nothing_named(key: str, known: Sequence[str]) -> PathError:
    if not known:
        return PathError(f"There is no element '{key}': the list is empty.")
    more = f' and {len(known) - MAX_NAMED} more' if len(known) > MAX_NAMED else ''
    shown = ', '.join(known[:MAX_NAMED]) + more
    meant = did_you_mean(key, known, 0.75)
    return PathError(f"There is no element '{key}', only {shown}. {meant}".rstrip())


class FieldReader:
    """
    Reads the number at a path from messages of one type.

    Parameters
    ----------
    path
        The path of the number.
    type_name
        The message type, for example `sensor_msgs/msg/JointState`.
    schema
        Returns the fields of a message type.

    Attributes
    ----------
    path
        The path.
    unit
        The unit of the number; '' if it is unknown, or if there is none.

    Raises
    ------
    PathError
        The type has no numeric field at that path.

    """

    def __init__(self, path: FieldPath, type_name: str, schema: Schema) -> None:
        self.path = path
        walk = _Walk(path, type_name, schema)
        self._accesses = [walk.go(step) for step in path.steps]
        walk.check_end()
        self.unit = unit_of(walk.fields)

    def read(self, message: Any) -> float:
        """
        Read the number from a message.

        Parameters
        ----------
        message
            A message of the reader's type.

        Raises
        ------
        PathError
            A list in this message lacks the element.

        """
        value, passed = message, [message]
        for access in self._accesses:
            value = access.of(value, passed)
            passed.append(value)
        return float(value[0] if isinstance(value, bytes) else value)


class _Walk:
    """Resolver of a path along the field types of messages."""

    def __init__(self, path: FieldPath, type_name: str, schema: Schema) -> None:
        self._path, self._schema = path, schema
        self._kind = type_name
        self._kinds = [type_name]
        self.fields: list[tuple[str, str]] = []
        self._at = path.topic

    def go(self, step: Step) -> _Access:
        """Advance by a step, and return its accessor."""
        access = self._enter(step) if isinstance(step, Field) else self._choose(step)
        self._kinds.append(self._kind)
        self._at += str(step)
        return access

    def check_end(self) -> None:
        """Raise PathError if the path does not end at a number."""
        if is_number(self._kind):
            return
        if is_message(self._kind):
            fields = ', '.join(self._fields(self._kind))
            raise PathError(f'{self._at} is not a number, but has the fields {fields}.')
        if element_type(self._kind) is not None:
            names = ' or a name' if self._names() else ''
            raise PathError(f'{self._at} is a list: add an index such as [0]{names}.')
        raise PathError(f'{self._at} is not a number, but a {self._kind}.')

    def _enter(self, step: Field) -> _Access:
        if not is_message(self._kind):
            hint = ' It is a list: first add an index, such as [0].' if self._element() else ''
            raise PathError(f"{self._at} has no field '{step.name}'.{hint}")
        fields = self._fields(self._kind)
        if step.name not in fields:
            raise PathError(
                f"{self._at} has no field '{step.name}', but {', '.join(fields)}. "
                f'{did_you_mean(step.name, fields, 0.75)}'.rstrip()
            )
        self.fields.append((self._kind, step.name))
        self._kind = fields[step.name]
        return _FieldAccess(step.name)

    def _choose(self, step: Element) -> _Access:
        kind = self._element()
        if kind is None:
            raise PathError(f'{self._at} is not a list, so it has no {step}.')
        lists = self._names()
        self._kind = kind
        if isinstance(step.key, int):
            return _PlaceAccess(step.key)
        own = name_field(self._fields(kind)) if is_message(kind) else None
        if own is not None:
            return _OwnNameAccess(step.key, own)
        if not lists:
            raise PathError(f'The elements of {self._at} have no names: use an index such as [0].')
        return _NameAccess(step.key, lists)

    def _names(self) -> tuple[tuple[int, str], ...]:
        """Return the lists of names along the path, the closest first."""
        return tuple(
            (depth, name)
            for depth, kind in reversed(list(enumerate(self._kinds)))
            if is_message(kind)
            for name in names_fields(self._fields(kind))
        )

    def _element(self) -> str | None:
        return element_type(self._kind)

    def _fields(self, kind: str) -> Mapping[str, str]:
        return self._schema(kind)
