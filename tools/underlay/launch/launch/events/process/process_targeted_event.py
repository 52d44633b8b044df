# SPDX-License-Identifier: Apache-2.0
"""The base class of events that target certain processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


class ProcessTargetedEvent(Event):
    """
    Base class of events that target certain processes.

    Parameters
    ----------
    process_matcher
        Called with the action of a process; returns whether the event targets it.

    """

    name = 'launch.events.process.ProcessTargetedEvent'

    def __init__(self, *, process_matcher: Callable[[ExecuteLocal], bool]) -> None:
        self.__process_matcher = process_matcher

    @property
    def process_matcher(self) -> Callable[[ExecuteLocal], bool]:
        """Return the matcher."""
        return self.__process_matcher
