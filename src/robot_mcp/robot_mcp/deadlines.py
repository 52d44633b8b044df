# SPDX-License-Identifier: Apache-2.0
"""How long something may take in the loop of the server."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable
from typing import TypeVar

__all__ = ['in_time']

Value = TypeVar('Value')


async def in_time(awaitable: Awaitable[Value], timeout_s: float) -> Value:
    """
    Return what comes of something, and cancel it if it takes too long.

    `asyncio.wait_for` of Python before 3.12 loses a cancellation that comes when the other thing
    is just done: a robot would go on with what its client has canceled.

    Parameters
    ----------
    awaitable, timeout_s
        What to wait for, and how long in s.

    Raises
    ------
    asyncio.TimeoutError
        It takes too long.

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
