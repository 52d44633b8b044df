# SPDX-License-Identifier: Apache-2.0
"""A viewer of the page of a panel."""

from __future__ import annotations

import asyncio
from collections import deque
import json
from typing import Any

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

__all__ = ['Viewer']

MOST_WAITING = 4_000_000
"""Maximum number of queued characters for a slow browser; beyond it, the connection is dropped."""


class Viewer:
    """
    A browser connection to the page of a panel.

    `tell` and `tell_text` are called from the thread of the node, `close` from any thread, and
    everything else from the thread of the page server. If a browser does not read in time, the
    connection is dropped with the queue; the full state is sent again when it reconnects.

    Parameters
    ----------
    connection
        The connection of the page; the viewer is constructed in the event loop that serves it.

    """

    def __init__(self, connection: ServerConnection) -> None:
        self.wish: Any = None
        """State that a panel stores for this viewer, such as a topic or the name of a node."""
        self._connection = connection
        self._loop = asyncio.get_running_loop()
        self._waiting: deque[str] = deque()
        self._size = 0
        self._news = asyncio.Event()

    def tell(self, **values: Any) -> None:
        """
        Queue values to be sent as one JSON object.

        Parameters
        ----------
        **values
            The members of the object.

        """
        self.tell_text(json.dumps(values))

    def tell_text(self, text: str) -> None:
        """
        Queue a text to be sent.

        Parameters
        ----------
        text
            A JSON object, already encoded.

        """
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._put, text)

    async def send_all(self) -> None:
        """Send queued messages until the connection is closed."""
        try:
            while self._size <= MOST_WAITING:
                await self._news.wait()
                self._news.clear()
                while self._waiting:
                    text = self._waiting.popleft()
                    await self._connection.send(text)
                    self._size -= len(text)
        except ConnectionClosed:
            pass

    def close(self) -> None:
        """Abort the connection; may be called from any thread."""
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._abort)

    def _put(self, text: str) -> None:
        self._size += len(text)
        if self._size > MOST_WAITING:
            self._waiting.clear()
            self._abort()
            return
        self._waiting.append(text)
        self._news.set()

    def _abort(self) -> None:
        transport = self._connection.transport
        if transport is not None:
            transport.abort()
