# SPDX-License-Identifier: Apache-2.0
"""The connection of a small page with its session."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
import json
import secrets
from urllib.parse import parse_qs, urlsplit

from robot_console.people import People
from robot_console.session import Session
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

__all__ = ['SILENCE_S', 'talker']

SILENCE_S = 0.3
"""For how long a page that is in control may be silent."""
READING_S = 0.05
"""How long it may take to read what has come while the thread of the page was busy."""
REFUSED = 1008


def talker(
    people: People, begin: Callable[[str], Session]
) -> Callable[[ServerConnection], Awaitable[None]]:
    """Return what talks to those who connect, each in a session of their own."""

    async def talk(connection: ServerConnection) -> None:
        key = _key(connection.request.path if connection.request else '')
        session = begin(people.arrive(key, str(connection.remote_address[0])))
        try:
            await _talk(connection, session)
        except ConnectionClosed:
            pass
        finally:
            session.lose()
            people.leave(key)

    return talk


async def _talk(connection: ServerConnection, session: Session) -> None:
    """Answer each message, and notice when a page is silent that must not be."""
    while True:
        try:
            text = await _next(connection, session.is_watched)
        except asyncio.TimeoutError:
            session.lose()
            continue
        try:
            answer = session.take(json.loads(text))
        except (ValueError, RecursionError) as error:
            await connection.close(REFUSED, ascii(str(error))[:100])
            return
        await connection.send(json.dumps(answer))


async def _next(connection: ServerConnection, is_watched: bool) -> str | bytes:
    if not is_watched:
        return await connection.recv()
    try:
        return await asyncio.wait_for(connection.recv(), SILENCE_S)
    except asyncio.TimeoutError:
        return await asyncio.wait_for(connection.recv(), READING_S)


def _key(path: str) -> str:
    """Return what a page is known by, which it says in its address."""
    return parse_qs(urlsplit(path).query).get('me', [''])[0][:40] or secrets.token_hex(8)
