# SPDX-License-Identifier: Apache-2.0
"""Pages that are told what is new, and what happens with browsers that do odd things."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
import json
import time
from typing import Any

import pytest
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, PageSettings, PlainPage, Route
from rviz_common.page.channel import Channel, Viewer
from websockets.exceptions import ConnectionClosed, ConnectionClosedError
from websockets.sync.client import ClientConnection, connect


class Desk:
    """A channel at a page; what it asks for is done when a test lets time pass."""

    def __init__(self, page: PlainPage) -> None:
        """Serve the channel."""
        self.queue = WorkQueue()
        self.done: list[Any] = []
        self.channel = Channel(
            self.queue,
            lambda viewer: viewer.tell(hello=1),
            {'note': self._note, 'refuse': self._refuse},
        )
        page.routes.add('/desk', Route('', self.channel.talk))
        self.url = f'ws://127.0.0.1:{page.port}/desk'

    def _note(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        self.done.append(message['what'])

    def _refuse(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        raise ValueError('Not today.')

    def wait_until(self, predicate: Callable[[], bool], what: str) -> None:
        """Do what is asked for until something holds."""
        end_s = time.monotonic() + 100.0
        while not predicate():
            assert time.monotonic() < end_s, f'{what}; done: {self.done}'
            self.queue.run()
            time.sleep(0.01)

    def visit(self) -> ClientConnection:
        """Connect as a browser does, and take the greeting."""
        count = len(self.channel.viewers)
        client = connect(self.url)
        self.wait_until(lambda: len(self.channel.viewers) > count, 'nobody came')
        assert heard(client) == {'hello': 1}
        return client


def heard(client: ClientConnection) -> Any:
    """Return what a browser is told next."""
    return json.loads(client.recv(timeout=100))


@pytest.fixture
def desk() -> Iterator[Desk]:
    """Return a channel of a page."""
    with PlainPage('test', {}, PageSettings(token=NO_TOKEN)) as page:
        yield Desk(page)


def test_ask_and_tell(desk: Desk) -> None:
    """All who look are told, and what one asks for is done in order."""
    first, second = desk.visit(), desk.visit()
    desk.channel.tell(news=[1, 'ü'])
    assert heard(first) == heard(second) == {'news': [1, 'ü']}
    for number in range(3):
        first.send(json.dumps({'do': 'note', 'what': number}))
    desk.wait_until(lambda: desk.done == [0, 1, 2], 'not done')
    second.close()
    desk.wait_until(lambda: len(desk.channel.viewers) == 1, 'still there')


def test_refusal(desk: Desk) -> None:
    """Who asks for something that cannot be is told why."""
    client = desk.visit()
    client.send(json.dumps({'do': 'refuse'}))
    client.send(json.dumps({'do': 'note', 'what': 'after'}))
    desk.wait_until(lambda: desk.done == ['after'], 'not done')
    assert heard(client) == {'refusal': 'Not today.', 'of': 'refuse'}


@pytest.mark.parametrize(
    'text', ['', '{', '3', '{"do": 3}', '{"do": "nothing"}', '[' * 100000, b'\xff']
)
def test_odd_texts(desk: Desk, text: str | bytes) -> None:
    """What no page would ask for ends that connection, and no other."""
    odd, other = desk.visit(), desk.visit()
    odd.send(text)
    with pytest.raises(ConnectionClosedError):
        odd.recv(timeout=100)
    desk.wait_until(lambda: len(desk.channel.viewers) == 1, 'still there')
    desk.channel.tell(fine=True)
    assert heard(other) == {'fine': True}


def test_stalled_browser(desk: Desk) -> None:
    """A browser that reads nothing is dropped before it costs memory; others go on."""
    stalled = connect(desk.url, max_queue=1)
    desk.wait_until(lambda: len(desk.channel.viewers) == 1, 'nobody came')
    viewer, other = desk.channel.viewers[0], desk.visit()
    text = 'x' * 200_000
    for _ in range(200):
        desk.channel.tell(text=text)
        assert heard(other)['text'] == text
        if viewer not in desk.channel.viewers:
            break
        desk.queue.run()
    assert viewer not in desk.channel.viewers, 'the stalled one is still there'
    stalled.close()


def test_end(desk: Desk) -> None:
    """A panel that is closed ends its connections, also those that just begin."""
    client, late = desk.visit(), connect(desk.url)
    desk.channel.end()
    with pytest.raises(ConnectionClosed):
        client.recv(timeout=100)
    time.sleep(0.2)
    desk.queue.run()
    with pytest.raises(ConnectionClosed):
        late.recv(timeout=100)
    assert desk.channel.viewers == []
