# SPDX-License-Identifier: Apache-2.0
"""Messages to and requests from the page of a live panel."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
import json
from typing import Any

from robot_console.live.viewer import Viewer
from rviz_common.work_queue import WorkQueue
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

__all__ = ['Action', 'Channel']

Action = Callable[[Viewer, Mapping[str, Any]], None]
LONGEST = 1_000_000
REFUSED = 1008


class Channel:
    """
    The connections of a live panel: sends updates, and runs the actions that pages request.

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
                    await connection.close(REFUSED, 'This cannot be asked for here.')
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
