# SPDX-License-Identifier: Apache-2.0
"""Use the panel of navigation in a browser, with a server that does as the test says."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from browser import chromium
from obstacles import obstacles
import pytest
from rviz_fakes import navigation_world, NavigationWorld

FROM_ABOVE = """
Panels:
  - Class: nav2_rviz_plugins/Navigation 2
    Name: Navigation 2
Visualization Manager:
  Displays: []
  Global Options:
    Fixed Frame: map
    Frame Rate: 10
  Views:
    Current:
      Class: rviz_default_plugins/Orbit
      Distance: 10
      Pitch: 1.5
      Yaw: 4.71
      Value: Orbit (rviz)
"""


@pytest.fixture(scope='module')
def browser() -> Iterator[Any]:
    """Start a browser, if there is one."""
    with chromium() as browser:
        yield browser


@pytest.fixture
def world() -> Iterator[NavigationWorld]:
    """Return a page that looks at the ground from above, and a server."""
    with navigation_world(FROM_ABOVE) as world:
        world.serve('navigate_to_pose')
        yield world


@pytest.fixture
def tab(world: NavigationWorld, browser: Any) -> Iterator[Any]:
    """Open the page, in which no script may fail."""
    tab = browser.new_page(viewport={'width': 900, 'height': 600})
    failures: list[str] = []
    tab.on('pageerror', lambda error: failures.append(str(error)))
    tab.goto(f'http://127.0.0.1:{world.page.port}/?fixedDpr=0.5', wait_until='commit')
    yield tab
    tab.close()
    assert failures == []


def shows(world: NavigationWorld, panel: Any, element: str, words: str) -> None:
    """Wait until an element of the panel has some words."""
    world.wait_until(
        lambda: words in ' '.join(panel.locator(element).all_text_contents()),
        f'{element}: {words}',
    )


def test_goal_is_clicked_followed_and_canceled(world: NavigationWorld, tab: Any) -> None:
    """A goal that is drawn in the scene gets to the server; feedback and results are shown."""

    def is_loaded() -> bool:
        tab.wait_for_timeout(10)  # for playwright to take note of frames
        return any('/navigation' in frame.url for frame in tab.frames)

    world.wait_until(is_loaded, 'no small page')
    panel = next(frame for frame in tab.frames if '/navigation' in frame.url)
    shows(world, panel, '#title', 'No goal yet')
    server = world.servers['navigate_to_pose']

    def draw(count: int) -> bool:
        """Draw a goal unless it is there; a page that is slow may miss the pointer."""
        for _ in range(50):  # what was drawn before may still be on its way, and end the tool
            world.executor.spin_once(timeout_sec=0.02)
        if len(server.goals) > count:
            return True
        if not panel.locator('#tool-goal.on').count():
            panel.evaluate("document.getElementById('tool-goal').click()")
            return False
        tab.mouse.move(250, 320)
        for step in (
            lambda: tab.mouse.down(),
            lambda: tab.mouse.move(250, 300),
            lambda: tab.mouse.move(250, 250),
            lambda: tab.mouse.up(),
        ):
            step()
            for _ in range(30):
                world.executor.spin_once(timeout_sec=0.02)
        return len(server.goals) > count

    world.wait_until(lambda: draw(0), 'no goal')
    pose = server.goals[-1].request.pose
    assert pose.header.frame_id == 'map'
    assert pose.pose.orientation.z == pytest.approx(0.707, abs=0.1)
    shows(world, panel, '#phase', 'on the way')

    def is_shown() -> bool:
        server.feed(distance_remaining=3.25, estimated_time_remaining=65, navigation_time=4)
        return panel.locator('#distance').text_content() == '3.25 m'

    world.wait_until(is_shown, 'no feedback')
    assert panel.locator('#eta').text_content() == '1:05'
    panel.evaluate("document.getElementById('cancel').click()")
    world.wait_until(lambda: server.goals[-1].is_cancel_requested, 'not canceled')
    server.end('canceled')
    shows(world, panel, '#phase', 'canceled')
    world.wait_until(lambda: draw(1), 'no second goal')
    shows(world, panel, '#phase', 'on the way')
    assert obstacles(panel) == []
    server.end('abort', 204, '<b>The goal is in a wall.</b>')
    shows(world, panel, '#text', '<b>The goal is in a wall.</b> (error code 204)')
    assert panel.locator('#cancel').is_hidden()
