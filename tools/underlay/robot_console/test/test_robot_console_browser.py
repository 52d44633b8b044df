# SPDX-License-Identifier: Apache-2.0
"""Use the small pages in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from console_world import World, world_of
import pytest
from robot_console.panels.safety import Safety
from robot_console.recordings.play_folder import Badge
from robot_console.robot_link import LATCHED
from rviz_common.page import Route
from std_msgs.msg import Bool

FRAMES = (
    '<input id="text"><select><option>a<option>b</select><input type="checkbox" checked>'
    '<input aria-haspopup="listbox" value="a">'
    '<iframe src="/safety" title="safety"></iframe><iframe src="/safety/b"></iframe>'
)


@pytest.fixture
def world() -> Iterator[World]:
    """Return a page, panels and a robot."""
    with world_of('') as world:
        yield world


@pytest.fixture
def tab(open_tab: Any) -> Any:
    """Open a tab."""
    return open_tab(300, 420)


def stall(tab: Any) -> None:
    """Keep a page from doing anything for longer than a robot waits for a page."""
    tab.evaluate('const end = performance.now() + 1000; while (performance.now() < end);')


def shows(world: World, tab: Any, element: str, words: str) -> None:
    """Wait until an element of a small page has some words."""
    world.wait_until(
        lambda: words in (tab.locator(element).text_content() or ''), f'{element}: {words}'
    )


def test_drive_with_keys(patience: None, world: World, tab: Any) -> None:
    """Keys drive as long as they are held, and the page has the focus."""
    tab.goto(f'http://{world.url("drive")}')
    shows(world, tab, '#what', 'Stands still')
    tab.keyboard.down('w')
    world.wait_until(lambda: world.twists()[-1:] == [(0.25, 0.0)], 'no velocity')
    stall(tab)
    tab.keyboard.down('ArrowLeft')
    world.wait_until(lambda: world.twists()[-1:] == [(0.25, 0.5)], 'no turn')
    tab.keyboard.up('w')
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.5)], 'not only the turn')
    tab.evaluate('window.dispatchEvent(new Event("blur"))')
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.0)], 'no zero')
    world.wait_until(lambda: world.beats()[-1:] == [False], 'control is not given back')


def test_drive_with_the_stick(patience: None, world: World, tab: Any) -> None:
    """The stick drives while it is held; the slider is the limit; nothing is cut off."""
    tab.goto(f'http://{world.url("drive")}')
    shows(world, tab, '#what', 'Stands still')
    tab.locator('#move').fill('100')
    box = tab.locator('#stick').bounding_box()
    middle = box['x'] + box['width'] / 2, box['y'] + box['height'] / 2
    tab.mouse.move(*middle)
    tab.mouse.down()
    tab.mouse.move(middle[0], middle[1] - 200)
    world.wait_until(lambda: world.twists()[-1:] == [(0.5, 0.0)], 'no velocity')
    stall(tab)
    world.wait_until(lambda: world.twists()[-1:] == [(0.5, 0.0)], 'no velocity any longer')
    tab.mouse.up()
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.0)], 'no zero')
    assert tab.evaluate('document.documentElement.scrollWidth') <= 300


def test_stop_and_release(world: World, tab: Any) -> None:
    """A click stops, two release."""
    tab.goto(f'http://{world.url("safety")}')
    shows(world, tab, '#link', 'connected')
    tab.click('#stop')
    world.wait_until(lambda: world.stops() == [True], 'no stop')
    shows(world, tab, '#hint', 'in this page')
    tab.click('#release')
    shows(world, tab, '#release', 'Release?')
    assert world.stops() == [True]
    tab.click('#release')
    world.wait_until(lambda: world.stops() == [True, False], 'no release')


def test_lost_and_back(world: World, tab: Any) -> None:
    """A page without a connection says so; what was pressed meanwhile is sent after."""
    tab.goto(f'http://{world.url("safety")}')
    shows(world, tab, '#link', 'connected')
    safety = world.panels[0]
    safety.close()
    shows(world, tab, '#link', 'lost: this page cannot stop the robot')
    tab.click('#stop')
    shows(world, tab, '#hint', 'NOT STOPPED YET')
    assert world.stops() == []
    safety.start()
    world.wait_until(lambda: world.stops()[-1:] == [True], 'no stop')
    shows(world, tab, '#link', 'connected')


def test_space_bar_stops_all_robots(world: World, tab: Any) -> None:
    """The space bar stops all robots, also from what one chooses, not where somebody writes."""
    other = Safety(world.panels[0].context, {'Namespace': 'b'})
    other.start()
    stops: list[bool] = []
    world.robot.create_subscription(
        Bool, '/b/emergency_stop', lambda message: stops.append(message.data), LATCHED
    )
    world.page.routes.add('/both', Route(FRAMES))
    tab.goto(f'http://{world.url("both")}')
    for index in range(2):
        frame = tab.frame_locator('iframe').nth(index)
        world.wait_until(
            lambda frame=frame: frame.locator('#link').text_content() == 'connected', 'no frame'
        )
    tab.locator('#text').focus()
    tab.keyboard.press('Space')
    assert tab.locator('#text').input_value() == ' '
    tab.evaluate('document.activeElement.blur()')
    tab.keyboard.press('Space')
    world.wait_until(lambda: world.stops() == [True] and stops == [True], 'not all stop')
    for count, chooser in enumerate(('select', '[type=checkbox]', '[aria-haspopup]'), 2):
        tab.locator(chooser).focus()
        tab.keyboard.press('Space')
        world.wait_until(lambda count=count: len(world.stops()) == count, f'no stop: {chooser}')
    assert tab.locator('[type=checkbox]').is_checked()
    assert tab.locator('[aria-haspopup]').input_value() == 'a'
    other.close()


def test_small_pages_load_once(world: World, tab: Any) -> None:
    """Whatever comes, changes and goes around them, the small pages stay as they are."""
    loads: list[str] = []
    tab.on('request', lambda request: loads.append(request.url.rpartition('/')[2]))
    tab.set_viewport_size({'width': 800, 'height': 600})
    tab.goto(f'http://127.0.0.1:{world.page.port}/?fixedDpr=0.5')
    gui = world.panels[0].context.gui
    for title, element, words in (('safety', '#link', 'connected'), ('drive', '#what', 'Stands')):
        shows(world, tab.frame_locator(f'iframe[title={title}]'), element, words)
    before = [loads.count(name) for name in ('safety', 'drive')]
    safety = tab.locator('iframe[title=safety]')
    safety.evaluate('(frame) => { frame.contentWindow.isTheSame = true; }')
    badge = Badge(world.panels[0].context)
    status = gui.add_markdown('above', order=-100.0)
    with gui.add_folder('Folder', order=-99.0) as folder:
        gui.add_button('Within')
    badge.update('walk')
    tab.get_by_text('PLAYING walk').wait_for()
    badge.update('walk', True)
    tab.get_by_text('mixed').wait_for()
    status.content = 'changed'
    tab.get_by_text('changed').wait_for()
    status.visible = False
    folder.remove()
    badge.update('')
    tab.get_by_text('PLAYING walk').wait_for(state='detached')
    gui.add_markdown('the end')
    tab.get_by_text('the end').wait_for()
    assert [loads.count(name) for name in ('safety', 'drive')] == before
    assert safety.evaluate('(frame) => frame.contentWindow.isTheSame')


def test_small_pages_are_as_wide_as_the_panel(world: World, tab: Any) -> None:
    """No room is lost beside a small page, and nothing can be scrolled sideways."""
    tab.set_viewport_size({'width': 800, 'height': 600})
    tab.goto(f'http://127.0.0.1:{world.page.port}/?fixedDpr=0.5')
    world.panels[0].context.gui.add_html('<p id="beside">beside</p>')
    tab.locator('#beside').wait_for()
    frame = tab.locator('iframe[title=safety]').bounding_box()
    beside = tab.locator('#beside').bounding_box()
    assert (frame['x'], frame['width']) == pytest.approx((beside['x'], beside['width']), abs=1.0)
