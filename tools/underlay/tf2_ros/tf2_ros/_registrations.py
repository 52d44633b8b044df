# SPDX-License-Identifier: Apache-2.0
"""Registry of functions that transform and convert objects, by type."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

Transform = Callable[[Any, Any], Any]
Conversion = Callable[[Any], Any]
EntryT = TypeVar('EntryT')


class TypeException(Exception):
    """No transform or conversion is registered for a type."""


class TransformRegistration:
    """Registry of transform functions by type. All instances share the entries."""

    _transforms: dict[type, Transform] = {}

    def add(self, key: type, callback: Transform) -> None:
        """
        Register the function that transforms objects of a type.

        Parameters
        ----------
        key
            The type.
        callback
            Accepts an object of the type and a `TransformStamped`; returns the transformed object.

        """
        self._transforms[key] = callback

    def get(self, key: type) -> Transform:
        """
        Return the function that transforms objects of a type.

        Parameters
        ----------
        key
            The type.

        Raises
        ------
        TypeException
            No package has registered the type.

        """
        return _entry(self._transforms, key, 'transforms')


class ConvertRegistration:
    """Registry of conversions by type. All instances share the entries."""

    _from_messages: dict[type, Conversion] = {}
    _to_messages: dict[type, Conversion] = {}
    _conversions: dict[tuple[type, type], Conversion] = {}

    def add_from_msg(self, key: type, callback: Conversion) -> None:
        """
        Register the conversion from a message to objects of a type.

        Parameters
        ----------
        key
            The type of the result.
        callback
            Accepts a message; returns an object of the type.

        """
        self._from_messages[key] = callback

    def add_to_msg(self, key: type, callback: Conversion) -> None:
        """
        Register the conversion of objects of a type to a message.

        Parameters
        ----------
        key
            The type to convert.
        callback
            Accepts an object of the type; returns a message.

        """
        self._to_messages[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Conversion) -> None:
        """
        Register a direct conversion between two types.

        Parameters
        ----------
        key
            The types converted from and to.
        callback
            Accepts an object of the first type; returns one of the second type.

        """
        self._conversions[key] = callback

    def get_from_msg(self, key: type) -> Conversion:
        """
        Return the conversion from a message to objects of a type.

        Parameters
        ----------
        key
            The type of the result.

        Raises
        ------
        TypeException
            No package has registered the type.

        """
        return _entry(self._from_messages, key, 'conversions from messages')

    def get_to_msg(self, key: type) -> Conversion:
        """
        Return the conversion of objects of a type to a message.

        Parameters
        ----------
        key
            The type to convert.

        Raises
        ------
        TypeException
            No package has registered the type.

        """
        return _entry(self._to_messages, key, 'conversions to messages')

    def get_convert(self, key: tuple[type, type]) -> Conversion | None:
        """
        Return the direct conversion between two types.

        Parameters
        ----------
        key
            The types converted from and to.

        Returns
        -------
        Conversion or None
            None if no direct conversion is registered.

        """
        return self._conversions.get(key)


def _entry(entries: dict[type, EntryT], key: type, kind: str) -> EntryT:
    if key in entries:
        return entries[key]
    known = ', '.join(sorted(entry.__name__ for entry in entries)) or 'none'
    raise TypeException(
        f'Type {key} is not loaded or supported. Import the package that knows it, such as '
        f"'import tf2_geometry_msgs' for geometry_msgs. The {kind} loaded are for: {known}"
    )
