# SPDX-License-Identifier: Apache-2.0
"""Reader of the number at a field path."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from robot_console.plots.field_access import (
    Access,
    FieldAccess,
    NameAccess,
    OwnNameAccess,
    PlaceAccess,
)
from robot_console.plots.field_names import name_field, names_fields
from robot_console.plots.field_path import Element, Field, FieldPath, PathError, Step
from robot_console.plots.field_types import element_type, is_message, is_number, Schema
from urdf.did_you_mean import did_you_mean

__all__ = ['FieldReader']


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
        self._at = path.topic

    def go(self, step: Step) -> Access:
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
            raise PathError(f'{self._at} is no number, but has the fields {fields}.')
        if element_type(self._kind) is not None:
            names = ' or a name' if self._names() else ''
            raise PathError(f'{self._at} is a list: add a place such as [0]{names}.')
        raise PathError(f'{self._at} is no number, but a {self._kind}.')

    def _enter(self, step: Field) -> Access:
        if not is_message(self._kind):
            hint = ' It is a list: first say which, such as [0].' if self._element() else ''
            raise PathError(f"{self._at} has no field '{step.name}'.{hint}")
        fields = self._fields(self._kind)
        if step.name not in fields:
            raise PathError(
                f"{self._at} has no field '{step.name}', but {', '.join(fields)}."
                f'{did_you_mean(step.name, fields)}'
            )
        self._kind = fields[step.name]
        return FieldAccess(step.name)

    def _choose(self, step: Element) -> Access:
        kind = self._element()
        if kind is None:
            raise PathError(f'{self._at} is no list, so that it has no {step}.')
        lists = self._names()
        self._kind = kind
        if isinstance(step.key, int):
            return PlaceAccess(step.key)
        own = name_field(self._fields(kind)) if is_message(kind) else None
        if own is not None:
            return OwnNameAccess(step.key, own)
        if not lists:
            raise PathError(f'The elements of {self._at} have no names: say a place, such as [0].')
        return NameAccess(step.key, lists)

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
