# SPDX-License-Identifier: Apache-2.0
"""The event of an action that is done."""

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
        The action that is done.

    """

    name = 'launch.events.ExecutionComplete'

    def __init__(self, *, action: Action) -> None:
        self.__action = action

    @property
    def action(self) -> Action:
        """Return the action that is done."""
        return self.__action
