# SPDX-License-Identifier: Apache-2.0
"""Serve a page, and ask for it as browsers and others do."""

from __future__ import annotations

from collections.abc import Iterator
import gzip
from http.client import HTTPConnection, HTTPResponse
import socket

import pytest
from rviz_common.page import Page, PageSettings, PortError, Route
import viser
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed, ConnectionClosedError, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

PROTOCOL = Subprotocol(f'viser-v{viser.__version__}')


@pytest.fixture
def page() -> Iterator[Page]:
    """Serve a page on a port of its own."""
    with Page('test') as page:
        yield page


def ask(page: Page, path: str = '/', **headers: str) -> HTTPResponse:
    """Return the answer to a request."""
    connection = HTTPConnection('127.0.0.1', page.port, timeout=100)
    connection.request('GET', path, headers=headers)
    return connection.getresponse()


def test_page(page: Page) -> None:
    """This machine gets the page, which forbids others to show it inside of theirs."""
    answer = ask(page)
    assert answer.status == 200
    assert b'<html' in answer.read(1000).lower()
    assert answer.getheader('Content-Security-Policy') == "frame-ancestors 'self'"
    assert page.url == f'http://127.0.0.1:{page.port}/'


def test_title() -> None:
    """The tab of the browser has the title of the page, packed or not."""
    with Page('Left & right') as page:
        assert b'<title>Left &amp; right</title>' in ask(page).read()
        answer = ask(page, **{'Accept-Encoding': 'gzip'})
        body = answer.read()
        assert answer.getheader('Content-Encoding') == 'gzip'
        assert b'<title>Left &amp; right</title>' in gzip.decompress(body)
        assert b'<title>Viser' not in gzip.decompress(body)


def test_listens_here_only(page: Page) -> None:
    """No other address of the machine serves the page."""
    other = socket.create_server(('127.0.0.2', page.port))
    other.close()


def test_evil_origin(page: Page) -> None:
    """A site that a browser shows cannot use the page through that browser."""
    url = f'ws://127.0.0.1:{page.port}'
    for origin in ('http://evil.example', 'http://127.0.0.1'):
        with pytest.raises(InvalidStatus) as refused:
            connect(url, origin=Origin(origin), subprotocols=[PROTOCOL])
        assert refused.value.response.status_code == 403
    own = Origin(f'http://127.0.0.1:{page.port}')
    with connect(url, origin=own, subprotocols=[PROTOCOL]) as client:
        assert client.recv(timeout=100)


def test_token() -> None:
    """A page that others can reach needs a token, which moves from the address to a cookie."""
    with Page('test', PageSettings(host='0.0.0.0')) as page:
        token = page.settings.token
        assert len(token) > 20 and page.url.endswith(f':{page.port}/?token={token}')
        assert ask(page).status == 401
        assert ask(page, '/?token=x').status == 403
        answer = ask(page, f'/?token={token}')
        assert (answer.status, answer.getheader('Location')) == (303, '/')
        cookie = answer.getheader('Set-Cookie', '')
        assert 'HttpOnly' in cookie and 'SameSite=Strict' in cookie
        assert ask(page, Cookie=cookie.partition(';')[0]).status == 200
        with pytest.raises(InvalidStatus) as refused:
            connect(f'ws://127.0.0.1:{page.port}', subprotocols=[PROTOCOL])
        assert refused.value.response.status_code == 401


def test_own_token() -> None:
    """A token that is given is the one that counts, also on this machine."""
    with Page('test', PageSettings(token='mine')) as page:
        assert ask(page).status == 401
        assert ask(page, '/?token=mine').status == 303


def test_next_port(page: Page) -> None:
    """A second page takes another port, unless it must have the one that is taken."""
    with Page('test') as other:
        assert other.port != page.port
    with pytest.raises(PortError, match=f'Port {page.port} of 127.0.0.1 cannot be taken: '):
        Page('test', PageSettings(port=page.port))


def test_port_is_free_again() -> None:
    """A page that is closed leaves its port to the next one."""
    with Page('test') as page:
        port = page.port
    with Page('test', PageSettings(port=port)) as page:
        assert ask(page).status == 200


@pytest.mark.parametrize(
    ('arguments', 'sentence'),
    [
        ({'host': 'somewhere'}, "The host is 'somewhere', but must be an address"),
        ({'port': 0}, 'The port is 0, but must be from 1 to 65535'),
        ({'port': 70000}, 'The port is 70000'),
    ],
)
def test_settings(arguments: dict[str, object], sentence: str) -> None:
    """What cannot be an address or a port is refused with a sentence."""
    with pytest.raises(ValueError, match=sentence):
        PageSettings(**arguments)


def test_nothing_is_printed(capfd: pytest.CaptureFixture[str]) -> None:
    """The address, which may have a token, is the caller's to print."""
    with Page('test'):
        pass
    assert capfd.readouterr() == ('', '')


def test_route(page: Page) -> None:
    """A page serves smaller ones inside of it, with connections of their own."""

    async def echo(connection: ServerConnection) -> None:
        await connection.send(await connection.recv())

    page.routes.add('/echo', Route('<p>hello</p>', echo))
    answer = ask(page, '/echo')
    assert (answer.status, answer.read()) == (200, b'<p>hello</p>')
    assert answer.getheader('Content-Type') == 'text/html; charset=utf-8'
    url = f'ws://127.0.0.1:{page.port}/echo'
    with connect(url, origin=Origin(f'http://127.0.0.1:{page.port}')) as client:
        client.send('hello')
        assert client.recv(timeout=100) == 'hello'
    with pytest.raises(InvalidStatus):
        connect(url, origin=Origin('http://evil.example'))
    with pytest.raises(ValueError, match="something at '/echo' already"):
        page.routes.add('/echo', Route(''))
    page.routes.remove('/echo')
    page.routes.add('/echo', Route('anew'))
    assert ask(page, '/echo').read() == b'anew'


def test_failing_route(page: Page) -> None:
    """A connection whose handler fails is closed; the page goes on."""

    async def fail(connection: ServerConnection) -> None:
        raise RuntimeError('on purpose')

    page.routes.add('/fail', Route('', fail))
    with connect(f'ws://127.0.0.1:{page.port}/fail') as client:
        with pytest.raises(ConnectionClosedError):
            client.recv(timeout=100)
    assert ask(page).status == 200


def test_foreign_protocol(page: Page) -> None:
    """A client that does not speak viser's language is sent away; the page goes on."""
    with connect(f'ws://127.0.0.1:{page.port}') as client:
        with pytest.raises(ConnectionClosed):
            client.recv(timeout=100)
    assert ask(page).status == 200


@pytest.mark.parametrize(
    ('headers', 'status'),
    [
        ((), b'200'),
        (('Cookie: a=b', 'Cookie: c=d'), b'200'),
        (('Host: evil.example',), b'403'),
        (('Origin: http://evil.example', 'Origin: http://127.0.0.1:{port}'), b'403'),
    ],
)
def test_headers_that_come_twice(page: Page, headers: tuple[str, ...], status: bytes) -> None:
    """Cookies may come in several headers; a second host or origin makes no friend."""
    lines = ['GET / HTTP/1.1', 'Host: 127.0.0.1:{port}', *headers, '', '']
    with socket.create_connection(('127.0.0.1', page.port), timeout=100) as client:
        client.sendall('\r\n'.join(lines).format(port=page.port).encode())
        assert client.recv(1000).split()[1] == status


def test_strange_token() -> None:
    """An address that is printed can be opened, whatever is in the token; and leads here."""
    with Page('test', PageSettings(token='a&b#c%d é\r\nX: y')) as page:
        printed = page.url.removeprefix(f'http://127.0.0.1:{page.port}')
        answer = ask(page, printed)
        assert (answer.status, answer.getheader('X')) == (303, None)
        cookie = answer.getheader('Set-Cookie', '').partition(';')[0]
        assert ask(page, Cookie=cookie).status == 200
        assert ask(page, f'//evil.example{printed}').getheader('Location') == '/evil.example/'


def test_foreign_address() -> None:
    """An address that is not of this machine is named, and not the port."""
    with pytest.raises(
        PortError, match=r'^192\.0\.2\.9 cannot be used: .* address of this machine'
    ):
        Page('test', PageSettings(host='192.0.2.9'))
