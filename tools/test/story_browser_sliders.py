# SPDX-License-Identifier: Apache-2.0
"""Move joints with sliders in the browser, and see them move in the same page."""

from __future__ import annotations

from collections.abc import Iterator
import math

from browser import Browser, browser_started
from browser_world import STRAINED, url_of, World, world
from programs import wait_until
import pytest
from ros_side import expected_place
from sensor_msgs.msg import JointState

NODES = {
    'humanoid_joint_controller',
    'joint_state_publisher',
    'robot_state_publisher',
    'rviz2',
}


@pytest.fixture
def browser() -> Iterator[Browser]:
    """Start a browser."""
    with browser_started() as browser:
        yield browser


@pytest.fixture
def shown(tmp_path_factory: pytest.TempPathFactory, browser: Browser) -> Iterator[World]:
    """Start what shows the humanoid with sliders."""
    with world(tmp_path_factory.mktemp('sliders')) as made:
        made.launch('humanoid_control', 'robot_visualization.launch.py')
        yield made


def test_a_slider_moves_the_robot(shown: World, browser: Browser) -> None:
    """All nodes are there; a slider changes the state of its joint, and the link in RViz."""
    program = shown.programs[0]
    rviz = browser.open(url_of(program))
    rviz.wait_for_link('neck')
    wait_until(lambda: shown.ros.nodes() >= NODES, 60.0, lambda: f'nodes: {shown.ros.nodes()}')
    states = shown.ros.listen(JointState, '/joint_states')
    slider = rviz.small('sliders').get_by_role('spinbutton', name='head_yaw')
    slider.fill('0.5')
    slider.press('Enter')

    def state() -> float:
        return states[-1].position[states[-1].name.index('head_yaw')] if states else math.nan

    wait_until(lambda: state() == pytest.approx(0.5, abs=0.01), 30.0, lambda: f'not {state()}')
    expected = expected_place(shown.ros.model(), 'head_yaw', state())
    wait_until(lambda: rviz.place('neck').is_near(expected), 100.0, 'the neck to turn')
    rviz.picture('sliders')
    assert (rviz.elsewhere, rviz.failures) == ([], [])
    assert 'The sliders are at' not in program.output
    assert program.end() == 0
    assert shown.complaints() == []
    assert STRAINED not in program.output
