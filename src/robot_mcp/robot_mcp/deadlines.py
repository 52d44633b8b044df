# SPDX-License-Identifier: Apache-2.0
"""Timeouts in the event loop of the server."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable
from typing import TypeVar

__all__ = ['in_time']

Value = TypeVar('Value')


async def in_time(awaitable: Awaitable[Value], timeout_s: float) -> Value:
    """
    Await something with a timeout, and cancel it when the timeout expires.

    `asyncio.wait_for` before Python 3.12 loses a cancellation that arrives just when the awaitable
    is done: a robot would continue with what its client has canceled.

    Parameters
    ----------
    awaitable, timeout_s
        What to await, and the timeout in s.

    Raises
    ------
    asyncio.TimeoutError
        The timeout expired.

    """
    task = asyncio.ensure_future(awaitable)
    try:
        await asyncio.wait((task,), timeout=timeout_s)
    except asyncio.CancelledError:
        task.cancel()
        raise
    if not task.done():
        task.cancel()
        raise asyncio.TimeoutError
    return task.result()
