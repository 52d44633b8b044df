# SPDX-License-Identifier: Apache-2.0
"""
Who may speak to the server over HTTP: whoever brings its token, and no page of another site.

The server listens on this machine only. Against web pages, which the browser of this machine may
show, that does not help: they are kept out by the header Origin, and those whose name leads to
127.0.0.1 by the header Host (DNS rebinding). Against others on this machine there is the token.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from contextlib import suppress
import hmac
import json
from typing import Any

from robot_mcp.deadlines import in_time

__all__ = ['GONE', 'LONGEST_BODY', 'Gate', 'refusal']

GONE = 'robot_mcp.gone'
"""The key in an ASGI scope of what is set when the client of a request has gone."""
LONGEST_BODY = 64 * 1024
_READ_OF_REFUSED = 1024 * 1024
"""Of the body of what is refused so much is read, and thrown away, before it is answered."""
_PATIENCE_S = 2.0
"""How long that may take."""
_ONCE = (b'host', b'origin', b'authorization', b'content-length', b'sec-fetch-site')
Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]


def refusal(headers: Iterable[tuple[bytes, bytes]], token: str, port: int) -> tuple[int, str]:
    """
    Return why a request is refused: its status in HTTP and a sentence; 0 and nothing if it is not.

    Parameters
    ----------
    headers
        Names, in small letters, and values, as ASGI has them.
    token
        What a request has to bring.
    port
        Where the server listens.

    """
    given: dict[bytes, bytes] = {}
    for name, value in headers:
        if name in given and name in _ONCE:
            return 400, f'The header {name.decode("latin-1")} is there twice.'
        given[name] = value
    hosts = [f'{name}:{port}'.encode() for name in ('127.0.0.1', 'localhost', '[::1]')]
    if given.get(b'host', b'').lower() not in hosts:
        return 421, f'This server is only known as 127.0.0.1:{port}.'
    origin = given.get(b'origin')
    if origin is not None and origin.lower() not in [b'http://' + each for each in hosts]:
        return 403, 'Pages of other sites may not speak to this server.'
    if given.get(b'sec-fetch-site', b'none') not in (b'none', b'same-origin'):
        return 403, 'Pages of other sites may not speak to this server.'
    kind, _, brought = given.get(b'authorization', b'').partition(b' ')
    if kind.lower() != b'bearer' or not hmac.compare_digest(brought.strip(), token.encode()):
        return 401, (
            'The token is missing or wrong: send the header "Authorization: Bearer ..." with '
            'that which the server printed when it started.'
        )
    length = given.get(b'content-length', b'0')
    if not length.isdigit() or int(length[:12]) > LONGEST_BODY:
        return 413, f'A request may have at most {LONGEST_BODY} bytes.'
    return 0, ''


class Gate:
    """
    An ASGI application in front of another one.

    Parameters
    ----------
    app
        What is behind the gate; the scope that it gets has an event under `GONE`.
    token, port
        As for `refusal`.

    """

    def __init__(self, app: Any, token: str, port: int) -> None:
        self._app, self._token, self._port = app, token, port

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request through, or answer it."""
        if scope['type'] == 'lifespan':
            await self._app(scope, receive, send)
            return
        if scope['type'] != 'http':
            await send({'type': 'websocket.close', 'code': 1008})
            return
        status, reason = refusal(scope['headers'], self._token, self._port)
        if status:
            await _refuse(receive, send, status, reason)
            return
        gone = scope[GONE] = asyncio.Event()

        async def watched() -> MutableMapping[str, Any]:
            message = await receive()
            if message['type'] == 'http.disconnect':
                gone.set()
            return message

        await self._app(scope, watched, send)


async def _refuse(receive: Receive, send: Send, status: int, reason: str) -> None:
    """
    Answer with a sentence.

    To close a connection with something unread in it resets it, and the client, which is still
    sending, may never see the answer.
    """
    with suppress(asyncio.TimeoutError):
        await in_time(_throw_away(receive), _PATIENCE_S)
    headers = [(b'content-type', b'application/json'), (b'connection', b'close')]
    if status == 401:
        headers.append((b'www-authenticate', b'Bearer'))
    await send({'type': 'http.response.start', 'status': status, 'headers': headers})
    await send({'type': 'http.response.body', 'body': json.dumps({'error': reason}).encode()})


async def _throw_away(receive: Receive) -> None:
    """Read the body of a request to its end, or as much of it as is reasonable."""
    size = 0
    while size < _READ_OF_REFUSED:
        message = await receive()
        size += len(message.get('body', b''))
        if not message.get('more_body', False):
            return
