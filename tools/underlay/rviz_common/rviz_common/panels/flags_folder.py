# SPDX-License-Identifier: Apache-2.0
"""Checkboxes for names that are only discovered at run time."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice
from typing import Any

from rviz_common.context import Context
from rviz_common.properties import Flags, Values

__all__ = ['FlagsFolder']

MOST = 200
"""The maximum number of names with a checkbox."""


class FlagsFolder:
    """
    A folder with a checkbox for each name of a property.

    Parameters
    ----------
    context
        The page.
    of
        The property.
    values
        Holds its value.
    change
        Called with the path of the property and the new flags by name when a user clicks one.

    """

    def __init__(
        self, context: Context, of: Flags, values: Values, change: Callable[[str, Any], None]
    ) -> None:
        self._context = context
        self._path = of.path
        self._values = values
        self._change = change
        label = of.path.rpartition('/')[2]
        self._folder = context.gui.add_folder(label, expand_by_default=False)
        self._boxes: dict[str, Any] = {}
        self.update()

    def update(self) -> None:
        """Add checkboxes for new names, and show values changed by a program."""
        for name, is_on in islice(self._values[self._path].items(), MOST):
            box = self._boxes.get(name)
            if box is None:
                self._add(name, is_on)
            elif box.value != is_on:
                box.value = is_on

    def _add(self, name: str, is_on: bool) -> None:
        with self._folder:
            box = self._context.gui.add_checkbox(name or '(no name)', is_on)
        self._boxes[name] = box
        self._context.on_input(box, lambda value: self._set(name, value))

    def _set(self, name: str, is_on: bool) -> None:
        self._change(self._path, {**self._values[self._path], name: is_on})
