# SPDX-License-Identifier: Apache-2.0
"""The base class of the events that are meant for certain processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


class ProcessTargetedEvent(Event):
    """
    Base class of events that ask for something to be done to certain processes.

    Parameters
    ----------
    process_matcher
        Called with the action of a process; returns whether the event is meant for it.

    """

    name = 'launch.events.process.ProcessTargetedEvent'

    def __init__(self, *, process_matcher: Callable[[ExecuteLocal], bool]) -> None:
        self.__process_matcher = process_matcher

    @property
    def process_matcher(self) -> Callable[[ExecuteLocal], bool]:
        """Return the matcher."""
        return self.__process_matcher
