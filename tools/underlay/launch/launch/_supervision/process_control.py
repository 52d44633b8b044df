# SPDX-License-Identifier: Apache-2.0
"""Event handling for the process of an action."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.events import Shutdown
from launch.events.process import ProcessStdin, ProcessTargetedEvent, SignalProcess

if TYPE_CHECKING:
    from launch._supervision.supervisor import Supervisor
    from launch.launch_context import LaunchContext

_EVENTS = (ProcessTargetedEvent, ProcessStdin, Shutdown)


class ProcessControl(BaseEventHandler):
    """
    Event handler that forwards the events that target a process to its supervisor.

    Parameters
    ----------
    action
        The action that runs the process, which identifies its events.
    supervisor
        The supervisor of the process.

    """

    def __init__(self, action: object, supervisor: Supervisor) -> None:
        super().__init__(matcher=self.matches)
        self._action = action
        self._supervisor = supervisor

    def matches(self, event: Event) -> bool:
        """
        Whether an event targets the process, or all processes.

        Parameters
        ----------
        event
            The event that was emitted.

        """
        if not isinstance(event, _EVENTS):  # most are not; each process is asked about each event
            return False
        if isinstance(event, ProcessTargetedEvent):
            return event.process_matcher(self._action)
        if isinstance(event, ProcessStdin):
            return event.action is self._action
        return True

    def handle(self, event: Event, context: LaunchContext) -> None:
        """
        Terminate the process, send it a signal, or write to it, depending on the event.

        Parameters
        ----------
        event
            An event that `matches` accepts.
        context
            As for `BaseEventHandler.handle`.

        """
        super().handle(event, context)
        if isinstance(event, SignalProcess):
            self._supervisor.send_signal(event.signal)
        elif isinstance(event, ProcessStdin):
            self._supervisor.write(event.text)
        elif isinstance(event, Shutdown):
            self._supervisor.end_with_launch()
        else:
            self._supervisor.stop()
