# SPDX-License-Identifier: Apache-2.0
"""The values of the properties of a display, a tool or a view."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import copy
from typing import Any

from rviz_common.properties.property import Property

__all__ = ['Values']


class Values:
    """
    Values of properties, by path; those missing in the file have their defaults.

    Other content of the file is preserved, so that it is written back without losses: only
    values that have been changed since are overwritten.

    Parameters
    ----------
    properties
        The supported properties.
    given
        The section of the file. With None, all properties are written to the file; otherwise
        its content, with the changed values.

    Attributes
    ----------
    properties
        The properties by path.
    refusals
        A message for each invalid value in the file.

    """

    def __init__(
        self, properties: Iterable[Property], given: Mapping[str, Any] | None = None
    ) -> None:
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
        """Return the section for the file: its original content, with the changed values."""
        written = copy.deepcopy(self._given)
        for path in self._values:
            if path in self._changed:
                _put(written, path, self.properties[path].write(self._values[path]))
        return written

    def unknown(self, known: Iterable[str]) -> list[str]:
        """
        List the top-level names in the section of the file that belong to no property.

        Parameters
        ----------
        known
            Other top-level names that are expected there.

        """
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
    """Return the value at a path of nested mappings."""
    for name in path.split('/'):
        if not isinstance(tree, Mapping) or name not in tree:
            return _MISSING
        tree = tree[name]
    return tree


def _put(tree: dict[str, Any], path: str, value: Any) -> None:
    """Set the value at a path of nested mappings."""
    *above, last = path.split('/')
    for name in above:
        below = tree.get(name)
        if not isinstance(below, dict):
            below = tree[name] = {}
        tree = below
    tree[last] = value
