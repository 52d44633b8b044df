# SPDX-License-Identifier: Apache-2.0
"""The event that includes a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription


class IncludeLaunchDescription(Event):
    """
    Event that includes a launch description.

    Parameters
    ----------
    launch_description
        The description to visit.

    """

    name = 'launch.events.IncludeLaunchDescription'

    def __init__(self, launch_description: LaunchDescription) -> None:
        self.__launch_description = launch_description

    @property
    def launch_description(self) -> LaunchDescription:
        """Return the description to visit."""
        return self.__launch_description
