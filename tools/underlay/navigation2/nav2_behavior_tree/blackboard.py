# SPDX-License-Identifier: Apache-2.0
"""Blackboards: values that the nodes of a tree share by name, remapped between subtrees."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

__all__ = ['Blackboard']


class Blackboard:
    """
    Blackboard of a tree, or of a subtree that shares some entries with its parent tree.

    Parameters
    ----------
    parent
        The blackboard of the parent tree.
    remapping
        Names on this blackboard, and their names on that of the parent.
    autoremap
        Whether all other names are shared, too, except for those that start with `_`.

    """

    def __init__(
        self,
        parent: Blackboard | None = None,
        remapping: Mapping[str, str] | None = None,
        autoremap: bool = False,
    ) -> None:
        self._parent, self._remapping = parent, dict(remapping or {})
        self._autoremap = autoremap and parent is not None
        self._values: dict[str, Any] = {}
        self._versions: dict[str, int] = {}
        self._places: dict[str, tuple[Blackboard, str]] = {}

    def get(self, key: str, default: Any = None) -> Any:
        """
        Get the value of an entry.

        Parameters
        ----------
        key
            Its name on this blackboard; with the prefix `@`, its name on that of the main tree.
        default
            The value to return if it is not set.

        """
        board, name = self._places.get(key) or self._place(key)
        return board._values.get(name, default)

    def set(self, key: str, value: Any) -> None:  # noqa: A003, RUF100
        """
        Set the value of an entry for all blackboards that share it.

        Parameters
        ----------
        key
            Its name on this blackboard; with the prefix `@`, its name on that of the main tree.
        value
            The value, which is not copied.

        """
        board, name = self._places.get(key) or self._place(key)
        board._values[name] = value
        board._versions[name] = board._versions.get(name, 0) + 1

    def keep(self, key: str, value: Any) -> None:
        """
        Set an entry that is not shared with the parent tree.

        Parameters
        ----------
        key
            Its name on this blackboard; any remapping of it is removed.
        value
            The value, which is not copied.

        """
        self._places[key] = (self, key)
        self.set(key, value)

    def unset(self, key: str) -> None:
        """
        Remove an entry for all blackboards that share it.

        Parameters
        ----------
        key
            Its name on this blackboard; nothing happens if it is not set.

        """
        board, name = self._place(key)
        board._values.pop(name, None)

    def version(self, key: str) -> int:
        """
        Count how often an entry was set.

        Parameters
        ----------
        key
            Its name on this blackboard.

        """
        board, name = self._place(key)
        return board._versions.get(name, 0)

    def keys(self) -> Iterator[str]:
        """Iterate over the names of the entries stored on this blackboard."""
        return iter(self._values)

    def __contains__(self, key: str) -> bool:
        board, name = self._place(key)
        return name in board._values

    def _place(self, key: str) -> tuple[Blackboard, str]:
        """Resolve the blackboard that stores an entry, and its name there."""
        if key not in self._places:
            self._places[key] = self._find(key)
        return self._places[key]

    def _find(self, key: str) -> tuple[Blackboard, str]:
        if key.startswith('@'):
            root = self
            while root._parent is not None:
                root = root._parent
            return root._place(key[1:])
        if self._parent is None:
            return self, key
        if key in self._remapping:
            return self._parent._place(self._remapping[key])
        if self._autoremap and not key.startswith('_'):
            return self._parent._place(key)
        return self, key
