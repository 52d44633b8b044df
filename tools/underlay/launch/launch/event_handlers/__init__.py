# SPDX-License-Identifier: Apache-2.0
"""The event handlers that a launch description may register."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.event import Event
    from launch.event_handlers.on_action_event_base import OnActionEventBase, OnExecutionComplete
    from launch.event_handlers.on_shutdown import OnShutdown
    from launch.event_handlers.process_event_handlers import (
        OnProcessExit,
        OnProcessIO,
        OnProcessStart,
    )

__all__ = [
    'OnActionEventBase',
    'OnExecutionComplete',
    'OnProcessExit',
    'OnProcessIO',
    'OnProcessStart',
    'OnShutdown',
    'event_named',
]


def event_named(name: str) -> Callable[[Event], bool]:
    """
    Create a matcher of events by name.

    Parameters
    ----------
    name
        The name, such as `launch.events.Shutdown`.

    Returns
    -------
    callable
        Predicate that accepts an event, and returns whether it has the name.

    """
    return lambda event: event.name == name


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'event_named',
    'on_execution_complete',
    'on_process_exit',
    'on_process_io',
    'on_process_start',
)

_ELSEWHERE = {
    'OnExecutionComplete': 'on_action_event_base',
    'OnProcessExit': 'process_event_handlers',
    'OnProcessIO': 'process_event_handlers',
    'OnProcessStart': 'process_event_handlers',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
