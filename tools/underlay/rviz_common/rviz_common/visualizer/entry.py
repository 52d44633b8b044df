# SPDX-License-Identifier: Apache-2.0
"""An entry of the tree of displays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from rviz_common.status import Level, Statuses

__all__ = ['Entry']


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

    @abstractmethod
    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""
