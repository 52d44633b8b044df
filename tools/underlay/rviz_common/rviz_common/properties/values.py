# SPDX-License-Identifier: Apache-2.0
"""What the properties of a display, a tool or a view are set to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import copy
from typing import Any

from rviz_common.properties.property import Property

__all__ = ['Values']


class Values:
    """
    The values of some properties, by path; those that a file does not give have their defaults.

    What a file has besides is kept, so that a file is written back without losses: of what a file
    gives, only what has been changed since is written anew.
    """

    def __init__(
        self, properties: Iterable[Property], given: Mapping[str, Any] | None = None
    ) -> None:
        """
        Take the values that a file gives; `refusals` says which of them cannot be used.

        Without any, all are new to the file, and are written.
        """
        self.properties = {each.path: each for each in properties}
        self._given: dict[str, Any] = copy.deepcopy(dict(given or {}))
        self._values = {path: each.default for path, each in self.properties.items()}
        self.refusals: list[str] = []
        for path in self.properties:
            self._take(path)
        self._changed: set[str] = set(self.properties) if given is None else set()

    def __getitem__(self, path: str) -> Any:
        """Return the value of a property."""
        return self._values[path]

    def __setitem__(self, path: str, value: Any) -> None:
        """Set a property, or raise ValueError with the reason."""
        value = self.properties[path].read(value)
        if value != self._values[path]:
            self._values[path] = value
            self._changed.add(path)

    def to_file(self) -> dict[str, Any]:
        """Return what a file is to have: what it had, with the values that have been changed."""
        written = copy.deepcopy(self._given)
        for path in self._values:
            if path in self._changed:
                _put(written, path, self.properties[path].write(self._values[path]))
        return written

    def unknown(self, known: Iterable[str]) -> list[str]:
        """Return the paths that a file gives, but that are no properties and not below `known`."""
        tops = {path.partition('/')[0] for path in self.properties} | set(known)
        return [name for name in self._given if name not in tops]

    def _take(self, path: str) -> None:
        found = _get(self._given, path)
        if found is _MISSING:
            return
        try:
            self._values[path] = self.properties[path].read(found)
        except ValueError as error:
            self.refusals.append(f"'{path}' {error}.")


_MISSING = object()


def _get(tree: Any, path: str) -> Any:
    """Return what is at a path of nested mappings."""
    for name in path.split('/'):
        if not isinstance(tree, Mapping) or name not in tree:
            return _MISSING
        tree = tree[name]
    return tree


def _put(tree: dict[str, Any], path: str, value: Any) -> None:
    """Set what is at a path of nested mappings."""
    *above, last = path.split('/')
    for name in above:
        below = tree.get(name)
        if not isinstance(below, dict):
            below = tree[name] = {}
        tree = below
    tree[last] = value
