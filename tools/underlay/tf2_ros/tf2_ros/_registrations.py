# SPDX-License-Identifier: Apache-2.0
"""What packages have registered for their types: how to transform and to convert them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

Transform = Callable[[Any, Any], Any]
Conversion = Callable[[Any], Any]
EntryT = TypeVar('EntryT')


class TypeException(Exception):
    """Nobody has registered how to transform or convert objects of a type."""


class TransformRegistration:
    """How objects of a type are transformed. All instances share the entries."""

    _transforms: dict[type, Transform] = {}

    def add(self, key: type, callback: Transform) -> None:
        """Register a function that takes an object and a TransformStamped."""
        self._transforms[key] = callback

    def get(self, key: type) -> Transform:
        """Return the function of a type."""
        return _entry(self._transforms, key, 'transforms')


class ConvertRegistration:
    """How objects of a type become others. All instances share the entries."""

    _from_messages: dict[type, Conversion] = {}
    _to_messages: dict[type, Conversion] = {}
    _conversions: dict[tuple[type, type], Conversion] = {}

    def add_from_msg(self, key: type, callback: Conversion) -> None:
        """Register a function that makes an object of a message."""
        self._from_messages[key] = callback

    def add_to_msg(self, key: type, callback: Conversion) -> None:
        """Register a function that makes a message of an object."""
        self._to_messages[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Conversion) -> None:
        """Register a function that makes an object of the second type of one of the first."""
        self._conversions[key] = callback

    def get_from_msg(self, key: type) -> Conversion:
        """Return the function that makes objects of a type."""
        return _entry(self._from_messages, key, 'conversions from messages')

    def get_to_msg(self, key: type) -> Conversion:
        """Return the function that makes messages of a type's objects."""
        return _entry(self._to_messages, key, 'conversions to messages')

    def get_convert(self, key: tuple[type, type]) -> Conversion | None:
        """Return the function between two types, or None."""
        return self._conversions.get(key)


def _entry(entries: dict[type, EntryT], key: type, kind: str) -> EntryT:
    if key in entries:
        return entries[key]
    known = ', '.join(sorted(entry.__name__ for entry in entries)) or 'none'
    raise TypeException(
        f'Type {key} is not loaded or supported. Import the package that knows it, such as '
        f"'import tf2_geometry_msgs' for geometry_msgs. The {kind} loaded are for: {known}"
    )
