# SPDX-License-Identifier: Apache-2.0
"""Look at the turtles in a browser, and drive one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import socket
from typing import Any

from browser import chromium
from obstacles import obstacles
from page_stage import Stage, stage
import pytest
from turtlesim_py.canvas import Pen
from turtlesim_py.world import CENTRE

RED, BACKGROUND = (255, 0, 0), (69, 86, 255)
TOKEN = 'tortoise'
COLOUR = """([x, y]) => {
  const scale = canvas.width / state.field;
  return [...pen.getImageData(x * scale, (state.field - y) * scale, 1, 1).data].slice(0, 3);
}"""


@pytest.fixture(scope='module')
def browser() -> Iterator[Any]:
    """Start a browser, if there is one."""
    with chromium() as browser:
        yield browser


@pytest.fixture
def open_tab(browser: Any) -> Iterator[Callable[[str], Any]]:
    """Return what opens an address in a window of its own, in which no script may fail."""
    failures: list[str] = []
    contexts: list[Any] = []

    def open_one(url: str) -> Any:
        contexts.append(browser.new_context(viewport={'width': 900, 'height': 620}))
        tab = contexts[-1].new_page()
        tab.set_default_timeout(100_000.0)
        tab.on('pageerror', lambda error: failures.append(str(error)))
        tab.goto(url)
        return tab

    yield open_one
    for context in contexts:
        context.close()
    assert failures == []


def has_colour(tab: Any, x: float, y: float, colour: tuple[int, int, int]) -> bool:
    """Tell whether a place of the field has a colour, which may be rounded."""
    found = tab.evaluate(COLOUR, [x, y])
    return all(abs(one - other) <= 2 for one, other in zip(found, colour))


def shows(zoo: Stage, tab: Any, x: float, y: float, colour: tuple[int, int, int]) -> None:
    """Wait until a place of the field has a colour."""
    zoo.until(lambda: has_colour(tab, x, y, colour), f'{colour} is not at {x}, {y}')


def hide(tab: Any, is_hidden: bool) -> None:
    """Let a page believe that it is hidden, or shown."""
    value = 'true' if is_hidden else 'false'
    tab.evaluate(
        f"Object.defineProperty(document, 'hidden', {{ value: {value}, configurable: true }});"
        "document.dispatchEvent(new Event('visibilitychange'))"
    )


def test_everybody_sees_the_same(open_tab: Callable[[str], Any]) -> None:
    """A browser that comes later sees the same trails as the first; turtles are where they are."""
    with stage() as zoo:
        zoo.turtle.pen = Pen(RED, 9)
        first = open_tab(zoo.url)
        shows(zoo, first, 2.0, 2.0, BACKGROUND)
        zoo.world.teleport(zoo.turtle, CENTRE, 9.0, 0.0)
        second = open_tab(zoo.url)
        for tab in (first, second):
            shows(zoo, tab, CENTRE, 7.0, RED)
            assert not has_colour(tab, CENTRE + 0.12, 9.0 + 0.03, BACKGROUND)  # its shell
            assert tab.title() == 'zoo/turtlesim'
        zoo.world.spawn(1.0, 1.0, 0.0, 'peter')
        rows = second.locator('#turtles tr')
        zoo.until(lambda: rows.all_inner_texts()[1:] == ['peter\t1.00\t1.00\t0.00'], 'no row')
        zoo.world.canvas.clear()
        zoo.world.background = (10, 20, 30)
        for tab in (first, second):
            shows(zoo, tab, CENTRE, 7.0, (10, 20, 30))


def test_hidden_page(open_tab: Callable[[str], Any]) -> None:
    """A page that is hidden asks for nothing; shown again, it has everything."""
    with stage() as zoo:
        tab = open_tab(zoo.url)
        zoo.until(lambda: tab.locator('#turtles tr').count() == 1, 'no turtle')
        hide(tab, True)
        assert tab.evaluate('socket') is None
        zoo.turtle.pen = Pen(RED, 9)
        zoo.world.teleport(zoo.turtle, CENTRE, 9.0, 0.0)
        hide(tab, False)
        shows(zoo, tab, CENTRE, 7.0, RED)


def test_keys(open_tab: Callable[[str], Any]) -> None:
    """A held key moves the turtle, letting it go stops it, also where the page loses the focus."""
    with stage() as zoo:
        tab = open_tab(zoo.url)
        zoo.until(lambda: tab.locator('#dot.good').count(), 'no connection')
        tab.keyboard.down('ArrowUp')
        zoo.until(lambda: zoo.turtle.velocity.forward == 2.0, 'it stands still')
        tab.keyboard.down('ArrowLeft')
        zoo.until(lambda: zoo.turtle.velocity.turn == 2.0, 'it does not turn')
        tab.keyboard.up('ArrowUp')
        zoo.until(lambda: zoo.turtle.velocity.forward == 0.0, 'it does not stop')
        tab.evaluate('dispatchEvent(new Event("blur"))')
        zoo.until(lambda: zoo.turtle.velocity.turn == 0.0, 'it goes on turning')


def test_nothing_keeps_people_from_using_the_page(open_tab: Callable[[str], Any]) -> None:
    """Names, roles and contrast are right; a button is also held with the Enter key."""
    with stage() as zoo:
        tab = open_tab(zoo.url)
        zoo.until(lambda: tab.locator('#turtles tr').count() == 1, 'no turtle')
        tab.get_by_role('button', name='Turn left').focus()
        tab.keyboard.down('Enter')
        zoo.until(lambda: zoo.turtle.velocity.turn == 2.0, 'it does not turn')
        for theme in ('light', 'dark'):
            tab.emulate_media(color_scheme=theme)
            assert obstacles(tab) == []
        tab.keyboard.up('Enter')
        zoo.until(lambda: zoo.turtle.velocity.turn == 0.0, 'it goes on turning')


def test_the_page_comes_back(open_tab: Callable[[str], Any]) -> None:
    """After a new start at the same address it goes on; at another, it says so."""
    with socket.create_server(('127.0.0.1', 0)) as free:
        port = free.getsockname()[1]
    with stage(TOKEN, port) as zoo:
        tab = open_tab(zoo.url)
        zoo.until(lambda: tab.locator('#turtles tr').count() == 1, 'no turtle')
    tab.locator('#lost', has_text='Connecting again').wait_for()
    with stage('another', port) as zoo:
        tab.locator('#lost', has_text='has another address').wait_for()
    with stage(TOKEN, port) as zoo:
        zoo.world.spawn(1.0, 1.0, 0.0)
        zoo.until(lambda: tab.locator('#turtles tr').count() == 2, 'it does not come back')
        assert not tab.locator('#lost').is_visible()
