# SPDX-License-Identifier: Apache-2.0
"""What the page is told, and what it may ask for; without a browser."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Iterator
import json
from typing import Any
from urllib.request import urlopen

from page_stage import Stage, stage
import pytest
from turtlesim_py.canvas import FIELD
from turtlesim_py.turtle import Velocity
from turtlesim_py.world import CENTRE
from websockets.sync.client import ClientConnection, connect

MIDDLE = pytest.approx(CENTRE, abs=1e-3)


@pytest.fixture
def zoo() -> Iterator[Stage]:
    """Serve a page."""
    with stage() as made:
        yield made


def visit(zoo: Stage) -> ClientConnection:
    """Connect as a browser does."""
    return connect(zoo.url.replace('http', 'ws'))


def heard(zoo: Stage, client: ClientConnection, key: str) -> dict[str, Any]:
    """Return the next message that has a key."""
    found: list[dict[str, Any]] = []

    def listen() -> bool:
        try:
            found.append(json.loads(client.recv(timeout=0.01)))
        except TimeoutError:
            return False
        return key in found[-1]

    zoo.until(listen, f'nothing was told about {key}: {found}')
    return found[-1]


@pytest.mark.parametrize(
    ('path', 'kind'), [('', 'html'), ('turtlesim.css', 'css'), ('turtlesim.js', 'javascript')]
)
def test_files(zoo: Stage, path: str, kind: str) -> None:
    """The page and what it consists of are served."""
    with urlopen(zoo.url + path, timeout=100) as answer:
        assert answer.headers['Content-Type'] == f'text/{kind}; charset=utf-8'
        assert b'SPDX-License-Identifier' in answer.read(200)


def test_a_browser_is_told_everything_then_changes(zoo: Stage) -> None:
    """First all that there is, then what moves, appears, is drawn or is erased."""
    client = visit(zoo)
    first = heard(zoo, client, 'name')
    assert (first['name'], first['field'], first['image']) == ('/zoo/turtlesim', FIELD, '')
    assert first['background'] == [69, 86, 255]
    assert first['turtles'] == [['turtle1', 1, MIDDLE, MIDDLE, 0.0]]
    zoo.world.teleport(zoo.turtle, CENTRE, 2.0, 0.5)
    news = heard(zoo, client, 'lines')
    assert news['turtles'] == [['turtle1', 1, MIDDLE, 2.0, 0.5]]
    ((colour, width, points),) = news['lines']
    assert (colour, width) == ([179, 184, 255], 6)
    assert points == pytest.approx([499.0, 499.0, 499.0, (FIELD - 2.0) * 90.0], abs=0.1)
    assert 'background' not in news
    zoo.world.background = (1, 2, 3)
    assert heard(zoo, client, 'background') == {'background': [1, 2, 3]}
    zoo.world.spawn(1.0, 1.0, 0.0)
    assert [each[0] for each in heard(zoo, client, 'turtles')['turtles']] == ['turtle1', 'turtle2']
    zoo.world.canvas.clear()
    assert heard(zoo, client, 'image') == {'image': ''}


def test_who_comes_later_gets_what_was_drawn(zoo: Stage) -> None:
    """Earlier lines are an image, also those that nobody looked at."""
    zoo.world.teleport(zoo.turtle, CENTRE, 2.0, 0.5)
    first = heard(zoo, visit(zoo), 'name')
    assert b64decode(first['image']).startswith(b'\x89PNG')


def test_keys_move_the_first_turtle(zoo: Stage) -> None:
    """Keys are sent as a direction; when they are let go, the turtle stops at once."""
    client = visit(zoo)
    client.send(json.dumps({'do': 'drive', 'forward': 1, 'turn': -1}))
    zoo.until(lambda: zoo.turtle.velocity == Velocity(forward=2.0, turn=-2.0), 'it stands still')
    client.send(json.dumps({'do': 'drive', 'forward': 0, 'turn': 0}))
    zoo.until(lambda: zoo.turtle.velocity == Velocity(), 'it does not stop')


def test_no_turtle_to_drive(zoo: Stage) -> None:
    """Where the first turtle is no longer, the page is told."""
    zoo.world.kill('turtle1')
    client = visit(zoo)
    client.send(json.dumps({'do': 'drive', 'forward': 1, 'turn': 0}))
    assert heard(zoo, client, 'refusal')['refusal'] == 'There is no turtle [turtle1]'


@pytest.mark.parametrize('value', ['"1"', 'null', '2', 'NaN', '1e999', '[1]'])
def test_odd_directions(zoo: Stage, value: str) -> None:
    """What the page never sends moves nothing."""
    client = visit(zoo)
    client.send(f'{{"do": "drive", "turn": 0, "forward": {value}}}')
    assert 'instead of a number' in heard(zoo, client, 'refusal')['refusal']
    assert zoo.turtle.velocity == Velocity()
