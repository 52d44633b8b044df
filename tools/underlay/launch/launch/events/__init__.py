# SPDX-License-Identifier: Apache-2.0
"""The events that handlers react to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING

from launch.event import Event
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.events import process
    from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = [
    'ExecutionComplete',
    'IncludeLaunchDescription',
    'Shutdown',
    'TimerEvent',
    'matches_action',
    'process',
]


class ExecutionComplete(Event):
    """
    Event of an action whose execution is complete.

    Parameters
    ----------
    action
        The completed action.

    """

    name = 'launch.events.ExecutionComplete'

    def __init__(self, *, action: LaunchDescriptionEntity) -> None:
        self.__action = action

    @property
    def action(self) -> LaunchDescriptionEntity:
        """Return the completed action."""
        return self.__action


class IncludeLaunchDescription(Event):
    """
    Event that includes a launch description.

    Parameters
    ----------
    launch_description
        The description to visit.

    """

    name = 'launch.events.IncludeLaunchDescription'

    def __init__(self, launch_description: LaunchDescriptionEntity) -> None:
        self.__launch_description = launch_description

    @property
    def launch_description(self) -> LaunchDescriptionEntity:
        """Return the description to visit."""
        return self.__launch_description


class Shutdown(Event):
    """
    Event of the shutdown of the launch.

    Parameters
    ----------
    reason
        The reason for the shutdown, for the user.
    due_to_sigint
        Whether the user pressed Ctrl-C.

    """

    name = 'launch.events.Shutdown'

    def __init__(
        self,
        *,
        reason: str = 'reason not given',
        due_to_sigint: bool = False,
    ) -> None:
        self.__reason = reason
        self.__due_to_sigint = due_to_sigint

    @property
    def reason(self) -> str:
        """Return the reason for the shutdown."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Whether the user pressed Ctrl-C."""
        return self.__due_to_sigint


class TimerEvent(Event):
    """
    Event of a timer action whose period has elapsed.

    Parameters
    ----------
    timer_action
        The timer.

    """

    name = 'launch.events.TimerEvent'

    def __init__(self, *, timer_action: LaunchDescriptionEntity) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> LaunchDescriptionEntity:
        """Return the timer."""
        return self.__timer_action


def matches_action(target_action: LaunchDescriptionEntity) -> Callable[[Any], bool]:
    """
    Create a matcher of one action.

    Parameters
    ----------
    target_action
        The action that runs a process.

    Returns
    -------
    callable
        Predicate that accepts an action, and returns whether it is this one.

    """
    return lambda action: action is target_action


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'execution_complete',
    'include_launch_description',
    'matchers',
    'shutdown',
    'timer_event',
)

_ELSEWHERE = {
    'process': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
