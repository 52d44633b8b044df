# SPDX-License-Identifier: Apache-2.0
"""The state of a launch that its service, checks, dry run and supervision share."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING

from launch._context_state import ContextLocals, EnvironmentScopes

if TYPE_CHECKING:
    import asyncio

    from launch._checks.before_start import BeforeStart
    from launch._dry_run_record import VisitObserver
    from launch._include_stack import OpenFile
    from launch._supervision.process_registry import ProcessRegistry
    from launch.event import Event
    from launch.event_handler import BaseEventHandler


class LaunchRun:
    """
    State of a launch behind its context; `LaunchContext.run` returns it.

    Launch files have no need of it: it is for the packages that run, check or extend launches.

    Attributes
    ----------
    is_shutdown
        Whether the launch is shutting down.
    loop
        The event loop while the launch runs, else None.
    event_queue
        The events that are still to be handled, oldest first.
    event_handlers
        The registered event handlers, in the order in which they receive an event.
    completion_futures
        The futures that keep the launch running and that the event processor has not seen yet.
    locals
        The local variables, with a stack of scopes.
    environment
        The stack of saved copies of the environment.
    include_stack
        The launch files being read, each included by the previous one.
    scopes_location
        Whether ThisLaunchFile refers to the including file again after an include.
    warned_locations
        The pairs of files for which a warning about ThisLaunchFile has been given.
    observer
        The observer of visited entities during a dry run, else None.
    before_start
        The pre-start checks, None once they have run.
    processes
        The registry of processes while the launch runs, else None.
    first_failure
        The exit status of the first process that failed, as a shell reports it, or None.

    """

    def __init__(self) -> None:
        self.is_shutdown = False
        self.loop: Optional[asyncio.AbstractEventLoop] = None
        self.event_queue: deque[Event] = deque()
        self.event_handlers: deque[BaseEventHandler] = deque()
        self.completion_futures: list[asyncio.Future[Any]] = []
        self.locals = ContextLocals()
        self.environment = EnvironmentScopes()
        self.include_stack: tuple[OpenFile, ...] = ()
        self.scopes_location = False
        self.warned_locations: set[tuple[str, str]] = set()
        self.observer: Optional[VisitObserver] = None
        self.before_start: Optional[BeforeStart] = None
        self.processes: Optional[ProcessRegistry] = None
        self.first_failure: Optional[int] = None
        self._wake_up: Optional[Callable[[], None]] = None

    def attach(
        self,
        loop: Optional[asyncio.AbstractEventLoop],
        wake_up: Optional[Callable[[], None]] = None,
    ) -> None:
        """
        Set the event loop that runs the launch.

        Parameters
        ----------
        loop
            The event loop; None when the launch no longer runs.
        wake_up
            Called, from any thread, when there is an event or a future to be looked at.

        """
        self.loop = loop
        self._wake_up = wake_up

    def wake_up(self) -> None:
        """Wake up the event processor, if there is one; this may be called from any thread."""
        if self._wake_up is not None:
            self._wake_up()

    def note(self, **facts: Any) -> None:
        """
        Report facts about the entity that is being visited, if the visit is observed.

        Parameters
        ----------
        **facts
            The facts by name, as `launch._dry_run_record` lists them.

        """
        if self.observer is not None:
            self.observer.note(**facts)

    def note_failure(self, return_code: int) -> None:
        """
        Record the failure of a process, unless another one has failed before.

        Parameters
        ----------
        return_code
            The exit status, negative for a signal.

        """
        if self.first_failure is None:
            self.first_failure = 128 - return_code if return_code < 0 else return_code
