# SPDX-License-Identifier: Apache-2.0
"""Watch for the exit of child processes."""

from __future__ import annotations

import asyncio
from functools import partial
import os
import threading

from launch._supervision.program import Child


def watch_exit(
    child: Child,
    loop: asyncio.AbstractEventLoop,
) -> asyncio.Future[int]:
    """
    Watch for the exit of a child process, and reap it.

    Parameters
    ----------
    child
        The process.
    loop
        The event loop of the future.

    Returns
    -------
    Future of int
        The exit status, negative for a signal; canceling it ends the watch.

    """
    future: asyncio.Future[int] = loop.create_future()
    try:
        descriptor = os.pidfd_open(child.pid)
    except (AttributeError, OSError):
        _watch_in_thread(child, loop, future)
    else:
        loop.add_reader(descriptor, _reap, child, loop, future, descriptor)
        future.add_done_callback(partial(_unwatch_if_cancelled, loop, descriptor))
    return future


def _unwatch_if_cancelled(
    loop: asyncio.AbstractEventLoop, descriptor: int, future: asyncio.Future[int]
) -> None:
    if future.cancelled():
        loop.remove_reader(descriptor)
        os.close(descriptor)


def _reap(
    child: Child,
    loop: asyncio.AbstractEventLoop,
    future: asyncio.Future[int],
    descriptor: int,
) -> None:
    loop.remove_reader(descriptor)
    os.close(descriptor)
    _finish(future, child.wait())


def _watch_in_thread(
    child: Child,
    loop: asyncio.AbstractEventLoop,
    future: asyncio.Future[int],
) -> None:
    """Wait for the child in a thread, if no pidfd can be opened."""

    def wait() -> None:
        code = child.wait()
        try:
            loop.call_soon_threadsafe(_finish, future, code)
        except RuntimeError:  # the loop is closed; no one is waiting
            pass

    threading.Thread(target=wait, name=f'wait for {child.pid}', daemon=True).start()


def _finish(future: asyncio.Future[int], code: int) -> None:
    if not future.done():
        future.set_result(code)
