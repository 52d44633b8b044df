# SPDX-License-Identifier: Apache-2.0
"""Serve a page, and ask for it as browsers and others do."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Iterator
import gzip
from http.client import HTTPConnection, HTTPResponse
import socket
import threading
from typing import Any
import warnings

import pytest
from ros2cli.graph.reach import Interface
from rviz_common.page import address, NO_TOKEN, Page, PageSettings, PortError, Route
import viser
from viser._messages import SetOrientationMessage
from viser.infra._async_message_buffer import AsyncMessageBuffer
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed, ConnectionClosedError, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

PROTOCOL = Subprotocol(f'viser-v{viser.__version__}')


@pytest.fixture
def page() -> Iterator[Page]:
    """Serve a page on a port of its own."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
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
    with Page('Left & right', PageSettings(token=NO_TOKEN)) as page:
        assert b'<title>Left &amp; right</title>' in ask(page).read()
        answer = ask(page, **{'Accept-Encoding': 'gzip'})
        body = answer.read()
        assert answer.getheader('Content-Encoding') == 'gzip'
        assert b'<title>Left &amp; right</title>' in gzip.decompress(body)
        assert b'<title>Viser' not in gzip.decompress(body)


def test_name_and_icon() -> None:
    """Browsers can show another name and an icon; who lacks the token sees the title."""
    with Page('RViz', PageSettings()) as page:
        page.present('Left & right', '<svg>"#"</svg>')
        cookie = ask(page, f'/?token={page.settings.token}').getheader('Set-Cookie', '')
        text = ask(page, Cookie=cookie.partition(';')[0]).read()
        assert b'<title>Left &amp; right</title>' in text
        assert text.count(b'rel="icon"') == 1
        assert b'href="data:image/svg+xml,%3Csvg%3E%22%23%22%3C/svg%3E"' in text
        assert 'RViz is at http' in ask(page, Accept='text/html').read().decode()
        page.present('RViz')
        text = ask(page, Cookie=cookie.partition(';')[0]).read()
        assert b'<title>RViz</title>' in text and b'%3Csvg%3E%22' not in text
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        page.present('closed')


def test_small_screens(page: Page) -> None:
    """The page names the one for small screens, whose path cannot end the script."""
    assert b'path = "";' in ask(page).read()
    page.lead_small_screens('/</script>')
    assert b'path = "/\\u003c/script>";' in ask(page).read()


def test_listens_here_only(page: Page) -> None:
    """No other address of the machine serves the page."""
    other = socket.create_server(('127.0.0.2', page.port))
    other.close()


def test_port_is_taken_at_once() -> None:
    """Of two programs that start at the same time, one gets the port and the other a sentence."""
    with address.listen(PageSettings()) as first:
        with pytest.raises(PortError, match='cannot be taken: Address already in use'):
            address.listen(PageSettings(port=first.getsockname()[1]))


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


@pytest.mark.parametrize('host', ['127.0.0.1', '0.0.0.0'])
def test_token(host: str) -> None:
    """A page needs a token, which moves from the address to a cookie, also on this machine."""
    with Page('test', PageSettings(host=host)) as page:
        token = page.settings.token
        assert len(token) > 20 and page.url.endswith(f':{page.port}/?token={token}')
        assert ask(page).status == 401
        assert ask(page, '/?token=x').status == 403
        answer = ask(page, f'/?a=1&token={token}&b=2')
        assert (answer.status, answer.getheader('Location')) == (303, '/?a=1&b=2')
        cookie = answer.getheader('Set-Cookie', '')
        assert 'HttpOnly' in cookie and 'SameSite=Strict' in cookie
        assert ask(page, Cookie=cookie.partition(';')[0]).status == 200
        address = f'ws://127.0.0.1:{page.port}/'
        for query, status in (('', 401), ('?token=x', 403)):
            with pytest.raises(InvalidStatus) as refused:
                connect(f'{address}{query}', subprotocols=[PROTOCOL])
            assert refused.value.response.status_code == status
        with connect(f'{address}?token={token}', subprotocols=[PROTOCOL]) as client:
            assert client.recv(timeout=30)


def test_each_start_has_a_token_of_its_own() -> None:
    """What somebody knew of a page does not open the next one."""
    with Page('test', PageSettings()) as first, Page('test', PageSettings()) as second:
        assert first.settings.token != second.settings.token


