# SPDX-License-Identifier: Apache-2.0
"""The state of a launch that its service, checks, dry run and supervision share."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Optional, Protocol, TYPE_CHECKING

from launch._context_state import ContextLocals, EnvironmentScopes

if TYPE_CHECKING:
    import asyncio

    from launch._before_start import BeforeStart
    from launch._supervision.member import Member
    from launch._supervision.program import Child, Program
    from launch.event import Event
    from launch.event_handler import BaseEventHandler
    from launch.failures import OpenFile
    from launch.launch_description_entity import LaunchDescriptionEntity


class VisitObserver:
    """Observer of visited entities; this base class ignores all notifications."""

    def enter(self, entity: LaunchDescriptionEntity) -> None:
        """
        Handle the start of the visit of an entity.

        Parameters
        ----------
        entity
            The entity that is about to be visited.

        """

    def leave(self, entity: LaunchDescriptionEntity) -> None:
        """
        Handle the end of the visit of an entity, unless it has failed.

        Parameters
        ----------
        entity
            The entity, which has been visited with all its sub-entities.

        """

    def expanded(self, text: str) -> None:
        """
        Handle the expansion of the expression of a condition.

        Parameters
        ----------
        text
            The expanded expression.

        """

    def decided(self, entity: LaunchDescriptionEntity, value: bool) -> None:
        """
        Handle the evaluation of the condition of an entity.

        Parameters
        ----------
        entity
            The entity that has the condition.
        value
            Whether the condition is fulfilled.

        """

    def note(self, **facts: Any) -> None:
        """
        Handle facts about the entity that is being visited.

        Parameters
        ----------
        **facts
            The facts by name; `launch.dry_run_record` lists the names.

        """

    def note_waiting(self, event: str, entities: Iterable[LaunchDescriptionEntity]) -> None:
        """
        Handle the entities that the visited entity leaves waiting for an event.

        Parameters
        ----------
        event
            A description of the event.
        entities
            The entities that are visited on the event.

        """

    def environment_changes(self, environment: dict[str, str]) -> dict[str, Optional[str]]:
        """
        Compare the environment of a process with that at the start of the visit.

        Parameters
        ----------
        environment
            The variables of the process.

        Returns
        -------
        dict
            The variables that differ, None for those that are unset; always empty here.

        """
        return {}


class GroupLeader(Protocol):
    """A process of the launch that leads a group of its own, as the registry knows it."""

    @property
    def pid(self) -> int:
        """Return the id of the process, which is also that of its group."""

    def kill_at_once(self) -> None:
        """Kill the process group, and wait for the process to exit."""


class RunningProcesses(Protocol):
    """
    The running processes of a launch, as the supervisor of one of them knows them.

    `launch._supervision.process_registry` has them while the launch runs.
    """

    async def spawn(self, program: Program, stdout: int, stderr: int) -> Child:
        """
        Start a program.

        Parameters
        ----------
        program
            The program to start.
        stdout, stderr
            The file descriptors for its output.

        """

    def add(self, process: GroupLeader, sigterm_s: float, sigkill_s: float) -> None:
        """
        Register a process that was started.

        Parameters
        ----------
        process
            The process.
        sigterm_s, sigkill_s
            The time from SIGINT to SIGTERM and from SIGTERM to SIGKILL, in s.

        """

    def remove(self, process: GroupLeader) -> None:
        """
        Unregister a process that has exited with all of its group.

        Parameters
        ----------
        process
            The process.

        """

    def hurry(self) -> None:
        """Start without delay what is still to be started."""

    def end_remainder(self) -> None:
        """Start to terminate processes that have left their process groups."""

    def detaches(self, environment: Mapping[str, str]) -> bool:
        """
        Whether a process with this environment may outlive the launch.

        Parameters
        ----------
        environment
            Its variables.

        """

    def descendants(self, pid: int) -> list[Member]:
        """
        List the processes that a process has started, directly or indirectly.

        Parameters
        ----------
        pid
            The id of the process.

        """


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
        The running processes while the launch runs, else None.
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
        self.processes: Optional[RunningProcesses] = None
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
            The facts by name, as `launch.dry_run_record` lists them.

        """
        if self.observer is not None:
            self.observer.note(**facts)

    def note_file(self, path: str) -> None:
        """
        Record a file that the launch reads, for the check of stale files.

        Parameters
        ----------
        path
            The path of the file, as it is opened; it is not recorded once the checks have run.

        """
        if self.before_start is not None:
            self.before_start.files[path] = None

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
