# SPDX-License-Identifier: Apache-2.0
"""Observe a launch for its tests: when it is ready, what its processes do and why it ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
import signal
from typing import Any, Optional, TYPE_CHECKING

from launch import EventHandler
from launch.actions import IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown
from launch.events import Shutdown
from launch.events.process import ProcessExited
from launch_testing.actions.ready_to_test import ReadyToTest, TestsMayBegin
from launch_testing.io_handler import ActiveIoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler

if TYPE_CHECKING:
    from launch import LaunchContext, LaunchDescriptionEntity


class Observation:
    """Recorder of process starts, exits and output, and of the reason for shutdown."""

    def __init__(self) -> None:
        """Create an empty observation."""
        self.proc_info = ActiveProcInfoHandler()
        self.proc_output = ActiveIoHandler()
        self.is_closed = False
        self._shutdown: Optional[Shutdown] = None

    def actions(self) -> list[RegisterEventHandler]:
        """Return the actions that register the event handlers of the observation."""
        return [
            RegisterEventHandler(OnProcessStart(on_start=self._on_start)),
            RegisterEventHandler(OnProcessExit(on_exit=self._on_exit)),
            RegisterEventHandler(
                OnProcessIO(
                    on_stdout=self.proc_output.append,
                    on_stderr=self.proc_output.append,
                )
            ),
            RegisterEventHandler(OnShutdown(on_shutdown=self._on_shutdown)),
        ]

    def close(self) -> None:
        """Abort all waits of tests, as the launch has ended."""
        self.is_closed = True
        self.proc_info.close()
        self.proc_output.close()

    @property
    def was_interrupted(self) -> bool:
        """Whether the launch was ended by a signal."""
        shutdown = self._shutdown
        return shutdown is not None and (
            shutdown.due_to_sigint or shutdown.reason in signal.Signals.__members__
        )

    def explain_end(self, status: int, *, was_ready: bool) -> str:
        """
        Return a failure message that explains why a launch ended early.

        Parameters
        ----------
        status
            The return code of the launch service; 0 for success.
        was_ready
            Whether the launch had been ready for its tests.

        """
        when = 'before the tests were done' if was_ready else 'before it was ready'
        if status != 0:
            reason = self._shutdown.reason if self._shutdown else 'see its output'
            return f'The launch failed {when}: {reason}'
        if self._shutdown is not None and self._shutdown.reason != 'idle':
            return f'The launch was shut down {when}: {self._shutdown.reason}'
        return (
            f'All processes of the launch ended {when}. If that is right, add the process '
            'launch_testing.util.KeepAliveProc or the decorator launch_testing.markers.keep_alive.'
        )

    def report(self) -> str:
        """Format the states of the processes and their last output, for error messages."""
        states = ''.join(
            f'\n  {info.process_name}: '
            + (
                f'ended with exit code {info.returncode}'
                if isinstance(info, ProcessExited)
                else 'was running'
            )
            for info in self.proc_info
        )
        if not states:
            return '\nNo process was started.'
        return f'\nThe processes:{states}' + self.proc_output.last_output(
            self.proc_info.processes()
        )

    def _on_start(self, event: Any, context: Any) -> None:
        self.proc_output.track(event.action)
        self.proc_info.append(event)

    def _on_exit(self, event: Any, context: Any) -> None:
        self.proc_info.append(event)

    def _on_shutdown(self, event: Any, context: Any) -> None:
        if self._shutdown is None:
            self._shutdown = event


class ReadyHandler(EventHandler):
    """
    Event handler that calls a function as soon as all ReadyToTest actions have been visited.

    Parameters
    ----------
    description
        The launch description; included files are not searched.
    on_ready
        Called without arguments, and again on each later event.

    """

    def __init__(
        self,
        description: LaunchDescriptionEntity,
        on_ready: Callable[[], None],
    ) -> None:
        super().__init__(matcher=lambda event: isinstance(event, TestsMayBegin))
        self._missing = set(ready_actions([description]))
        self._on_ready = on_ready

    def handle(self, event: Any, context: LaunchContext) -> None:
        """
        Record that the action of the event was visited.

        Parameters
        ----------
        event
            A TestsMayBegin.
        context
            The context of the launch.

        """
        super().handle(event, context)
        self._missing.discard(event.action)
        if not self._missing:
            self._on_ready()


def ready_actions(entities: Iterable[LaunchDescriptionEntity]) -> Iterator[object]:
    """
    Yield all ReadyToTest actions that can be found without executing anything.

    Parameters
    ----------
    entities
        The entities to search, including their sub-entities but not included files.

    """
    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        elif not isinstance(entity, IncludeLaunchDescription):
            yield from ready_actions(entity.describe_sub_entities())
            for _, children in entity.describe_conditional_sub_entities():
                yield from ready_actions(children)
