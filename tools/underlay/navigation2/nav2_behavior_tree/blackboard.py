# SPDX-License-Identifier: Apache-2.0
"""What the nodes of a tree tell each other: values by name, remapped from subtree to subtree."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

__all__ = ['Blackboard']


class Blackboard:
    """
    The values of a tree, or of a subtree that shares some with the tree around it.

    Parameters
    ----------
    parent
        The blackboard of the tree around it.
    remapping
        Names here, and what they are called there.
    autoremap
        Whether all further names are shared, too; not those that begin with `_`.

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
        Return a value.

        Parameters
        ----------
        key
            Its name here; with `@` in front, its name on the blackboard of the main tree.
        default
            What is returned if nobody has set it.

        """
        board, name = self._places.get(key) or self._place(key)
        return board._values.get(name, default)

    def set(self, key: str, value: Any) -> None:  # noqa: A003, RUF100
        """
        Set a value for all who share it.

        Parameters
        ----------
        key
            Its name here; with `@` in front, its name on the blackboard of the main tree.
        value
            The value, which is not copied.

        """
        board, name = self._places.get(key) or self._place(key)
        board._values[name] = value
        board._versions[name] = board._versions.get(name, 0) + 1

    def keep(self, key: str, value: Any) -> None:
        """
        Set a value that is not shared with the tree around this one.

        Parameters
        ----------
        key
            Its name here, whatever it was remapped to before.
        value
            The value, which is not copied.

        """
        self._places[key] = (self, key)
        self.set(key, value)

    def unset(self, key: str) -> None:
        """
        Remove a value for all who share it.

        Parameters
        ----------
        key
            Its name here; nothing happens if it is not set.

        """
        board, name = self._place(key)
        board._values.pop(name, None)

    def version(self, key: str) -> int:
        """
        Return the number of times that a value was set.

        Parameters
        ----------
        key
            Its name here.

        """
        board, name = self._place(key)
        return board._versions.get(name, 0)

    def keys(self) -> Iterator[str]:
        """Iterate over the names of the values that are kept here."""
        return iter(self._values)

    def __contains__(self, key: str) -> bool:
        board, name = self._place(key)
        return name in board._values

    def _place(self, key: str) -> tuple[Blackboard, str]:
        """Return on which blackboard a value is, and its name there."""
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
