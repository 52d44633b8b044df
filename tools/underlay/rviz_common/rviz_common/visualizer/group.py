# SPDX-License-Identifier: Apache-2.0
"""Displays that are shown together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
import copy
from typing import Any

from rviz_common.status import Level, Statuses
from rviz_common.visualizer.entry import Entry

__all__ = ['Group']


class Group(Entry):
    """
    Displays that are shown together, in the order of the list.

    Parameters
    ----------
    given
        Its entry in the .rviz file, empty for the root group.
    children
        The displays and groups in it.

    """

    CLASS = 'rviz_common/Group'

    def __init__(self, given: Mapping[str, Any], children: list[Entry]) -> None:
        self._given = copy.deepcopy({k: v for k, v in given.items() if k != 'Displays'})
        self._places = list(given)
        self._nothing: list[Any] | None = [] if given.get('Displays') == [] else None
        self.class_name = self.CLASS
        self.name = str(given.get('Name') or 'Group')
        self.children = children
        self._is_enabled = given.get('Enabled', True) is not False
        self._is_shown_above = False
        self._status = Statuses()

    @property
    def is_enabled(self) -> bool:
        """Whether it is enabled."""
        return self._is_enabled

    @property
    def status(self) -> Statuses:
        """The status of the group itself, which is always empty."""
        return self._status

    @property
    def level(self) -> Level:
        """The worst level of the enabled children."""
        return max((each.level for each in self.children if each.is_enabled), default=Level.OK)

    def enable(self, is_enabled: bool) -> None:
        """
        Enable or disable the group, and show or hide its displays accordingly.

        Parameters
        ----------
        is_enabled
            As for `Entry.enable`.

        """
        self._is_enabled = is_enabled
        self.appear(self._is_shown_above)

    def appear(self, is_shown_above: bool) -> None:
        """
        Show the displays if the group and all groups above it are enabled.

        Parameters
        ----------
        is_shown_above
            As for `Entry.appear`.

        """
        self._is_shown_above = is_shown_above
        for child in self.children:
            child.appear(is_shown_above and self._is_enabled)

    def update(self) -> None:
        """Draw the next frame of all displays."""
        for child in self.children:
            child.update()

    def add(self, entry: Entry) -> None:
        """
        Append an entry, and show it if the group is shown.

        Parameters
        ----------
        entry
            A display or a group.

        """
        self.children.append(entry)
        entry.appear(self._is_shown_above and self._is_enabled)

    def remove(self, entry: Entry) -> bool:
        """
        Remove an entry anywhere below the group, and hide it.

        Parameters
        ----------
        entry
            A display or a group.

        Returns
        -------
        bool
            Whether it was found.

        """
        if entry in self.children:
            entry.appear(False)
            self.children.remove(entry)
            return True
        return any(each.remove(entry) for each in self.children if isinstance(each, Group))

    def walk(self) -> Iterator[Entry]:
        """Return all entries below the group, each group before its children."""
        for child in self.children:
            yield child
            if isinstance(child, Group):
                yield from child.walk()

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""
        written = {name: copy.deepcopy(self._given.get(name)) for name in self._places}
        # RViz writes `~` for no displays.
        written['Displays'] = [child.to_file() for child in self.children] or self._nothing
        if 'Enabled' in written or not self._is_enabled:
            written['Enabled'] = self._is_enabled
        if 'Name' in written or self.name != 'Group':
            written['Name'] = self.name
        return written