@pytest.mark.parametrize(('path', 'status'), [('/', 401), ('/?token=x', 403), ('/drive', 401)])
def test_sign_in(path: str, status: int) -> None:
    """People who come without the token are told where it is, and can put it in."""
    with Page('Left & right', PageSettings()) as page:
        answer = ask(page, path, Accept='text/html,*/*;q=0.8')
        text = answer.read().decode()
        assert answer.status == status
        assert '<input name="token"' in text
        assert f'Left &amp; right is at http://127.0.0.1:{page.port}/?token=' in text
        assert page.settings.token not in text
        assert ask(page, path).getheader('Content-Type') == 'text/plain; charset=utf-8'
        evil = ask(page, path, Accept='text/html', Host='<script>alert(1)</script>')
        assert b'<script>alert' not in evil.read()


def test_no_token_when_asked_for() -> None:
    """`none` admits whoever is on this machine, and nobody else."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        assert page.url == f'http://127.0.0.1:{page.port}/'
        assert ask(page).status == 200
        assert ask(page, Host='evil.example').status == 403
    with pytest.raises(ValueError, match='anyone there could drive the robot'):
        PageSettings(host='0.0.0.0', token=NO_TOKEN)


def test_reachable_addresses(monkeypatch: pytest.MonkeyPatch) -> None:
    """All addresses are named that lead here, also where nothing leads to other networks."""
    interfaces = [
        Interface('lo', '127.0.0.1', True, True, False),
        Interface('eth0', '10.1.0.2', True, False, True),
        Interface('wlan0', '192.168.3.4', True, False, True),
        Interface('eth1', '10.9.0.2', False, False, True),
        Interface('can0', '', True, False, False),
    ]
    monkeypatch.setattr(address, 'read_interfaces', lambda: iter(interfaces))
    monkeypatch.setattr(address, '_address_to_other_networks', lambda version: '')
    assert address.reachable('0.0.0.0') == ['10.1.0.2', '192.168.3.4']
    assert address.reachable('127.0.0.1') == ['127.0.0.1']
    monkeypatch.setattr(address, '_address_to_other_networks', lambda version: '192.168.3.4')
    assert address.reachable('0.0.0.0') == ['192.168.3.4', '10.1.0.2']
    monkeypatch.setattr(address, 'read_interfaces', lambda: iter(interfaces[:1]))
    monkeypatch.setattr(address, '_address_to_other_networks', lambda version: '')
    assert address.reachable('0.0.0.0') == ['127.0.0.1']
    assert address.reachable('::') == ['::1']
    with Page('test', PageSettings(host='0.0.0.0', token='mine')) as page:
        assert page.urls == [f'http://127.0.0.1:{page.port}/?token=mine']
        assert page.shared_url == ''
        monkeypatch.setattr(address, 'read_interfaces', lambda: iter(interfaces))
        assert page.shared_url == page.url == f'http://10.1.0.2:{page.port}/?token=mine'


def test_own_token() -> None:
    """A token that is given is the one that counts, also on this machine."""
    with Page('test', PageSettings(token='mine')) as page:
        assert ask(page).status == 401
        assert ask(page, '/?token=mine').status == 303


def test_next_port(page: Page) -> None:
    """A second page takes another port, unless it must have the one that is taken."""
    with Page('test', PageSettings(token=NO_TOKEN)) as other:
        assert other.port != page.port
    with pytest.raises(PortError, match=f'Port {page.port} of 127.0.0.1 cannot be taken: '):
        Page('test', PageSettings(port=page.port, token=NO_TOKEN))


def test_port_is_free_again() -> None:
    """A page that is closed leaves its port to the next one."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        port = page.port
    with Page('test', PageSettings(port=port, token=NO_TOKEN)) as page:
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
    with Page('test', PageSettings(token=NO_TOKEN)):
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
    with pytest.raises(ValueError, match="path '/echo' is already in use"):
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


class Hurrying(deque[Any]):
    """Those who wait for an event; another thread does something just before one of them does."""

    def __init__(self, before: threading.Thread) -> None:
        super().__init__()
        self._before = before

    def append(self, waiting: Any) -> None:
        """Note who waits, after the thread has come to its end."""
        if self._before.ident is None:
            self._before.start()
            self._before.join()
        super().append(waiting)


def test_update_that_comes_just_before_a_browser_waits() -> None:
    """It is sent: viser's buffer of updates wakes those who wait in its event loop only."""

    async def next_update() -> Any:
        buffer = AsyncMessageBuffer(asyncio.get_running_loop(), persistent_messages=True)
        update = SetOrientationMessage('/link', (1.0, 0.0, 0.0, 0.0))
        hurrying = Hurrying(threading.Thread(target=buffer.push, args=(update,)))
        buffer.message_event._waiters = hurrying
        windows = buffer.window_generator(0)
        try:
            return (await asyncio.wait_for(windows.__anext__(), 10.0))[0] is update
        finally:
            buffer.set_done()
            await windows.aclose()

    assert asyncio.run(next_update())
