# SPDX-License-Identifier: Apache-2.0
"""A display of a class that no package offers."""

from __future__ import annotations

from collections.abc import Mapping
import copy
from typing import Any

from rviz_common.status import Level, Statuses
from rviz_common.visualizer.entry import Entry

__all__ = ['UnknownEntry']


class UnknownEntry(Entry):
    """
    A display that cannot be made, such as one of an unknown class; it is preserved for the file.

    Parameters
    ----------
    given
        Its entry in the .rviz file.
    reason
        Why it cannot be shown, for the status.

    """

    def __init__(self, given: Mapping[str, Any], reason: str) -> None:
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
