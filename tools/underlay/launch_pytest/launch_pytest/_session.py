# SPDX-License-Identifier: Apache-2.0
"""Launch sessions, which run alongside tests."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from functools import partial
import threading
from typing import Any, Optional

from launch import LaunchContext, LaunchDescription, LaunchService
from launch.actions import RegisterEventHandler
from launch_testing.actions.ready_to_test import ReadyToTest
from launch_testing.observation import Observation, ready_actions, ReadyHandler
import pytest

_READY_TIMEOUT_S = 15.0

SESSIONS: pytest.StashKey[dict[str, LaunchSession]] = pytest.StashKey()


class LaunchSession:
    """
    Launch that runs in the main thread, whenever a test is running or awaited.

    Parameters
    ----------
    description
        The launch description that `start` launches.
    auto_shutdown
        Whether `shutdown` shuts the launch down; otherwise it ends with its processes.
    ready_timeout_s
        The timeout of `start` for all ReadyToTest actions, in s.

    Attributes
    ----------
    service
        The launch service.
    suspended
        The generators of tests that have reached their `yield`, by node id.

    """

    def __init__(
        self,
        description: LaunchDescription,
        *,
        auto_shutdown: bool,
        ready_timeout_s: float = _READY_TIMEOUT_S,
    ) -> None:
        self.service = LaunchService(noninteractive=True)
        self._description = description
        self._auto_shutdown = auto_shutdown
        self._ready_timeout_s = ready_timeout_s
        self._observation = Observation()
        self._loop = asyncio.new_event_loop()
        self._task: Optional[asyncio.Task[int]] = None
        self.suspended: dict[str, Any] = {}

    @property
    def context(self) -> LaunchContext:
        """Return the context of the launch."""
        return self.service.context

    @property
    def is_running(self) -> bool:
        """Whether the launch is running."""
        return self._task is not None and not self._task.done()

    def report(self) -> str:
        """Format the states of the processes and their last output, for error messages."""
        return self._observation.report().strip()

    # Start and shutdown.

    def start(self) -> None:
        """Start the launch and wait until it is ready."""
        ready = self._loop.create_future()
        handler = ReadyHandler(self._description, partial(_set_done, ready))
        last = [] if any(ready_actions([self._description])) else [ReadyToTest()]
        self.service.include_launch_description(
            LaunchDescription(
                [
                    *self._observation.actions(),
                    RegisterEventHandler(handler),
                    self._description,
                    *last,
                ]
            )
        )
        self._task = self._loop.create_task(
            self.service.run_async(shutdown_when_idle=not self._auto_shutdown)
        )
        self._loop.run_until_complete(
            asyncio.wait(
                {self._task, ready},
                timeout=self._ready_timeout_s,
                return_when=asyncio.FIRST_COMPLETED,
            )
        )
        if not ready.done() and self.is_running:
            pytest.fail(f'The launch was not ready after {self._ready_timeout_s:g} s', False)
        self._require_success(was_ready=ready.done())

    def shutdown(self) -> None:
        """Shut the launch down, or wait for its end without auto_shutdown."""
        if self._auto_shutdown and self.is_running:
            self.service.shutdown()
        if self._task is not None:
            self._loop.run_until_complete(asyncio.wait({self._task}))
        self._require_success(was_ready=True)

    def close(self) -> None:
        """Shut the launch down in any state and release its event loop."""
        try:
            self._auto_shutdown = True
            self.shutdown()
        finally:
            self._cancel_all()
            self._loop.close()

    def _cancel_all(self) -> None:
        tasks = asyncio.all_tasks(self._loop)
        for task in tasks:
            task.cancel()
        if tasks:
            self._loop.run_until_complete(asyncio.wait(tasks))
        self._loop.run_until_complete(self._loop.shutdown_asyncgens())

    def _require_success(self, *, was_ready: bool) -> None:
        """Fail the test if the launch has failed or has ended early."""
        task = self._task
        if task is None or not task.done():
            return
        if self._observation.was_interrupted:
            raise KeyboardInterrupt
        status = task.result()
        if status != 0 or not was_ready:
            self._task = None
            text = self._observation.explain_end(status, was_ready=was_ready)
            pytest.fail(f'{text}\n{self.report()}', pytrace=False)

    # Tests.

    def call(self, function: Callable[[], Any]) -> Any:
        """
        Call a function in another thread while the launch is running; return its result.

        Parameters
        ----------
        function
            Called without arguments; in the calling thread if the launch has ended.

        """
        if not self.is_running:
            return function()
        return self.wait_for(lambda: _in_thread(function, self._loop))

    def wait_for(self, function: Callable[[], Awaitable[Any]]) -> Any:
        """
        Await an object in the event loop of the launch; return its result.

        The test fails if the launch fails in the meantime.

        Parameters
        ----------
        function
            Called in the event loop; returns a coroutine or a future.

        """
        return self._loop.run_until_complete(self._beside_launch(function))

    async def _beside_launch(self, function: Callable[[], Awaitable[Any]]) -> Any:
        test = asyncio.ensure_future(function())
        if self._task is not None and not self._task.done():
            await asyncio.wait({test, self._task}, return_when=asyncio.FIRST_COMPLETED)
        if not test.done():
            self._require_success(was_ready=True)
        return await test


def _set_done(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)


def _in_thread(
    function: Callable[[], Any],
    loop: asyncio.AbstractEventLoop,
) -> asyncio.Future[Any]:
    """Call a function in a new thread; return a future of its result."""
    future = loop.create_future()

    def finish(result: Any, error: Optional[BaseException]) -> None:
        if future.done():
            return
        if error is None:
            future.set_result(result)
        else:
            future.set_exception(error)

    def work() -> None:
        result: Any = None
        problem: Optional[BaseException] = None
        try:
            result = function()
        except BaseException as error:
            problem = error
        try:
            loop.call_soon_threadsafe(finish, result, problem)
        except RuntimeError:  # the launch was closed in the meantime
            pass

    threading.Thread(target=work, name='launch test', daemon=True).start()
    return future
