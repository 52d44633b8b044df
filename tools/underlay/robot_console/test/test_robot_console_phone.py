# SPDX-License-Identifier: Apache-2.0
"""Use the page for phones with fingers, in a browser with a small screen."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any
from urllib.request import urlopen

from console_world import World, world_of
import pytest
from robot_console.panels.robot import Robot
from robot_console.robot_link import LATCHED
from std_msgs.msg import String
from std_srvs.srv import Trigger

PORTRAIT, LANDSCAPE = (390, 844), (844, 390)
SIZE = '[document.documentElement.scrollWidth, document.documentElement.scrollHeight]'
LOOK = """
    (body) => {
      document.documentElement.setAttribute('data-mantine-color-scheme', 'dark');
      body.append(Object.assign(document.createElement('iframe'), { title: 'look' }));
    }
"""
TARGET = 44
PATIENCE_S = 100.0
SMALL_TARGETS = """
    (least) => {
      const all = [...document.querySelectorAll('a, button, input, select, [tabindex]')];
      return all.filter((each) => {
        const { width, height } = each.getBoundingClientRect();
        return each.getClientRects().length && (width < least || height < least);
      }).map((each) => each.outerHTML);
    }
"""


@pytest.fixture
def world(patience: None) -> Iterator[World]:
    """Return a page, panels and a robot."""
    with world_of('') as world:
        yield world


def middle(phone: Any, element: str) -> tuple[float, float]:
    """Return the middle of an element."""
    box = phone.locator(element).bounding_box()
    return box['x'] + box['width'] / 2, box['y'] + box['height'] / 2


class Fingers:
    """What touches a page."""

    def __init__(self, phone: Any) -> None:
        """Take a page that has been loaded."""
        self._session = phone.context.new_cdp_session(phone)

    def touch(self, kind: str, *points: tuple[float, float]) -> None:
        """Say where fingers are: the first one at the first point, and so on."""
        places = [{'x': x, 'y': y, 'id': finger} for finger, (x, y) in enumerate(points)]
        self._session.send('Input.dispatchTouchEvent', {'type': kind, 'touchPoints': places})


@pytest.fixture
def phone(open_tab: Any, world: World) -> Any:
    """Open the address of the page on a phone, with a robot that has fallen."""
    robot = Robot(world.context, {'Title': 'Ann'})
    robot.start()
    world.panels.append(robot)
    world.robot.create_service(Trigger, 'stand_up', lambda request, response: response)
    walking = world.robot.create_publisher(String, 'walking_state', LATCHED)
    walking.publish(String(data='fallen'))
    phone = open_tab(*PORTRAIT, has_touch=True, is_mobile=True)
    phone.goto(f'http://127.0.0.1:{world.page.port}/?fixedDpr=0.5')
    phone.wait_for_url('**/phone?fixedDpr=0.5')
    world.wait_until(lambda: phone.locator('#link').text_content() == 'connected', 'no link')
    world.wait_until(lambda: 'Stands' in phone.locator('#what').text_content(), 'no stick')
    return phone


def misfits(phone: Any, width: int, height: int) -> list[str]:
    """Return what is too small for fingers, cut off, or leaves too little to the scene."""
    frame = next(each for each in phone.frames if each.url.endswith('/robot?phone'))
    found = [each for page in (phone, frame) for each in page.evaluate(SMALL_TARGETS, TARGET)]
    shown, needed = phone.locator('#robotFrame').bounding_box(), frame.locator('body')
    if shown['height'] < needed.bounding_box()['height']:
        found.append('The state is cut off.')
    page = phone.evaluate(SIZE)
    if page[0] > width or page[1] > height:
        found.append(f'The page is {page[0]} x {page[1]}.')
    scene = phone.locator('#scene').bounding_box()
    if scene['width'] * scene['height'] < 0.36 * width * height:
        found.append(f'The scene is {scene["width"]} x {scene["height"]}.')
    return found


def turn(world: World, phone: Any) -> None:
    """Hold the phone sideways, then upright: all of the page fits each time."""
    for width, height in (LANDSCAPE, PORTRAIT):
        phone.set_viewport_size({'width': width, 'height': height})
        seen: list[str] = ['not seen yet']
        end_s = time.monotonic() + PATIENCE_S
        while seen and time.monotonic() < end_s:  # the frame of the state follows in a moment
            world.executor.spin_once(timeout_sec=0.02)
            seen = misfits(phone, width, height)
        assert seen == [], f'{width} x {height}'


def test_phone(world: World, phone: Any) -> None:
    """All that is needed is in sight, upright and sideways; a finger stops, another drives."""
    state, scene = phone.frame_locator('#robotFrame'), phone.frame_locator('#scene')
    words = state.locator('#words')
    world.wait_until(lambda: words.text_content() == 'Fallen: press Stand up', 'no words')
    assert state.get_by_role('button').all_text_contents() == ['Stand up']
    assert phone.title() == 'Ann'
    scene.locator('canvas').first.wait_for()
    scene.locator('.mantine-Paper-root').first.wait_for(state='attached')
    assert scene.locator('.mantine-Paper-root').filter(visible=True).count() == 0
    turn(world, phone)

    fingers, (x, y) = Fingers(phone), middle(phone, '#stick')
    fingers.touch('touchStart', (x, y))
    fingers.touch('touchMove', (x, y - 200))
    world.wait_until(lambda: world.twists()[-1:] == [(0.25, 0.0)], 'no velocity')
    fingers.touch('touchStart', (x, y - 200), middle(phone, '#stop'))
    world.wait_until(lambda: world.stops() == [True], 'no stop')
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.0)], 'no zero')
    fingers.touch('touchEnd')

    phone.locator('#release').tap()
    phone.locator('#release').tap()
    world.wait_until(lambda: world.stops() == [True, False], 'no release')
    view = middle(phone, '#scene')
    fingers.touch('touchStart', view)
    fingers.touch('touchStart', view, middle(phone, '#stop'))
    world.wait_until(lambda: world.stops() == [True, False, True], 'no stop')
    fingers.touch('touchEnd')
    world.wait_until(lambda: phone.locator('#release').is_visible(), 'no way to release')
    world.wait_until(lambda: 'has not confirmed' in words.text_content(), 'no long sentence')
    turn(world, phone)

    phone.get_by_role('link', name='All panels').tap()
    phone.wait_for_url('**/?full*')
    phone.locator('iframe[title=safety]').wait_for(state='attached')
    assert '/?full' in phone.url


def test_theme(world: World, phone: Any) -> None:
    """The page has the theme of the system until the scene has chosen one, as has the state."""
    pages = (phone, phone.frame_locator('#robotFrame'))

    def themes() -> list[str]:
        return [page.locator('html').get_attribute('data-theme') for page in pages]

    assert themes() == ['light', 'light']
    phone.frame_locator('#scene').locator('body').evaluate(LOOK)
    world.wait_until(lambda: themes() == ['dark', 'dark'], 'another theme')


def test_only_robots_with_a_stick(world: World) -> None:
    """A phone gets a page of its own while there are a stick and a stop button for it."""
    assert b'path = "/phone"' in served(world)
    world.panels.pop().close()
    assert b'path = ""' in served(world)
    assert world.page.routes.find('/phone') is None


def served(world: World) -> bytes:
    """Return the beginning of the page."""
    with urlopen(f'http://127.0.0.1:{world.page.port}/') as answer:
        return bytes(answer.read(20_000))
