# SPDX-License-Identifier: Apache-2.0
"""How a page gets updates, and how its requests are run in the thread of the node."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Mapping
import json
from typing import Any
from urllib.parse import parse_qs, urlsplit

from rviz_common.inputs import WorkQueue
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

__all__ = ['Action', 'Channel', 'Viewer', 'key_of']

MOST_WAITING = 4_000_000
"""Maximum number of queued characters for a slow browser; beyond it, the connection is dropped."""

LONGEST = 1_000_000
LONGEST_KEY = 40
REFUSED = 1008


class Viewer:
    """
    The connection of a browser to a page.

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
        """State that the program stores for this viewer, such as a topic or the name of a node."""
        self.key = key_of(connection)
        """What identifies the page of the viewer; '' if it does not say so."""
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


def key_of(connection: ServerConnection) -> str:
    """
    Return the identifier that a page sends in its URL as `me`, for all of its connections.

    Parameters
    ----------
    connection
        The connection that the page has opened.

    Returns
    -------
    str
        At most 40 characters; '' if there is none.

    """
    path = connection.request.path if connection.request else ''
    return parse_qs(urlsplit(path).query).get('me', [''])[0][:LONGEST_KEY]


Action = Callable[[Viewer, Mapping[str, Any]], None]


class Channel:
    """
    The connections of a page: sends updates, and runs the actions that browsers request.

    A page is connected while it is visible. Its requests, `{'do': ...}`, are handled in the thread
    of the node by the action of that name; if the action raises ValueError, the message is sent
    back.

    Parameters
    ----------
    queue
        Transfers work to the thread of the node.
    greet
        Sends the current state to a new viewer.
    actions
        The actions that pages may request, by name: called with the viewer and the whole message.

    Attributes
    ----------
    viewers
        The connected viewers; for use in the thread of the node only.

    """

    def __init__(
        self,
        queue: WorkQueue,
        greet: Callable[[Viewer], None],
        actions: Mapping[str, Action],
    ) -> None:
        self.viewers: list[Viewer] = []
        self._queue = queue
        self._greet = greet
        self._actions = actions
        self._is_over = False

    def tell(self, **values: Any) -> None:
        """
        Send values to all viewers, as one JSON object.

        Parameters
        ----------
        **values
            The members of the object.

        """
        if self.viewers:
            text = json.dumps(values)
            for viewer in self.viewers:
                viewer.tell_text(text)

    def end(self) -> None:
        """Close all connections."""
        self._is_over = True
        for viewer in self.viewers:
            viewer.close()
        self.viewers.clear()

    async def talk(self, connection: ServerConnection) -> None:
        """
        Serve one connection until it is closed, in the thread of the page server.

        A message that is too long, is not JSON, or names no action closes the connection.

        Parameters
        ----------
        connection
            The connection that a browser has opened.

        """
        if self._is_over:
            return
        viewer = Viewer(connection)
        sending = asyncio.ensure_future(viewer.send_all())
        self._queue.post(lambda: self._join(viewer))
        try:
            async for text in connection:
                message = _parsed(text, self._actions)
                if message is None:
                    await connection.close(REFUSED, 'This request is not supported here.')
                    break
                self._post(viewer, message)
        except ConnectionClosed:
            pass
        finally:
            sending.cancel()
            self._queue.post(lambda: self._leave(viewer))

    def _post(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        self._queue.post(lambda: self._do(viewer, message))

    def _join(self, viewer: Viewer) -> None:
        if self._is_over:
            viewer.close()
            return
        self.viewers.append(viewer)
        self._greet(viewer)

    def _leave(self, viewer: Viewer) -> None:
        if viewer in self.viewers:
            self.viewers.remove(viewer)

    def _do(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        if viewer not in self.viewers:
            return
        try:
            self._actions[message['do']](viewer, message)
        except ValueError as error:
            viewer.tell(refusal=str(error), of=message['do'])


def _parsed(text: str | bytes, actions: Mapping[str, Action]) -> Mapping[str, Any] | None:
    """Parse and validate a request; None if it is invalid."""
    if len(text) > LONGEST:
        return None
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return None
    do = message.get('do') if isinstance(message, dict) else None
    return message if isinstance(do, str) and do in actions else None
