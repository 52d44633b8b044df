# SPDX-License-Identifier: Apache-2.0
"""Drive and watch the humanoid in a browser, as a person does."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from browser import Browser, browser_started, Tab
from browser_world import pid_of, urls, World, world
from programs import wait_until
import pytest
from ros_side import expected_place, LATCHED
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

ELBOW, FOREARM = 'left_elbow', 'left_forearm'


@pytest.fixture(scope='module')
def browser() -> Iterator[Browser]:
    """Start a browser."""
    with browser_started() as browser:
        yield browser


@pytest.fixture(scope='module')
def robot(tmp_path_factory: pytest.TempPathFactory, browser: Browser) -> Iterator[World]:
    """Start the humanoid."""
    with world(tmp_path_factory.mktemp('console')) as made:
        made.launch('humanoid_bringup', 'bringup.launch.py')
        yield made


@pytest.fixture(scope='module')
def tab(robot: World, browser: Browser) -> Tab:
    """Open the page that the humanoid has printed."""
    tab = browser.open(urls(robot.programs[0])[0])
    tab.wait_for_link(FOREARM)
    return tab


def state_of(robot: World, joint: str) -> float:
    """Return where a joint is."""
    newest = robot.ros.listen(JointState, '/joint_states')[-1]
    return newest.position[newest.name.index(joint)]


def wait_for_motion(tab: Tab) -> None:
    """Wait until the forearm moves in the scene."""
    at = tab.place(FOREARM)
    wait_until(lambda: not tab.place(FOREARM).is_near(at, 0.02), 30.0, 'the forearm to move')


def commands(robot: World) -> list[Any]:
    """Return the positions that the joints were told to be at."""
    return [each.position for each in robot.ros.listen(JointState, '/joint_commands')]


def is_stopped(robot: World) -> bool:
    """Tell whether the last commands are all the same."""
    last = commands(robot)[-10:]
    return len(last) == 10 and all(each == last[0] for each in last)


def press_stop(robot: World, tab: Tab) -> None:
    """Stop the robot, and wait until it stands still."""
    heard = robot.ros.listen(Bool, '/emergency_stop', LATCHED)
    tab.small('safety').locator('#stop').click()
    wait_until(lambda: heard and heard[-1].data, 30.0, 'the emergency stop')
    wait_until(lambda: is_stopped(robot), 30.0, 'the commands to hold still')


def release(robot: World, tab: Tab) -> None:
    """Let the robot move on."""
    heard = robot.ros.listen(Bool, '/emergency_stop', LATCHED)
    for words in ('Release', 'Release? It may move at once. Click again'):
        tab.small('safety').get_by_role('button', name=words, exact=True).click()
    wait_until(lambda: not heard[-1].data, 30.0, 'the release')
    wait_until(lambda: not is_stopped(robot), 30.0, 'other commands')


def test_the_robot_is_shown_where_it_is(robot: World, tab: Tab) -> None:
    """It moves; stopped, its forearm is where the URDF says for the state of the joint."""
    model = robot.ros.model()
    robot.ros.first(JointState, '/joint_states')
    robot.ros.first(JointState, '/joint_commands')
    wait_for_motion(tab)
    press_stop(robot, tab)

    def is_right() -> bool:
        return tab.place(FOREARM).is_near(expected_place(model, ELBOW, state_of(robot, ELBOW)))

    wait_until(is_right, 30.0, lambda: f'{tab.place(FOREARM)} for {state_of(robot, ELBOW)}')
    tab.small('safety').locator('#robot').filter(has_text='holds still').wait_for()
    tab.picture('console_stopped')
    seen, told = tab.place(FOREARM), len(commands(robot))
    wait_until(lambda: len(commands(robot)) > told + 50, 30.0, 'more commands')
    assert tab.place(FOREARM) == seen
    release(robot, tab)
    wait_for_motion(tab)
    tab.picture('console_moving')


def test_nothing_is_loaded_from_elsewhere(robot: World, tab: Tab) -> None:
    """All that the page asks for, it asks the robot's side for; no script fails."""
    tab.small('safety').locator('#link').filter(has_text='connected').wait_for()
    assert any(each.startswith('ws://') for each in tab.requests)
    assert tab.elsewhere == []
    assert tab.failures == []


def test_all_programs_live_and_end_in_order(robot: World, tab: Tab) -> None:
    """Nothing has complained; all end with status 0, while the page is open."""
    program = robot.programs[0]
    assert pid_of(program, 'rviz2') in program.members()
    assert program.end() == 0
    assert robot.complaints() == []
