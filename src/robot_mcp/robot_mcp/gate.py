# SPDX-License-Identifier: Apache-2.0
"""
Access control for HTTP: requests need the bearer token, and cross-site requests are rejected.

The server listens on the loopback interface only. That does not keep out web pages in a browser on
this machine: they are rejected by the Origin header, and those whose name resolves to 127.0.0.1
(DNS rebinding) by the Host header. The token keeps out other users of this machine.
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
"""The key in an ASGI scope of the event that is set when the client has disconnected."""
LONGEST_BODY = 64 * 1024
_READ_OF_REFUSED = 1024 * 1024
"""How much of the body of a rejected request is read, and discarded, before the response."""
_PATIENCE_S = 2.0
"""How long that may take."""
_ONCE = (b'host', b'origin', b'authorization', b'content-length', b'sec-fetch-site')
Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]


def refusal(headers: Iterable[tuple[bytes, bytes]], token: str, port: int) -> tuple[int, str]:
    """
    Check a request; return the HTTP status and message of its rejection, 0 and '' to accept it.

    Parameters
    ----------
    headers
        Names, in lower case, and values, as in ASGI.
    token
        The required token.
    port
        The port on which the server listens.

    """
    given: dict[bytes, bytes] = {}
    for name, value in headers:
        if name in given and name in _ONCE:
            return 400, f'The header {name.decode("latin-1")} appears more than once.'
        given[name] = value
    hosts = [f'{name}:{port}'.encode() for name in ('127.0.0.1', 'localhost', '[::1]')]
    if given.get(b'host', b'').lower() not in hosts:
        return 421, f'This server only answers requests to 127.0.0.1:{port}.'
    origin = given.get(b'origin')
    if origin is not None and origin.lower() not in [b'http://' + each for each in hosts]:
        return 403, 'Pages from other sites may not access this server.'
    if given.get(b'sec-fetch-site', b'none') not in (b'none', b'same-origin'):
        return 403, 'Pages from other sites may not access this server.'
    kind, _, brought = given.get(b'authorization', b'').partition(b' ')
    if kind.lower() != b'bearer' or not hmac.compare_digest(brought.strip(), token.encode()):
        return 401, (
            'The token is missing or wrong: send the header "Authorization: Bearer ..." with '
            'the one that the server printed when it started.'
        )
    length = given.get(b'content-length', b'0')
    if not length.isdigit() or int(length[:12]) > LONGEST_BODY:
        return 413, f'A request may have at most {LONGEST_BODY} bytes.'
    return 0, ''


class Gate:
    """
    ASGI middleware that rejects unauthorized requests.

    Parameters
    ----------
    app
        The protected application; the scope that it gets has an event under `GONE`.
    token, port
        As for `refusal`.

    """

    def __init__(self, app: Any, token: str, port: int) -> None:
        self._app, self._token, self._port = app, token, port

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Forward a request to the application, or reject it."""
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
    Reject a request with a message.

    Closing a connection with unread data resets it, and a client that is still sending may never
    see the response.
    """
    with suppress(asyncio.TimeoutError):
        await in_time(_throw_away(receive), _PATIENCE_S)
    headers = [(b'content-type', b'application/json'), (b'connection', b'close')]
    if status == 401:
        headers.append((b'www-authenticate', b'Bearer'))
    await send({'type': 'http.response.start', 'status': status, 'headers': headers})
    await send({'type': 'http.response.body', 'body': json.dumps({'error': reason}).encode()})


async def _throw_away(receive: Receive) -> None:
    """Read and discard the body of a request, up to a limit."""
    size = 0
    while size < _READ_OF_REFUSED:
        message = await receive()
        size += len(message.get('body', b''))
        if not message.get('more_body', False):
            return
