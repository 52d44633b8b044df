# SPDX-License-Identifier: Apache-2.0
"""The service that runs launch descriptions."""

from __future__ import annotations

from collections.abc import Iterable
import logging
import signal
import threading
from typing import Any, Optional, TYPE_CHECKING

from launch._before_start import BeforeStart
from launch.event_handler import EventHandler
from launch.events import IncludeLaunchDescription, Shutdown
from launch.launch_context import LaunchContext

if TYPE_CHECKING:
    import asyncio

    from launch.event import Event
    from launch.launch_description import LaunchDescription


class LaunchService:
    """
    Service that runs launch descriptions: visits them and handles events until it is idle.

    Parameters
    ----------
    argv
        The arguments that the launch was started with, for the context.
    noninteractive
        Whether the launch runs without a user at a terminal.
    debug
        Whether the log level is set to DEBUG.
    prefork
        Whether Python nodes may be forked from a template rather than executed.

    """

    def __init__(
        self,
        *,
        argv: Optional[Iterable[str]] = None,
        noninteractive: bool = False,
        debug: bool = False,
        prefork: bool = True,
    ) -> None:
        self.__context = LaunchContext(argv=argv, noninteractive=noninteractive)
        self.__context.run.before_start = BeforeStart()
        self.__context.register_event_handler(_IncludeHandler())
        self.__debug = debug
        self.__prefork = prefork
        self.__loop: Optional[asyncio.AbstractEventLoop] = None
        self.__task: Optional[asyncio.Task[int]] = None
        self.__interrupted = False
        self.__signals = 0
        self.__lock = threading.Lock()

    @property
    def context(self) -> LaunchContext:
        """Return the context."""
        return self.__context

    @property
    def event_loop(self) -> Optional[asyncio.AbstractEventLoop]:
        """Return the event loop while the service runs."""
        return self.__loop

    @property
    def task(self) -> Optional[asyncio.Task[int]]:
        """Return the task of the service while it runs."""
        return self.__task

    def emit_event(self, event: Event) -> None:
        """
        Queue an event; this may be called from any thread, also before the service runs.

        Parameters
        ----------
        event
            The event, which is handled after those that were queued before.

        """
        self.__context.emit_event_sync(event)

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """
        Queue a launch description to be visited; this may be called from any thread.

        Parameters
        ----------
        launch_description
            The description.

        """
        self.emit_event(IncludeLaunchDescription(launch_description))

    def shutdown(self, force_sync: bool = False) -> Optional[asyncio.Future[None]]:
        """
        Shut the service down; this may be called from any thread.

        Parameters
        ----------
        force_sync
            Whether to return None in any case.

        Returns
        -------
        Future or None
            A completed future, in the main thread while the service runs; else None.

        """
        self.emit_event(Shutdown(reason='LaunchService.shutdown() called'))
        loop = self.__loop
        if (
            force_sync
            or loop is None
            or threading.current_thread() is not (threading.main_thread())
        ):
            return None
        future: asyncio.Future[None] = loop.create_future()
        future.set_result(None)
        return future

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """
        Run the service in a new event loop until the launch is done.

        Parameters
        ----------
        shutdown_when_idle
            Whether it shuts down when neither events nor futures are left.

        Returns
        -------
        int
            0, or 1 if an exception occurred in the launch.

        Raises
        ------
        RuntimeError
            This is not the main thread, or the service is running already.

        """
        _require_main_thread()
        import asyncio

        loop = asyncio.new_event_loop()
        asyncio.set_event_loop(loop)
        try:
            return loop.run_until_complete(self.run_async(shutdown_when_idle=shutdown_when_idle))
        finally:
            cancel_all_tasks(loop)
            asyncio.set_event_loop(None)
            loop.close()

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """
        Run the service in the running event loop until the launch is done.

        Parameters
        ----------
        shutdown_when_idle
            As for `run`.

        Returns
        -------
        int
            0, or 1 if an exception occurred in the launch.

        Raises
        ------
        RuntimeError
            This is not the main thread, or the service is running already.

        """
        _require_main_thread()
        import asyncio

        if not self.__lock.acquire(blocking=False):
            raise RuntimeError('the LaunchService is already running and cannot run twice at once')
        try:
            self.__loop = asyncio.get_running_loop()
            self.__task = asyncio.current_task()
            return await self._run_in(self.__loop, shutdown_when_idle)
        finally:
            self.__loop = self.__task = None
            self.__lock.release()

    async def _run_in(
        self,
        loop: asyncio.AbstractEventLoop,
        shutdown_when_idle: bool,
    ) -> int:
        """Set up the resources of a run, and always release them again."""
        from launch._event_processor import EventProcessor, handled_signals
        from launch._supervision.process_registry import ProcessRegistry
        from launch.logging import log_launch_config
        from launch.logging._screen import screen

        self._set_level()
        log_launch_config()
        run = self.__context.run
        run.is_shutdown = False
        self.__interrupted = False
        processor = EventProcessor(self.__context, loop)
        run.processes = registry = ProcessRegistry(loop, forks=self.__prefork)
        run.attach(loop, processor.wake_up)
        screen.when_closed(self._on_screen_closed)
        loop_error_handler = loop.get_exception_handler()
        loop.set_exception_handler(processor.on_loop_error)
        try:
            with handled_signals(loop, self._on_signal):
                status = await processor.run(shutdown_when_idle=shutdown_when_idle)
                await registry.finish()
                await self._let_screen_catch_up()
                return status
        finally:
            loop.set_exception_handler(loop_error_handler)
            screen.when_closed(None)
            run.attach(None)
            registry.close()
            run.processes = None

    def _set_level(self) -> None:
        if self.__debug:
            from launch.logging import launch_config

            launch_config.level = logging.DEBUG

    def _on_signal(self, number: signal.Signals) -> None:
        """Shut the service down; only warn if a signal has already been received."""
        from launch.logging import get_logger

        self.__signals += 1
        interrupted = number == signal.SIGINT
        text = (
            'user interrupted with ctrl-c (SIGINT)'
            if interrupted
            else f'asked to end by a signal ({number.name})'
        )
        if self.__interrupted:
            get_logger('launch').warning('%s again, ignoring...', text)
            return
        self.__interrupted = True
        get_logger('launch').warning('%s', text)
        reason = 'ctrl-c (SIGINT)' if interrupted else number.name
        self.emit_event(Shutdown(reason=reason, due_to_sigint=interrupted))

    async def _let_screen_catch_up(self) -> None:
        """Wait for a slow reader of the output, until another signal arrives."""
        import asyncio

        from launch.logging._screen import screen

        signals = self.__signals
        while not screen.is_up_to_date and self.__signals == signals:
            await asyncio.sleep(0.01)

    def _on_screen_closed(self) -> None:
        """Shut the service down when the reader of its output is gone, as in `| head`."""
        self.emit_event(Shutdown(reason='the standard output was closed'))


class _IncludeHandler(EventHandler):
    """Event handler that visits the queued launch descriptions."""

    def __init__(self) -> None:
        """Create the handler."""
        super().__init__(matcher=lambda event: isinstance(event, IncludeLaunchDescription))

    def handle(self, event: Any, context: LaunchContext) -> LaunchDescription:
        """Return the description, which is visited next."""
        super().handle(event, context)
        description: LaunchDescription = event.launch_description
        return description


def _require_main_thread() -> None:
    if threading.current_thread() is not threading.main_thread():
        raise RuntimeError(
            'LaunchService can only be run in the main thread, where signals arrive'
        )


def cancel_all_tasks(loop: asyncio.AbstractEventLoop) -> None:
    """
    Cancel all tasks of an event loop and wait until they have ended.

    Parameters
    ----------
    loop
        The event loop, which must not be running.

    """
    import asyncio

    tasks = asyncio.all_tasks(loop)
    for task in tasks:
        task.cancel()
    if tasks:
        loop.run_until_complete(asyncio.gather(*tasks, return_exceptions=True))
    loop.run_until_complete(loop.shutdown_asyncgens())
