# SPDX-License-Identifier: Apache-2.0
"""Serve a page without viser, and ask for it as browsers and others do."""

from __future__ import annotations

from collections.abc import Iterator
from http.client import HTTPConnection, HTTPResponse
import subprocess
import sys

import pytest
from rviz_common.page import NO_TOKEN, PageSettings, PlainPage, Route
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect


async def echo(connection: ServerConnection) -> None:
    """Send back what comes."""
    async for text in connection:
        await connection.send(text)


ROUTES = {
    '': Route('<p>hello</p>', echo),
    '/page.js': Route('run()', kind='text/javascript; charset=utf-8'),
}


@pytest.fixture
def page() -> Iterator[PlainPage]:
    """Serve a page on a port of its own."""
    with PlainPage('test', ROUTES, PageSettings(token=NO_TOKEN)) as page:
        yield page


def ask(page: PlainPage, path: str = '/', **headers: str) -> HTTPResponse:
    """Return the answer to a request."""
    connection = HTTPConnection('127.0.0.1', page.port, timeout=100)
    connection.request('GET', path, headers=headers)
    return connection.getresponse()


@pytest.mark.parametrize(
    ('path', 'status', 'kind', 'text'),
    [
        ('/', 200, 'text/html; charset=utf-8', '<p>hello</p>'),
        ('/page.js?v=1', 200, 'text/javascript; charset=utf-8', 'run()'),
        ('/other', 404, 'text/plain; charset=utf-8', 'There is nothing at this address.\n'),
    ],
)
def test_routes(page: PlainPage, path: str, status: int, kind: str, text: str) -> None:
    """Each path has its content, and there is nothing else."""
    answer = ask(page, path)
    assert (answer.status, answer.read().decode()) == (status, text)
    assert answer.getheader('Content-Type') == kind


def test_token() -> None:
    """Without the token, neither the page nor its connection is to be had."""
    with PlainPage('test', ROUTES) as page:
        assert ask(page).status == 401
        assert ask(page, '/page.js').status == 401
        assert b'<input name="token"' in ask(page, Accept='text/html').read()
        address = f'ws://127.0.0.1:{page.port}/'
        with pytest.raises(InvalidStatus) as refused:
            connect(address)
        assert refused.value.response.status_code == 401
        with connect(f'{address}?token={page.settings.token}') as client:
            client.send('it works')
            assert client.recv(timeout=100) == 'it works'


def test_close(page: PlainPage) -> None:
    """A page that closes ends its connections, and nobody listens at the port any longer."""
    client = connect(f'ws://127.0.0.1:{page.port}/')
    page.close()
    with pytest.raises(ConnectionClosed):
        client.recv(timeout=100)
    with pytest.raises(ConnectionRefusedError):
        ask(page)


def test_other_paths_have_no_connections(page: PlainPage) -> None:
    """A connection to what is only text ends at once."""
    with connect(f'ws://127.0.0.1:{page.port}/page.js') as client:
        with pytest.raises(ConnectionClosed):
            client.recv(timeout=100)


def test_starts_without_viser() -> None:
    """The import of viser, which takes a second, is left out."""
    script = 'import sys, rviz_common.page.plain_page; sys.exit("viser" in sys.modules)'
    subprocess.run([sys.executable, '-c', script], check=True, timeout=100)
