# SPDX-License-Identifier: Apache-2.0
"""Process the events of a launch, and the signals that end it, until it is idle or shut down."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
import logging
import signal
import threading
from typing import Any, Optional, TYPE_CHECKING

from launch.event_handler import BaseEventHandler
from launch.events import IncludeLaunchDescription, Shutdown
from launch.failures import report_failure
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.logging import get_logger
from launch.utilities import normalize_to_list_of_entities, visit_into

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext

_WATCHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)


class EventProcessor:
    """
    Processor that handles the queued events of a launch context one at a time.

    Create it in the thread that runs the event loop.

    Parameters
    ----------
    context
        The context whose event queue and event handlers are used.
    loop
        The event loop of the run.

    Attributes
    ----------
    return_code
        0, or 1 after an error.
    first_error
        The first exception of the run, or None.

    """

    def __init__(self, context: LaunchContext, loop: asyncio.AbstractEventLoop) -> None:
        self.return_code = 0
        self.first_error: Optional[BaseException] = None
        self._context = context
        self._run = context.run
        self._loop = loop
        self._thread = threading.get_ident()
        self._awake = asyncio.Event()
        self._pending: set[asyncio.Future[Any]] = set()
        self._shutting_down = False
        self._logger: logging.Logger = get_logger('launch')

    def wake_up(self) -> None:
        """Wake up the processor to check the event queue; thread-safe."""
        if threading.get_ident() == self._thread:
            self._awake.set()
            return
        try:
            self._loop.call_soon_threadsafe(self._awake.set)
        except RuntimeError:  # the loop is closed; events are no longer handled
            pass

    async def run(self, *, shutdown_when_idle: bool) -> int:
        """
        Handle events until the launch is shut down and all its futures are done.

        Parameters
        ----------
        shutdown_when_idle
            Whether the launch is shut down when neither events nor futures are left.

        Returns
        -------
        int
            The return code: 0, or 1 after an error.

        """
        while True:
            self._track(self._run.completion_futures)
            if self._run.event_queue:
                self.handle(self._run.event_queue.popleft())
                await asyncio.sleep(0)
            elif self._pending or not (self._shutting_down or shutdown_when_idle):
                await self._sleep()
            elif self._shutting_down:
                return self.return_code
            else:
                self._context.emit_event_sync(Shutdown(reason='idle'))

    async def _sleep(self) -> None:
        self._awake.clear()
        if not self._run.event_queue:
            await self._awake.wait()

    def fail(self, error: BaseException) -> None:
        """
        Report an error and shut the launch down with return code 1.

        Parameters
        ----------
        error
            The exception that was raised.

        """
        self.return_code = 1
        self.first_error = self.first_error or error
        report_failure(self._logger, error)
        if self._run.before_start is not None:
            for text in self._run.before_start.explain_failure(self._context):
                self._logger.error('%s', text)
            self._run.before_start = None
        if not self._run.is_shutdown:
            self._run.is_shutdown = True
            self._context.emit_event_sync(Shutdown(reason=str(error)))

    def on_loop_error(self, loop: asyncio.AbstractEventLoop, details: dict[str, Any]) -> None:
        """
        Report an exception that a callback of the event loop raised.

        Exception handler for `loop.set_exception_handler`.

        Parameters
        ----------
        loop
            The event loop, which is not used.
        details
            The context passed by asyncio: `message`, and `exception` if there is one.

        """
        self.fail(details.get('exception') or RuntimeError(details['message']))

    # Events.

    def handle(self, event: Event) -> None:
        """
        Run the matching handlers; on shutdown, run all of them even if one raises an error.

        Parameters
        ----------
        event
            The event, which is no longer in the queue.

        """
        is_shutdown = isinstance(event, Shutdown)
        if is_shutdown:
            self._shutting_down = True
            self._run.is_shutdown = True
        for handler in tuple(self._run.event_handlers):
            try:
                if handler.matches(event):
                    self._run_handler(handler, event)
            except Exception as error:
                self.fail(error)
                if not is_shutdown:
                    return

    def _run_handler(self, handler: BaseEventHandler, event: Event) -> None:
        """Run a handler and visit the entities it returns, in a new scope of local variables."""
        futures: list[tuple[LaunchDescriptionEntity, asyncio.Future[Any]]] = []
        self._run.locals.push()
        self._run.include_stack = getattr(handler, 'include_stack', ())
        try:
            for entity in normalize_to_list_of_entities(handler.handle(event, self._context)):
                visit_into(entity, self._context, futures)
            if isinstance(event, IncludeLaunchDescription):
                self._check_before_start()
        finally:
            self._run.locals.pop()
            self._track([future for _, future in futures])

    def _check_before_start(self) -> None:
        """
        Run the pre-start checks once, after the first description has been visited.

        Entities that wait for events are checked first.
        """
        checks, self._run.before_start = self._run.before_start, None
        if checks is None:
            return
        waiting = any(handler.describe()[1] for handler in self._run.event_handlers)
        if checks.resolves_programs and waiting:
            from launch.preflight import check_what_waits

            check_what_waits(self._context)
        checks.run(self._context, self._logger)

    # Futures.

    def _track(self, futures: list[asyncio.Future[Any]]) -> None:
        """Track futures; the launch is not idle until they are done."""
        for future in futures:
            if future not in self._pending:
                self._pending.add(future)
                future.add_done_callback(self._on_done)
        futures.clear()

    def _on_done(self, future: asyncio.Future[Any]) -> None:
        self._pending.discard(future)
        error: Optional[BaseException] = None if future.cancelled() else future.exception()
        if error is not None:
            self.fail(error)
        self.wake_up()


@contextmanager
def handled_signals(
    loop: asyncio.AbstractEventLoop,
    react: Callable[[signal.Signals], None],
) -> Iterator[None]:
    """
    Handle termination signals within a context.

    These are SIGINT, SIGTERM, SIGQUIT, and SIGHUP unless it is ignored, as under nohup. The
    previous handlers are restored on exit. Use this in the main thread only.

    Parameters
    ----------
    loop
        The event loop that calls `react`.
    react
        Called with each signal.

    """
    before: dict[signal.Signals, Any] = {
        number: signal.getsignal(number) for number in _WATCHED if _is_wanted(number)
    }

    def on_signal(number: int, frame: object) -> None:
        """Wake up the loop, which only waits for file descriptors, and schedule the reaction."""
        loop.call_soon_threadsafe(react, signal.Signals(number))

    for number in before:
        signal.signal(number, on_signal)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _is_wanted(number: signal.Signals) -> bool:
    """Check whether to handle a signal; a SIGHUP that nohup ignores is not handled."""
    return number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN
