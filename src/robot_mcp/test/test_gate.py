# SPDX-License-Identifier: Apache-2.0
"""Who may speak to the server over HTTP."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest
from robot_mcp.gate import Gate, GONE, refusal

TOKEN, PORT = 'a-very-good-token', 8765
GOOD = {'host': '127.0.0.1:8765', 'authorization': f'Bearer {TOKEN}'}


def status(*more: tuple[str, str], **changes: str | None) -> int:
    """Return what becomes of a good request with other headers; 0 if it is let through."""
    told = {name: value for name, value in {**GOOD, **changes}.items() if value is not None}
    headers = [(name.encode(), value.encode()) for name, value in (*told.items(), *more)]
    return refusal(headers, TOKEN, PORT)[0]


def test_the_token_opens() -> None:
    """From this machine, under its names, and from its own pages."""
    assert status() == 0
    assert status(authorization=f'bearer  {TOKEN} ') == 0
    for host in ('localhost:8765', '[::1]:8765', 'LOCALHOST:8765'):
        assert status(host=host, origin='http://127.0.0.1:8765') == 0


@pytest.mark.parametrize(
    'token',
    [None, '', 'Bearer', 'Bearer ', 'Bearer wrong', TOKEN, f'Basic {TOKEN}', f'Bearer {TOKEN}x',
     f'Bearer {TOKEN[:-1]}', f'Bearer {TOKEN.upper()}', 'Bearer \u00e9'],
)  # fmt: skip
def test_without_the_token_it_is_closed(token: str | None) -> None:
    """Whatever comes instead."""
    assert status(authorization=token) == 401


@pytest.mark.parametrize(
    'host',
    [None, '', 'evil.example', 'evil.example:8765', '127.0.0.1', '127.0.0.1:80',
     '127.0.0.1:8765.evil.example', '127.0.0.1.evil.example:8765', 'localhost:8765@evil'],
)  # fmt: skip
def test_names_that_lead_here_are_refused(host: str | None) -> None:
    """A page whose name was made to lead to 127.0.0.1 says its own name, token or not."""
    assert status(host=host) == 421


@pytest.mark.parametrize(
    'origin',
    ['null', '', 'https://evil.example', 'http://evil.example:8765', 'http://127.0.0.1:80',
     'https://127.0.0.1:8765', 'http://127.0.0.1:8765.evil.example', 'file://'],
)  # fmt: skip
def test_pages_of_others_are_refused(origin: str) -> None:
    """Even with the token."""
    assert status(origin=origin) == 403


def test_odd_headers_are_refused() -> None:
    """Those that come twice, foreign pages by another header, and what is too large."""
    assert status(('authorization', 'Bearer x')) == 400
    assert status(('host', 'evil.example')) == 400
    assert status(**{'sec-fetch-site': 'cross-site'}) == 403
    for length in ('65537', '9' * 500, '-1', 'x', '\u00b2'):
        assert status(**{'content-length': length}) == 413


def call(scope: dict[str, Any], messages: list[Any] | None = None) -> tuple[list[Any], list[Any]]:
    """Send a request through a gate; return what is answered, and the scopes that came through."""
    sent: list[Any] = []
    through: list[Any] = []

    async def app(scope: Any, receive: Any, send: Any) -> None:
        through.append(scope)
        while messages:
            await receive()

    async def receive() -> Any:
        assert messages
        return messages.pop(0)

    async def send(message: Any) -> None:
        sent.append(message)

    asyncio.run(Gate(app, TOKEN, PORT)(scope, receive, send))
    return sent, through


def test_a_refusal_reaches_nobody() -> None:
    """It is answered with a sentence; what is no HTTP is closed."""
    pieces = [
        {'type': 'http.request', 'body': b'{"id":', 'more_body': True},
        {'type': 'http.request', 'body': b' 1}', 'more_body': False},
    ]
    sent, through = call({'type': 'http', 'headers': [(b'host', b'127.0.0.1:8765')]}, pieces)
    assert not pieces  # a connection that is closed with something unread is reset
    assert sent[0]['status'] == 401 and b'token is missing' in sent[1]['body'] and not through
    assert (b'www-authenticate', b'Bearer') in sent[0]['headers']
    sent, through = call({'type': 'websocket', 'headers': []})
    assert sent[0]['type'] == 'websocket.close' and not through


def test_what_is_refused_is_not_read_for_ever() -> None:
    """A body without end is answered after its first megabyte."""
    pieces = [{'type': 'http.request', 'body': b' ' * 10_000, 'more_body': True}] * 1000
    sent, through = call({'type': 'http', 'headers': []}, pieces)
    assert sent[0]['status'] == 421 and not through
    assert 800 < len(pieces) < 1000


def test_a_client_that_goes_is_noticed() -> None:
    """By an event in the scope."""
    headers = [(name.encode(), value.encode()) for name, value in GOOD.items()]
    for kind, is_gone in (('http.request', False), ('http.disconnect', True)):
        _, (scope,) = call({'type': 'http', 'headers': headers}, [{'type': kind}])
        assert scope[GONE].is_set() == is_gone
