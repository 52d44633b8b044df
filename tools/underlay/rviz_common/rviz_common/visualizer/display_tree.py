# SPDX-License-Identifier: Apache-2.0
"""The tree of displays: what all entries have in common, groups, and unknown displays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
import copy
from typing import Any

from rviz_common.selection import Hit, nearest, Ray
from rviz_common.status import Level, Statuses

__all__ = ['Entry', 'Group', 'UnknownEntry']


class Entry(ABC):
    """An entry of the tree of displays: a display, a group, or an unknown entry."""

    name: str
    class_name: str

    @property
    @abstractmethod
    def is_enabled(self) -> bool:
        """Whether it is enabled."""

    @property
    @abstractmethod
    def status(self) -> Statuses:
        """The status of the entry."""

    @property
    def level(self) -> Level:
        """The worst level of the entry and all entries below it."""
        return self.status.level

    @abstractmethod
    def enable(self, is_enabled: bool) -> None:
        """
        Enable or disable the entry, as the user does.

        Parameters
        ----------
        is_enabled
            Whether it is to be shown.

        """

    @abstractmethod
    def appear(self, is_shown_above: bool) -> None:
        """
        Show the entry if it is enabled and all groups above it are; hide it otherwise.

        Parameters
        ----------
        is_shown_above
            Whether all groups above it are shown.

        """

    @abstractmethod
    def update(self) -> None:
        """Draw the next frame."""

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find the first object on a ray among those that the entry shows.

        Parameters
        ----------
        ray
            The ray, in the fixed frame.

        """
        return None

    @abstractmethod
    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""


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

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find the first object on a ray among those of all displays.

        Parameters
        ----------
        ray
            As for `Entry.pick`.

        """
        return nearest([child.pick(ray) for child in self.children])

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


class UnknownEntry(Entry):
    """
    A display that cannot be made, such as one of an unknown class; it is preserved for the file.

    Parameters
    ----------
    given
        Its entry in the .rviz file.
    reason
        Why it cannot be shown, for the status.

    Attributes
    ----------
    reason
        The same.

    """

    def __init__(self, given: Mapping[str, Any], reason: str) -> None:
        self.reason = reason
        self._given = copy.deepcopy(dict(given))
        self.class_name = str(given['Class'])
        self._first_name = self.name = str(given.get('Name') or self.class_name)
        self._status = Statuses()
        self._status.say('Class', Level.WARN, reason)

    @property
    def is_enabled(self) -> bool:
        """Whether the file enables the display."""
        return bool(self._given.get('Enabled', True))

    @property
    def status(self) -> Statuses:
        """The reason why it is not shown."""
        return self._status

    def enable(self, is_enabled: bool) -> None:
        """
        Set whether the file enables the display.

        Parameters
        ----------
        is_enabled
            As for `Entry.enable`.

        """
        self._given['Enabled'] = self._given['Value'] = is_enabled

    def appear(self, is_shown_above: bool) -> None:
        """
        Do nothing, since there is nothing to show.

        Parameters
        ----------
        is_shown_above
            As for `Entry.appear`.

        """

    def update(self) -> None:
        """Draw nothing."""

    def to_file(self) -> dict[str, Any]:
        """Return the original entry of the file."""
        written = copy.deepcopy(self._given)
        if self.name != self._first_name:
            written['Name'] = self.name
        return written
