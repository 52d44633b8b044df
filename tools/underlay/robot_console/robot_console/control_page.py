# SPDX-License-Identifier: Apache-2.0
"""How a control page talks to the console, and loses control when it falls silent."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
import json
import secrets
import threading
import time
from typing import Any

from robot_console.control import People
from robot_console.robot_link import RobotLink
from rviz_common.page.channel import key_of
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

__all__ = ['Connections', 'Session']

SILENCE_S = 0.3
"""Watchdog timeout of a page in control."""
READING_S = 0.05
"""Additional time to read messages that arrived while the event loop was busy."""
PAUSE_S = 0.005
"""Pause after each answer, so that a page that sends a burst does not starve the others."""
ENDING_S = 1.0
REFUSED = 1008


class Session:
    """
    The session of one control page in a browser.

    A page sends requests as `{'do': ...}`, and receives the state in response. The permitted
    requests are the methods in `actions`. Everything runs in the thread of the page server.

    Parameters
    ----------
    link
        The link to the robot of the page.
    person
        The user of the page, as shown to others.

    """

    def __init__(self, link: RobotLink, person: str) -> None:
        self.link = link
        self.person = person
        self._farewells = 0
        self._heard_s = time.monotonic()
        self.silent_s = 0.0
        """The time without a message from the page before its last message."""

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return the actions that the page may request."""
        raise NotImplementedError

    @property
    def is_watched(self) -> bool:
        """Whether the watchdog monitors the page."""
        return self.link.control.holds(self)

    def take(self, message: Any) -> dict[str, Any]:
        """
        Run the action that the page requests, then publish the heartbeat if it is due.

        Parameters
        ----------
        message
            The decoded JSON, such as `{'do': 'beat'}`; the whole mapping is passed to the action.

        Returns
        -------
        dict
            The state that the page shows, serializable as JSON.

        Raises
        ------
        ValueError
            There is no such action, or it rejects the contents of the message.

        """
        do = message.get('do') if isinstance(message, dict) else None
        action = self.actions.get(do) if isinstance(do, str) else None
        if action is None:
            raise ValueError(f'A page cannot request this here: {str(message)[:50]}')
        now_s = time.monotonic()
        self.silent_s, self._heard_s = now_s - self._heard_s, now_s
        action(message)
        self._beat()
        return self.state()

    def state(self) -> dict[str, Any]:
        """Return the state that the page shows."""
        return {'you': self.person, 'control': self._control()}

    def lose(self) -> None:
        """Release control as lost, since the page is gone or its watchdog has expired."""
        self.link.control.lose(self)

    def give(self) -> None:
        """Release control, and inform the robot that this is intentional."""
        if self.link.control.give(self):
            self._farewells = 3

    def _beat(self) -> None:
        """Publish a heartbeat; the release of control is repeated, since messages may be lost."""
        control = self.link.control
        if control.person or control.lost:  # a farewell must not follow a loss of control
            self._farewells = 0
        if control.holds(self):
            self.link.beat(True)
        elif self._farewells:
            self._farewells -= 1
            self.link.beat(False)

    def _control(self) -> dict[str, Any]:
        control = self.link.control
        return {
            'who': control.person,
            'mine': control.person == self.person,
            'here': control.holds(self),
            'lost': control.lost,
        }


class Connections:
    """
    The WebSocket connections of a control page, each with its own session.

    They are served in the thread of the page server.

    Parameters
    ----------
    people
        Assigns each page a user name, which its connections share.
    begin
        Creates the session of a connection, given the user name of its page.

    """

    def __init__(self, people: People, begin: Callable[[str], Session]) -> None:
        self._people = people
        self._begin = begin
        self._talks: dict[asyncio.Task[None], asyncio.AbstractEventLoop] = {}
        self._all_ended = threading.Event()
        self._all_ended.set()
        self._is_over = False

    async def talk(self, connection: ServerConnection) -> None:
        """
        Serve one connection until either side closes it.

        Each JSON message is answered with the state of the session. A watched page that is silent
        for too long loses control; a message that the session rejects closes the connection.

        Parameters
        ----------
        connection
            The connection that a page has just opened.

        """
        if self._is_over:
            return
        task = asyncio.ensure_future(self._serve(connection))
        self._talks[task] = asyncio.get_running_loop()
        self._all_ended.clear()
        try:
            await task
        except (ConnectionClosed, asyncio.CancelledError):
            pass
        finally:
            del self._talks[task]
            if not self._talks:
                self._all_ended.set()

    def end(self) -> None:
        """End all sessions, and wait for their end; called from another thread."""
        self._is_over = True
        for task, loop in list(self._talks.items()):
            if not loop.is_closed():
                loop.call_soon_threadsafe(task.cancel)
        self._all_ended.wait(ENDING_S)

    async def _serve(self, connection: ServerConnection) -> None:
        """Serve a connection with a new session."""
        key = key_of(connection) or secrets.token_hex(8)
        session = self._begin(self._people.arrive(key, str(connection.remote_address[0])))
        try:
            await _exchange(connection, session)
        finally:
            session.lose()
            self._people.leave(key)


async def _exchange(connection: ServerConnection, session: Session) -> None:
    """Answer each message, and end the control of a watched page that is silent."""
    while True:
        try:
            text = await _next(connection, session.is_watched)
        except asyncio.TimeoutError:
            session.lose()
            continue
        answer = _answer(session, text)
        if isinstance(answer, ValueError):
            await connection.close(REFUSED, ascii(str(answer))[:100])
            return
        await connection.send(answer)
        await asyncio.sleep(PAUSE_S)


def _answer(session: Session, text: Any) -> str | ValueError:
    """Return the answer to a message, or the error if it is invalid."""
    try:
        return json.dumps(session.take(json.loads(text)))
    except ValueError as error:
        return error
    except RecursionError:
        return ValueError('This is nested too deeply.')


async def _next(connection: ServerConnection, is_watched: bool) -> str | bytes:
    if not is_watched:
        return await connection.recv()
    try:
        return await asyncio.wait_for(connection.recv(), SILENCE_S)
    except asyncio.TimeoutError:
        return await asyncio.wait_for(connection.recv(), READING_S)
