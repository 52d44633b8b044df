# SPDX-License-Identifier: Apache-2.0
"""The state that the entities of a launch share."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
import os
from typing import Any, Optional, TYPE_CHECKING

from launch._context_state import (
    ContextLocals,
    EnvironmentScopes,
    LaunchConfigurations,
    LocalsView,
)

if TYPE_CHECKING:
    import asyncio

    from launch._checks.before_start import BeforeStart
    from launch._dry_run_record import VisitObserver
    from launch._include_stack import OpenFile
    from launch._supervision.process_registry import ProcessRegistry
    from launch._supervision.program import Spawn
    from launch.event import Event
    from launch.event_handler import BaseEventHandler
    from launch.substitution import Substitution


class LaunchContext:
    """
    State of a launch: configurations, environment, local variables, event handlers and queue.

    It needs no running event loop.

    Parameters
    ----------
    argv
        The arguments that the launch was started with.
    noninteractive
        Whether the launch runs without a user at a terminal.

    """

    def __init__(
        self,
        *,
        argv: Optional[Iterable[str]] = None,
        noninteractive: bool = False,
    ) -> None:
        self.__argv = list(argv) if argv is not None else []
        self.__noninteractive = noninteractive
        self.__is_shutdown = False
        self.__loop: Optional[asyncio.AbstractEventLoop] = None
        self.__wake_up: Optional[Callable[[], None]] = None
        self.__locals = ContextLocals()
        self.__launch_configurations = LaunchConfigurations()
        self.__configurations_stack: list[dict[str, Any]] = []
        self.__environment = EnvironmentScopes()
        self._event_handlers: deque[BaseEventHandler] = deque()
        self._event_queue: deque[Event] = deque()
        self._completion_futures: list[asyncio.Future[Any]] = []
        self._processes: Optional[ProcessRegistry] = None
        self._spawn: Optional[Spawn] = None
        self._open_files: tuple[OpenFile, ...] = ()
        self._scopes_location = False
        self._warned_locations: set[tuple[str, str]] = set()
        self._observer: Optional[VisitObserver] = None
        self._before_start: Optional[BeforeStart] = None
        self._first_failure: Optional[int] = None

    # Arguments and state of the launch.

    @property
    def argv(self) -> list[str]:
        """Return the arguments that the launch was started with."""
        return self.__argv

    @property
    def noninteractive(self) -> bool:
        """Whether the launch runs without a user at a terminal."""
        return self.__noninteractive

    @property
    def is_shutdown(self) -> bool:
        """Whether the launch is shutting down."""
        return self.__is_shutdown

    def _set_is_shutdown(self, state: bool) -> None:
        self.__is_shutdown = state

    @property
    def asyncio_loop(self) -> Optional[asyncio.AbstractEventLoop]:
        """Return the event loop while the launch runs, else None."""
        return self.__loop

    def _attach(
        self,
        loop: Optional[asyncio.AbstractEventLoop],
        wake_up: Optional[Callable[[], None]],
    ) -> None:
        """Set the event loop that runs the launch, and the callback that wakes it up."""
        self.__loop = loop
        self.__wake_up = wake_up

    # Substitutions and launch configurations.

    def perform_substitution(self, sub: Substitution) -> str:
        """
        Perform a substitution.

        Parameters
        ----------
        sub
            The substitution.

        Returns
        -------
        str
            The string that it currently resolves to.

        """
        return sub.perform(self)

    @property
    def launch_configurations(self) -> LaunchConfigurations:
        """Return the launch configurations, which may be modified."""
        return self.__launch_configurations

    def _push_launch_configurations(self) -> None:
        self.__configurations_stack.append(self.__launch_configurations.snapshot())

    def _pop_launch_configurations(self) -> None:
        if not self.__configurations_stack:
            raise RuntimeError('cannot pop the launch configurations: none have been pushed')
        kept = self.__configurations_stack.pop()
        self.__launch_configurations.clear()
        self.__launch_configurations.update(kept)

    # The environment.

    @property
    def environment(self) -> os._Environ[str]:
        """Return the environment of this process, which children inherit."""
        return os.environ

    def _push_environment(self) -> None:
        self.__environment.push()

    def _pop_environment(self) -> None:
        self.__environment.pop()

    def _reset_environment(self) -> None:
        self.__environment.reset()

    # Locals.

    @property
    def locals(self) -> LocalsView:  # noqa: A003, RUF100
        """Return the local variables, each as an attribute."""
        return self.__locals.view

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return a copy of the local variables."""
        return self.__locals.as_dict()

    def extend_locals(self, extra_locals: Mapping[str, Any]) -> None:
        """
        Add local variables; they last until the current event is handled.

        Parameters
        ----------
        extra_locals
            The values by name.

        """
        self.__locals.extend(extra_locals)

    def extend_globals(self, extra_globals: Mapping[str, Any]) -> None:
        """
        Add variables that last as long as the context does.

        Parameters
        ----------
        extra_globals
            The values by name; local variables of the same names hide them.

        """
        self.__locals.extend_globals(extra_globals)

    def _push_locals(self) -> None:
        self.__locals.push()

    def _pop_locals(self) -> None:
        self.__locals.pop()

    # Events.

    def register_event_handler(
        self,
        event_handler: BaseEventHandler,
        append: bool = False,
    ) -> None:
        """
        Register an event handler.

        Parameters
        ----------
        event_handler
            The handler, which receives each event from now on.
        append
            Whether it comes after all other handlers rather than before them.

        """
        event_handler._open_files = self._open_files
        if append:
            self._event_handlers.append(event_handler)
        else:
            self._event_handlers.appendleft(event_handler)

    def unregister_event_handler(self, event_handler: BaseEventHandler) -> None:
        """
        Unregister an event handler.

        Parameters
        ----------
        event_handler
            The handler.

        Raises
        ------
        ValueError
            The handler is not registered.

        """
        if event_handler not in self._event_handlers:
            raise ValueError(f'the event handler {event_handler!r} is not registered')
        self._event_handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """
        Whether any registered handler matches an event now.

        Parameters
        ----------
        event
            The event, which need not have been emitted.

        """
        return any(handler.matches(event) for handler in tuple(self._event_handlers))

    def emit_event_sync(self, event: Event) -> None:
        """
        Queue an event; this may be called from any thread.

        Parameters
        ----------
        event
            The event, which is handled after those that were queued before.

        """
        self._event_queue.append(event)
        if self.__wake_up is not None:
            self.__wake_up()

    async def emit_event(self, event: Event) -> None:
        """
        Queue an event from a coroutine.

        Parameters
        ----------
        event
            The event, as for `emit_event_sync`.

        """
        self.emit_event_sync(event)

    def add_completion_future(self, completion_future: asyncio.Future[Any]) -> None:
        """
        Keep the launch running until a future is done.

        Parameters
        ----------
        completion_future
            The future, of the event loop that runs the launch; its exception ends the launch.

        """
        self._completion_futures.append(completion_future)
        if self.__wake_up is not None:
            self.__wake_up()
