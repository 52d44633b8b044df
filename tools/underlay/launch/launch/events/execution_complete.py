# SPDX-License-Identifier: Apache-2.0
"""The event of an action that has completed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.action import Action


class ExecutionComplete(Event):
    """
    Event of an action whose execution is complete.

    Parameters
    ----------
    action
        The completed action.

    """

    name = 'launch.events.ExecutionComplete'

    def __init__(self, *, action: Action) -> None:
        self.__action = action

    @property
    def action(self) -> Action:
        """Return the completed action."""
        return self.__action
