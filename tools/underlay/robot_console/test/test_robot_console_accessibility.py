# SPDX-License-Identifier: Apache-2.0
"""Check that people who do not see well, or have no mouse, can use the pages of the console."""

from __future__ import annotations

from collections.abc import Iterator
import json
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from live_world import live_world, LiveWorld, PANELS
from obstacles import obstacles
import pytest
from rcl_interfaces.msg import Log
from robot_console.panels.drive import Drive
from robot_console.panels.safety import Safety
from robot_console.robot_link import LATCHED
from rviz_common.page import Page, PageSettings
from rviz_common.panel import Panel
from slider_node import SliderNode
from std_msgs.msg import Header, String
from std_srvs.srv import Trigger
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

GESTURES = 'gestures: {Wave: {steps: [{seconds: 1.0, joints: {elbow: 0.1}}]}}'
LEVELS = (b'\x00', b'\x01', b'\x02', b'\x03')
# For each page: what is waited for, what is then clicked, and what is waited for after that.
PAGES = {
    'command': ('.running', '#stop', '#refused'),
    'diagnostics': ('.item .k3', '.item', '#details table'),
    'drive': ('#driveDot.good', '#stick', '#what'),
    'gestures': ('#gestures button', '#form button', '#said'),
    'log': ('.line.l50', '.line.l50', '.open'),
    'objects': ('.item', '.item', '#details table'),
    'robot': ('#words *', '#stand_up', '#said'),
    'safety': ('#dot.good', '#kind', '#take'),
    'phone': ('#driveDot.good', '#stop', '#release'),
    'services': ('.item', '.item', '#request'),
    'sliders': ('.joint', '#form button', '#bad'),
    'topics': ('.item', '.item', '#ends h3'),
}


@pytest.fixture
def world(tmp_path: Path) -> Iterator[LiveWorld]:
    """Return a page with all panels, and a robot that has something to say in each of them."""
    file = tmp_path / 'gestures.yaml'
    file.write_text(GESTURES)
    with live_world() as world:
        for name in PANELS:
            world.start(name, **({'File': str(file)} if name == 'gestures' else {}))
        others: list[Panel] = [Safety(world.context), Drive(world.context)]
        for panel in others:
            panel.start()
        yield world
        for panel in others:
            panel.close()


class Talker:
    """What a robot says, again and again, as whoever comes later hears it too."""

    def __init__(self, world: LiveWorld) -> None:
        """Begin."""
        self._robot = world.robot
        self._robot.declare_parameter('speed', 1.5)
        self._robot.declare_parameter('is_loud', False)
        self._robot.create_service(Trigger, '/stand_up', refuse)
        plan = {'steps': [{'text': 'go', 'state': 'running'}, {'text': 'stop', 'state': 'failed'}]}
        parts = [
            DiagnosticStatus(name=f'{level!r}', level=level, values=[KeyValue(key='a', value='b')])
            for level in LEVELS
        ]
        mug = Detection3D(id='mug_1', results=[ObjectHypothesisWithPose()])
        logs = [Log(level=10 * each, name='node', msg=f'message {each}') for each in range(1, 6)]
        self._say('/diagnostics', DiagnosticArray(status=parts))
        self._say('/objects', Detection3DArray(header=Header(frame_id='map'), detections=[mug]))
        self._say('/walking_state', String(data='blocked'))
        self._say('/speech/say', String(data='I am going.'))
        self._say('/user_command', String(data='go'))
        self._say('/executor/state', String(data=json.dumps(plan)))
        self._say('/rosout', *logs)

    def _say(self, topic: str, *messages: Any) -> None:
        publisher = self._robot.create_publisher(type(messages[0]), topic, LATCHED)

        def say() -> None:
            for message in messages:
                publisher.publish(message)

        self._robot.create_timer(0.5, say)


def refuse(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
    """Reject a request."""
    response.message = 'The hoist is broken.'
    return response


def obstacles_in_themes(tab: Any) -> list[str]:
    """Return what is wrong with a page in the light theme, and in the dark one."""
    found: list[str] = []
    for theme in ('light', 'dark'):
        tab.emulate_media(color_scheme=theme)
        tab.locator(f'html[data-theme={theme}]').wait_for()
        found += obstacles(tab)
    return found


def test_pages(world: LiveWorld, open_tab: Any) -> None:
    """Names, roles, contrast and focus are right in each page with what it has to show."""
    Talker(world)
    SliderNode(world)
    tab = open_tab(400, 600)
    found: list[str] = []
    for name, (before, clicked, after) in PAGES.items():
        tab.goto(f'http://127.0.0.1:{world.page.port}/{name}')
        world.wait_until(tab.locator(before).first.is_visible, f'{name}: no {before}')
        world.wait_until(tab.locator(clicked).first.is_enabled, f'{name}: {clicked} is disabled')
        tab.locator(clicked).first.click()
        world.wait_until(tab.locator(after).first.is_visible, f'{name}: no {after}')
        found += obstacles_in_themes(tab)
    tab.goto(f'http://127.0.0.1:{world.page.port}/parameters')
    node = tab.locator('#node')
    world.wait_until(lambda: '/robot1/robot' in (node.text_content() or ''), 'no node')
    node.select_option('/robot1/robot')
    world.wait_until(tab.locator('#list .item').first.is_visible, 'no parameters')
    found += obstacles_in_themes(tab)
    assert found == []


def test_sign_in(open_tab: Any) -> None:
    """The page that asks for the token is like the others."""
    tab = open_tab(400, 600)
    with Page('test', PageSettings()) as page:
        tab.goto(f'http://127.0.0.1:{page.port}/')
        tab.get_by_role('textbox', name='Token').wait_for()
        for theme in ('light', 'dark'):
            tab.emulate_media(color_scheme=theme)
            assert obstacles(tab) == []
