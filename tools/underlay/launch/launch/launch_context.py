# SPDX-License-Identifier: Apache-2.0
"""The state that the entities of a launch share."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, MutableMapping
import os
from typing import Any, Optional, TYPE_CHECKING

from launch._context_state import LaunchConfigurations, LocalsView
from launch.launch_run import LaunchRun

if TYPE_CHECKING:
    import asyncio

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
        self.__launch_configurations = LaunchConfigurations()
        self.__run = LaunchRun()

    # Arguments and state of the launch.

    @property
    def run(self) -> LaunchRun:
        """Return the state of the launch that its service, checks and supervision share."""
        return self.__run

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
        return self.__run.is_shutdown

    @property
    def asyncio_loop(self) -> Optional[asyncio.AbstractEventLoop]:
        """Return the event loop while the launch runs, else None."""
        return self.__run.loop

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

    # The environment.

    @property
    def environment(self) -> MutableMapping[str, str]:
        """Return the environment of this process, which children inherit."""
        return os.environ

    # Scopes, by the private names of ROS 2 Jazzy that public launch files call.

    def _push_launch_configurations(self) -> None:
        self.__launch_configurations.push_scope()

    def _pop_launch_configurations(self) -> None:
        self.__launch_configurations.pop_scope()

    def _push_environment(self) -> None:
        self.__run.environment.push()

    def _pop_environment(self) -> None:
        self.__run.environment.pop()

    def _reset_environment(self) -> None:
        self.__run.environment.reset()

    # Locals.

    @property
    def locals(self) -> LocalsView:  # noqa: A003, RUF100
        """Return the local variables, each as an attribute."""
        return self.__run.locals.view

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return a copy of the local variables."""
        return self.__run.locals.as_dict()

    def extend_locals(self, extra_locals: Mapping[str, Any]) -> None:
        """
        Add local variables; they last until the current event is handled.

        Parameters
        ----------
        extra_locals
            The values by name.

        """
        self.__run.locals.extend(extra_locals)

    def extend_globals(self, extra_globals: Mapping[str, Any]) -> None:
        """
        Add variables that last as long as the context does.

        Parameters
        ----------
        extra_globals
            The values by name; local variables of the same names hide them.

        """
        self.__run.locals.extend_globals(extra_globals)

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
        event_handler.include_stack = self.__run.include_stack
        if append:
            self.__run.event_handlers.append(event_handler)
        else:
            self.__run.event_handlers.appendleft(event_handler)

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
        if event_handler not in self.__run.event_handlers:
            raise ValueError(f'the event handler {event_handler!r} is not registered')
        self.__run.event_handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """
        Whether any registered handler matches an event now.

        Parameters
        ----------
        event
            The event, which need not have been emitted.

        """
        return any(handler.matches(event) for handler in tuple(self.__run.event_handlers))

    def emit_event_sync(self, event: Event) -> None:
        """
        Queue an event; this may be called from any thread.

        Parameters
        ----------
        event
            The event, which is handled after those that were queued before.

        """
        self.__run.event_queue.append(event)
        self.__run.wake_up()

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
        self.__run.completion_futures.append(completion_future)
        self.__run.wake_up()
