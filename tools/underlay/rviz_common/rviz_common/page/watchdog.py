# SPDX-License-Identifier: Apache-2.0
"""Notice that a browser no longer answers, although its connection is still open."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from websockets.asyncio.connection import Connection
from websockets.exceptions import ConnectionClosed

__all__ = ['serving', 'wait_until_lost']

PERIOD_S = 0.25
PATIENCE_S = 1.0

_SERVED: ContextVar[Connection | None] = ContextVar('connection', default=None)


@contextmanager
def serving(connection: Connection) -> Iterator[None]:
    """
    Mark the tasks that are started in a `with` block as those of a connection.

    Parameters
    ----------
    connection
        The connection to a browser.

    """
    token = _SERVED.set(connection)
    try:
        yield
    finally:
        _SERVED.reset(token)


async def wait_until_lost(patience_s: float = PATIENCE_S) -> None:
    """
    Wait until the browser whose message is being handled no longer answers.

    A browser answers pings by itself, whatever its page does. Outside of `serving`, wait forever.

    Parameters
    ----------
    patience_s
        How long to wait for each answer.

    """
    connection = _SERVED.get()
    if connection is None:
        await asyncio.Event().wait()
        return
    try:
        while True:
            await asyncio.wait_for(await connection.ping(), patience_s)
            await asyncio.sleep(PERIOD_S)
    except (ConnectionClosed, asyncio.TimeoutError):
        return
