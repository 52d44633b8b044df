# SPDX-License-Identifier: Apache-2.0
"""Send what no page sends, and check what is said about the connections of browsers."""

from __future__ import annotations

from collections.abc import Iterator
import random
import socket
import time
from typing import Any

import msgspec
import pytest
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.page.connection_log import LOGGER
from rviz_common.page.message_filter import decoded
import viser
from websockets.exceptions import ConnectionClosed, ConnectionClosedError, InvalidMessage
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

CAMERA: dict[str, Any] = {
    'type': 'ViewerCameraMessage',
    'wxyz': [1, 0, 0, 0],
    'position': [3, 0, 1.5],
    'fov': 0.8,
    'near': 0.01,
    'far': 1000,
    'image_height': 600,
    'image_width': 800.0,
    'look_at': [0, 0, 0],
    'up_direction': [0, 0, 1],
}
UPDATE: dict[str, Any] = {'type': 'GuiUpdateMessage', 'uuid': 'x', 'updates': {'value': [1, 'a']}}


@pytest.fixture
def page() -> Iterator[Page]:
    """Serve a page on a port of its own."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        yield page


def visit(page: Page) -> ClientConnection:
    """Connect as a browser does."""
    protocol = Subprotocol(f'viser-v{viser.__version__}')
    return connect(f'ws://127.0.0.1:{page.port}', subprotocols=[protocol])


def wait_for_clients(page: Page, count: int) -> None:
    """Wait until so many browsers have said how they look at the scene."""
    end_s = time.monotonic() + 100.0
    while len(page.viser.get_clients()) != count:
        assert time.monotonic() < end_s, f'not {count} clients'
        time.sleep(0.01)


def test_what_pages_send() -> None:
    """A camera and the value of a widget pass."""
    for message in (CAMERA, UPDATE):
        assert type(decoded(msgspec.msgpack.encode(message))).__name__ == message['type']


@pytest.mark.parametrize(
    ('message', 'reason'),
    [
        (7, 'type None'),
        ({}, 'type None'),
        ({'type': ['a']}, 'type'),
        ({'type': 'ShareUrlRequest'}, "type 'ShareUrlRequest'"),
        ({**CAMERA, 'wxyz': [1, 0, 0]}, 'length 4'),
        ({**CAMERA, 'fov': 'wide'}, 'float'),
        ({**CAMERA, 'near': float('nan')}, 'not finite'),
        ({**CAMERA, 'more': 1}, 'unknown fields'),
        ({'type': 'ViewerCameraMessage'}, 'missing'),
        ({**UPDATE, 'updates': {'value': [{'a': float('inf')}]}}, 'not finite'),
        ({**UPDATE, 'updates': {'value': 1, 'update_cb': []}}, 'properties of a widget other'),
        ({**UPDATE, 'updates': {}}, 'properties of a widget other'),
    ],
)
def test_what_pages_do_not_send(message: Any, reason: str) -> None:
    """Other types, wrong fields and wrong numbers do not pass, and the reason is said."""
    objection = decoded(msgspec.msgpack.encode(message))
    assert isinstance(objection, str) and reason in objection


def test_what_cannot_be_read() -> None:
    """Neither does what is no message, or is nested too deeply."""
    chance = random.Random(1)
    assert decoded('{}') == 'a text'
    assert all(isinstance(decoded(chance.randbytes(size)), str) for size in range(200))
    assert isinstance(decoded(b'\x91' * 1_000_000), str)


def test_a_page_outlives_it(page: Page, capfd: pytest.CaptureFixture[str]) -> None:
    """A browser that sends them stays connected, and the widgets stay as they are."""
    box = page.viser.gui.add_number('n', 1.0)
    with socket.create_connection(('127.0.0.1', page.port)) as stranger:
        stranger.sendall(b'\x16\x03\x01 this is no HTTP\r\n\r\n')
        assert stranger.recv(100) == b''
    with visit(page) as browser:
        for message in (7, {'type': 'ShareUrlRequest'}, {**CAMERA, 'fov': float('nan')}):
            browser.send(msgspec.msgpack.encode(message))
        update = {'type': 'GuiUpdateMessage', 'uuid': box._impl.uuid}
        browser.send(msgspec.msgpack.encode({**update, 'updates': {'value': ['no number']}}))
        browser.send(msgspec.msgpack.encode({**update, 'updates': {'disabled': True}}))
        browser.send(msgspec.msgpack.encode(CAMERA))
        wait_for_clients(page, 1)
        assert (box.value, box.disabled) == (1.0, False)
    wait_for_clients(page, 0)
    assert 'Traceback' not in capfd.readouterr().err


def test_what_is_not_offered(page: Page) -> None:
    """A choice that a widget does not offer does not pass; those that it does offer do."""
    gui = page.viser.gui
    choice: Any = gui.add_dropdown('Speed', ('1', '2'))
    group: Any = gui.add_button_group('Plot', ('Pause', 'Clear'))
    chosen: list[str] = []
    for widget in (choice, group):
        widget._impl.update_cb.append(lambda event: chosen.append(event.target.value))
    with visit(page) as browser:
        browser.send(msgspec.msgpack.encode(CAMERA))
        wait_for_clients(page, 1)
        for widget, value in ((choice, '--evil'), (group, 'Nothing'), (choice, 2), (choice, '2')):
            update = {**UPDATE, 'uuid': widget._impl.uuid, 'updates': {'value': value}}
            browser.send(msgspec.msgpack.encode(update))
        end_s = time.monotonic() + 100.0
        while not chosen:
            assert time.monotonic() < end_s, 'the offered choice has not come'
            time.sleep(0.01)
    assert chosen == ['2'] and choice.value == '2'


def test_large_messages(page: Page) -> None:
    """A message that is much larger than a part of a file ends the connection."""
    with visit(page) as browser:
        browser.send(b'x' * 3_000_000)
        with pytest.raises(ConnectionClosed, match='1009'):
            while True:
                browser.recv(timeout=100)


@pytest.mark.parametrize(
    'error', [ConnectionClosedError(None, None), InvalidMessage('did not receive HTTP')]
)
def test_who_goes_is_no_fault(error: Exception, caplog: pytest.LogCaptureFixture) -> None:
    """A browser that goes without a word, or was never one, is not reported."""
    LOGGER.error('connection handler failed', exc_info=error)
    assert caplog.messages == []


def test_other_failures(caplog: pytest.LogCaptureFixture) -> None:
    """Any other failure is reported in one sentence, without a traceback."""
    LOGGER.error('connection handler failed', exc_info=RuntimeError('no more memory'))
    assert len(caplog.messages) == 1
    assert caplog.messages[0].startswith('A connection has failed: ')
    assert 'no more memory' in caplog.messages[0]
    assert caplog.records[0].exc_info is None
