# SPDX-License-Identifier: Apache-2.0
"""Use the panels of what a system says in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from live_world import live_world, LiveWorld, PANELS
import pytest
from simulation_interfaces.msg import Resource, Result, WorldResource
from simulation_interfaces.srv import GetAvailableWorlds, LoadWorld
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

EVIL = '<img src=x onerror="throw 1">'


@pytest.fixture
def world() -> Iterator[LiveWorld]:
    """Return a page and a robot."""
    with live_world() as world:
        yield world


@pytest.fixture
def tab(open_tab: Any) -> Any:
    """Open a tab."""
    return open_tab(360, 480)


def show(world: LiveWorld, tab: Any, name: str) -> None:
    """Start a panel, and open its page."""
    world.start(name)
    tab.goto(f'http://127.0.0.1:{world.page.port}/{name}')


def shows(world: LiveWorld, tab: Any, element: str, words: str) -> None:
    """Wait until an element of a page has some words."""
    world.wait_until(
        lambda: words in ' '.join(tab.locator(element).all_text_contents()), f'{element}: {words}'
    )


def test_log(world: LiveWorld, tab: Any) -> None:
    """Lines are hidden by level, node and words; what nodes say stays text."""
    show(world, tab, 'log')
    for each in ('one', 'two', 'two', EVIL):
        world.robot.get_logger().info(each)
    world.robot.get_logger().error('bad')
    shows(world, tab, '.text', 'bad')
    shows(world, tab, '.text', EVIL)
    assert tab.locator('.times').nth(1).text_content().endswith(' 2')
    world.robot.get_logger().info('two')
    shows(world, tab, '.line:last-child .times', '\u00d7 3')
    assert tab.locator('.line .text').all_text_contents() == ['one', EVIL, 'bad', 'two']
    tab.get_by_role('button', name='Info').click()
    assert tab.locator('.line .text').all_text_contents() == ['bad']
    tab.get_by_role('button', name='Info').click()
    tab.locator('#search').fill('ON robot')
    assert tab.locator('.line .text').all_text_contents() == ['one', EVIL]
    world.robot.get_logger().info('two and on')
    shows(world, tab, '.text', 'two and on')
    assert tab.locator('#what').text_content() == '3 of 5 different messages'
    tab.locator('#search').fill('')
    tab.get_by_role('button', name='Pause').click()
    world.robot.get_logger().info('later')
    shows(world, tab, '#what', 'Paused; 1 newer')
    tab.get_by_role('button', name='Continue').click()
    shows(world, tab, '.text', 'later')
    tab.get_by_role('button', name='Clear').click()
    assert tab.locator('.line').count() == 0


def test_diagnostics(world: LiveWorld, tab: Any) -> None:
    """A click on a part shows what is known of it."""
    show(world, tab, 'diagnostics')
    shows(world, tab, '#list', 'No publisher on /diagnostics')
    publisher = world.robot.create_publisher(DiagnosticArray, '/diagnostics', 10)
    world.wait_until(lambda: publisher.get_subscription_count() > 0, 'no subscription')
    status = DiagnosticStatus(name=EVIL, level=b'\x02', message='hot', hardware_id='m3')
    publisher.publish(DiagnosticArray(status=[status]))
    shows(world, tab, '.item .told', 'hot')
    tab.locator('.item').click()
    shows(world, tab, '#details', 'm3')
    shows(world, tab, '#details', 'Error: hot')


def test_topics(world: LiveWorld, tab: Any) -> None:
    """A click on a topic shows its newest message, and a second one no longer."""
    publisher = world.robot.create_publisher(String, 'words', 10)
    world.robot.create_timer(0.05, lambda: publisher.publish(String(data='hi')))
    show(world, tab, 'topics')
    shows(world, tab, '.name', '/robot1/words')
    assert '/rosout' in tab.locator('#list').text_content()
    tab.locator('#search').fill('string words')
    tab.get_by_role('button', name='/robot1/words').click()
    shows(world, tab, '#text', 'data: hi')
    shows(world, tab, '#numbers', 'Hz')
    shows(world, tab, '#ends', '/console (this program)')
    tab.locator('#rates').check()
    shows(world, tab, '.item .num', 'Hz')
    tab.get_by_role('button', name='/robot1/words').click()
    world.wait_until(lambda: tab.locator('#details').is_hidden(), 'still shown')


def test_parameters(world: LiveWorld, tab: Any) -> None:
    """A value is set with Enter; what is refused stays for correction, Esc takes it back."""
    world.robot.declare_parameter('speed', 1.5)
    world.robot.declare_parameter('loud', False)
    show(world, tab, 'parameters')
    shows(world, tab, '#node', '/robot1/robot')
    tab.locator('#node').select_option('/robot1/robot')
    shows(world, tab, '.name', 'speed')
    speed = tab.get_by_label('speed')
    speed.fill('fast')
    speed.press('Enter')
    shows(world, tab, '.note', "must be a number, not 'fast'")
    assert speed.input_value() == 'fast'
    speed.press('Escape')
    assert speed.input_value() == '1.5'
    speed.fill('2')
    speed.press('Enter')
    world.wait_until(lambda: speed.input_value() == '2.0', 'not set')
    assert world.robot.get_parameter('speed').value == 2.0
    tab.get_by_label('loud').click()
    world.wait_until(lambda: world.robot.get_parameter('loud').value, 'not set')


def test_services(world: LiveWorld, tab: Any) -> None:
    """A request is filled and called; the answer is shown, and the services of nodes hidden."""

    def switch(request: Any, response: Any) -> Any:
        response.success, response.message = request.data, EVIL
        return response

    world.robot.create_service(SetBool, 'switch', switch)
    show(world, tab, 'services')
    shows(world, tab, '.name', '/robot1/switch')
    assert 'set_parameters' not in tab.locator('#list').text_content()
    tab.get_by_role('button', name='/robot1/switch').click()
    shows(world, tab, '#about', 'Offered by /robot1/robot')
    tab.locator('#request').fill('data: true')
    tab.get_by_role('button', name='Call').click()
    shows(world, tab, '#response', 'success: true')
    shows(world, tab, '#response', EVIL)
    tab.locator('#all').check()
    assert 'set_parameters' in tab.locator('#list').text_content()


def test_robot(world: LiveWorld, tab: Any) -> None:
    """A button says why it is disabled, or calls its service; a rejection is shown as text."""

    def refuse(request: Any, response: Any) -> Any:
        response.message = EVIL
        return response

    show(world, tab, 'robot')
    shows(world, tab, '#why', 'No simulator is running')
    stand_up = tab.get_by_role('button', name='Stand up')
    assert stand_up.is_disabled() and "no service '/stand_up'" in stand_up.get_attribute('title')
    world.robot.create_service(Trigger, '/stand_up', refuse)
    world.wait_until(stand_up.is_enabled, 'still disabled')
    stand_up.click()
    shows(world, tab, '#said', EVIL)
    assert tab.locator('body').bounding_box()['height'] < 120


def test_scene_that_is_refused(world: LiveWorld, tab: Any) -> None:
    """The reason is shown, and the list does not go on to name a scene that is not loaded."""

    def offer(request: Any, response: Any) -> Any:
        response.worlds.append(WorldResource(name='Moon', world_resource=Resource(uri='moon')))
        response.result.result = Result.RESULT_OK
        return response

    def refuse(request: Any, response: Any) -> Any:
        response.result.error_message = f"'{request.uri}' is too far."
        return response

    world.robot.create_service(GetAvailableWorlds, '/simulator/get_available_worlds', offer)
    world.robot.create_service(LoadWorld, '/simulator/load_world', refuse)
    show(world, tab, 'robot')
    scenes = tab.locator('#world')
    world.wait_until(scenes.is_enabled, 'still disabled')
    scenes.select_option('Moon')
    shows(world, tab, '#said', "'moon' is too far.")
    assert scenes.input_value() == ''


@pytest.mark.parametrize('name', PANELS)
def test_lost_connection(world: LiveWorld, tab: Any, name: str) -> None:
    """A page says that the connection is lost, comes back by itself, and is nowhere cut off."""
    show(world, tab, name)
    world.wait_until(lambda: bool(world.panels[0].channel.viewers), 'nobody came')
    assert tab.evaluate('document.documentElement.scrollWidth <= innerWidth')
    assert tab.locator('#lost').is_hidden()
    world.panels.pop().close()
    world.wait_until(lambda: tab.locator('#lost').is_visible(), 'nothing is said')
    world.start(name)
    world.wait_until(lambda: tab.locator('#lost').is_hidden(), 'not back')
