# SPDX-License-Identifier: Apache-2.0
"""Blackboards: values that the nodes of a tree share by name, remapped between subtrees."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

__all__ = ['Blackboard']


class _Entries:
    """The entries that one blackboard stores: their values, and how often each was set."""

    def __init__(self) -> None:
        self.values: dict[str, Any] = {}
        self.versions: dict[str, int] = {}


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
        self._own = _Entries()
        self._places: dict[str, tuple[_Entries, str]] = {}

    @property
    def root(self) -> Blackboard:
        """The blackboard of the main tree."""
        return self if self._parent is None else self._parent.root

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
        entries, name = self._places.get(key) or self.locate(key)
        return entries.values.get(name, default)

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
        entries, name = self._places.get(key) or self.locate(key)
        entries.values[name] = value
        entries.versions[name] = entries.versions.get(name, 0) + 1

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
        self._places[key] = (self._own, key)
        self.set(key, value)

    def unset(self, key: str) -> None:
        """
        Remove an entry for all blackboards that share it.

        Parameters
        ----------
        key
            Its name on this blackboard; nothing happens if it is not set.

        """
        entries, name = self.locate(key)
        entries.values.pop(name, None)

    def version(self, key: str) -> int:
        """
        Count how often an entry was set.

        Parameters
        ----------
        key
            Its name on this blackboard.

        """
        entries, name = self.locate(key)
        return entries.versions.get(name, 0)

    def keys(self) -> Iterator[str]:
        """Iterate over the names of the entries stored on this blackboard."""
        return iter(self._own.values)

    def __contains__(self, key: str) -> bool:
        entries, name = self.locate(key)
        return name in entries.values

    def locate(self, key: str) -> tuple[_Entries, str]:
        """
        Resolve which blackboard stores an entry: its entries, and the name there.

        Parameters
        ----------
        key
            The name of the entry on this blackboard.

        """
        if key not in self._places:
            self._places[key] = self._find(key)
        return self._places[key]

    def _find(self, key: str) -> tuple[_Entries, str]:
        if key.startswith('@'):
            return self.root.locate(key[1:])
        if self._parent is None:
            return self._own, key
        if key in self._remapping:
            return self._parent.locate(self._remapping[key])
        if self._autoremap and not key.startswith('_'):
            return self._parent.locate(key)
        return self._own, key
