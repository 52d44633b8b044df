# SPDX-License-Identifier: Apache-2.0
"""The event of a timer that has expired."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.actions.timer_action import TimerAction


class TimerEvent(Event):
    """
    Event of a timer action whose period has elapsed.

    Parameters
    ----------
    timer_action
        The timer.

    """

    name = 'launch.events.TimerEvent'

    def __init__(self, *, timer_action: TimerAction) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> TimerAction:
        """Return the timer."""
        return self.__timer_action
