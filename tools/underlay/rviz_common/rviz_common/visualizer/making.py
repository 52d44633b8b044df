# SPDX-License-Identifier: Apache-2.0
"""The factory of displays."""

from __future__ import annotations

from collections.abc import Mapping
import itertools
from typing import Any

from rviz_common.context import Context
from rviz_common.plugins import DISPLAYS, load_plugin
from rviz_common.visualizer.display_entry import DisplayEntry
from rviz_common.visualizer.entry import Entry
from rviz_common.visualizer.group import Group
from rviz_common.visualizer.unknown_entry import UnknownEntry

__all__ = ['Maker']


class Maker:
    """
    Factory of entries; each display gets its own path of the scene.

    Parameters
    ----------
    context
        The context of the displays.
    root
        The path of the scene below which they draw.

    """

    def __init__(self, context: Context, root: str) -> None:
        self._context = context
        self._root = root
        self._numbers = itertools.count(1)

    def entry(self, given: Mapping[str, Any]) -> Entry:
        """
        Make an entry with all its children from a .rviz file; it is not shown yet.

        Parameters
        ----------
        given
            The entry of the file, with its `Class`.

        Returns
        -------
        Entry
            A display or a group; an `UnknownEntry` if the display cannot be made.

        """
        if given['Class'] == Group.CLASS:
            below = given.get('Displays') or []
            return Group(given, [self.entry(each) for each in below])
        try:
            kind = load_plugin(DISPLAYS, given['Class'])
        except LookupError:
            return UnknownEntry(
                given, f"No package offers displays of the class '{given['Class']}'."
            )
        except ImportError as error:
            return UnknownEntry(given, f"'{given['Class']}' cannot be used: {error}")
        try:
            return DisplayEntry(kind(self._context, self._path(), given))
        except Exception as error:  # a failing display must not stop the others
            return UnknownEntry(
                given, f"'{given['Class']}' cannot be made: {type(error).__name__}: {error}"
            )

    def new(self, class_name: str) -> DisplayEntry:
        """
        Make a display of a class with its defaults.

        Parameters
        ----------
        class_name
            The class, such as `rviz_default_plugins/Grid`.

        Raises
        ------
        LookupError
            No installed package offers it.
        ImportError
            The module of the class cannot be imported.

        """
        return DisplayEntry(load_plugin(DISPLAYS, class_name)(self._context, self._path()))

    def _path(self) -> str:
        return f'{self._root}/{next(self._numbers)}'
