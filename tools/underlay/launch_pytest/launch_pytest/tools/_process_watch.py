# SPDX-License-Identifier: Apache-2.0
"""Wait until a predicate about a process holds."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING

from launch.event_handler import BaseEventHandler
from launch.events.process import ProcessExited, RunningProcessEvent

if TYPE_CHECKING:
    from launch import LaunchContext
    from launch.actions import ExecuteProcess


class _Watch(BaseEventHandler):
    """Event handler that wakes up waiters on each event of a process."""

    def __init__(self, action: ExecuteProcess) -> None:
        """Create the handler."""
        super().__init__(
            matcher=lambda event: isinstance(event, RunningProcessEvent) and event.action is action
        )
        self.something_happened = asyncio.Event()
        self.has_ended = False

    def handle(self, event: Any, context: LaunchContext) -> None:
        """Wake up the waiters."""
        super().handle(event, context)
        self.has_ended = isinstance(event, ProcessExited)
        self.something_happened.set()


async def until(
    context: LaunchContext,
    action: ExecuteProcess,
    predicate: Callable[[], bool],
    timeout: Optional[float],
) -> bool:
    """
    Wait until a predicate about a process holds, and return whether it does.

    Parameters
    ----------
    context
        The context of the launch; there is no wait after its end.
    action
        The action of the process.
    predicate
        Called without arguments after each event of the process.
    timeout
        The timeout in s; None waits until the process ends.

    """
    if predicate() or context.asyncio_loop is None:
        return predicate()
    watch = _Watch(action)
    watch.has_ended = action.return_code is not None
    context.register_event_handler(watch)
    try:
        await asyncio.wait_for(_watch(watch, predicate, until_end=timeout is None), timeout)
    except asyncio.TimeoutError:
        pass
    finally:
        context.unregister_event_handler(watch)
    return predicate()


async def _watch(watch: _Watch, predicate: Callable[[], bool], *, until_end: bool) -> None:
    while not (predicate() or (until_end and watch.has_ended)):
        watch.something_happened.clear()
        await watch.something_happened.wait()
