# SPDX-License-Identifier: Apache-2.0
"""Drive and watch the humanoid in a browser, as a person does."""

from __future__ import annotations

from collections.abc import Iterator
import os
import signal
from typing import Any

from browser import Browser, browser_started, Tab
from browser_world import pid_of, STRAINED, url_of, World, world
from programs import wait_until
import pytest
from ros_side import expected_place, LATCHED
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

ELBOW, FOREARM = 'left_elbow', 'left_forearm'
WITHOUT_PHYSICS = ('backend:=mock', 'when_robot_ends:=stay')


@pytest.fixture(scope='module')
def browser() -> Iterator[Browser]:
    """Start a browser."""
    with browser_started() as browser:
        yield browser


@pytest.fixture(scope='module')
def robot(tmp_path_factory: pytest.TempPathFactory, browser: Browser) -> Iterator[World]:
    """Start the humanoid."""
    with world(tmp_path_factory.mktemp('console')) as made:
        made.launch('humanoid_bringup', 'bringup.launch.py', *WITHOUT_PHYSICS)
        yield made


@pytest.fixture(scope='module')
def tab(robot: World, browser: Browser) -> Tab:
    """Open the page that the humanoid has printed."""
    tab = browser.open(url_of(robot.programs[0]))
    tab.wait_for_link(FOREARM)
    return tab


def state_of(robot: World, joint: str) -> float:
    """Return where a joint is."""
    newest = robot.ros.listen(JointState, '/joint_states')[-1]
    return newest.position[newest.name.index(joint)]


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
    tab.wait_for_motion(FOREARM)
    press_stop(robot, tab)

    def is_right() -> bool:
        return tab.place(FOREARM).is_near(expected_place(model, ELBOW, state_of(robot, ELBOW)))

    wait_until(is_right, 100.0, lambda: f'{tab.place(FOREARM)} for {state_of(robot, ELBOW)}')
    tab.small('safety').locator('#robot').filter(has_text='holds still').wait_for()
    tab.picture('console_stopped')
    seen, told = tab.place(FOREARM), len(commands(robot))
    wait_until(lambda: len(commands(robot)) > told + 50, 30.0, 'more commands')
    assert tab.place(FOREARM).is_near(seen)
    release(robot, tab)
    tab.wait_for_motion(FOREARM)
    tab.picture('console_moving')


def test_the_page_opens_on_drive(tab: Tab) -> None:
    """What a person does first is in front; above it stands what the robot does."""
    tab.page.get_by_role('tab', name='Drive', exact=True, selected=True).wait_for()
    bar = tab.small('robot')
    bar.locator('#words').filter(has_text='Ready').wait_for()
    bar.locator('#why').filter(has_text='No simulator is running').wait_for()
    assert tab.page.title() == 'Humanoid'


def test_a_parameter_is_changed(robot: World, tab: Tab) -> None:
    """A value that is typed in the page is that of the node; a refusal is shown."""
    tab.show('Parameters')
    page = tab.small('parameters')
    page.get_by_label('Node').select_option('/sensor_processor')
    field = page.get_by_label('report_period_s')
    field.fill('0.5')
    field.press('Enter')
    wait_until(lambda: period_s(robot) == 0.5, 30.0, lambda: f'not {period_s(robot)}')
    field.fill('-1')
    field.press('Enter')
    page.locator('.note.bad').filter(has_text='It must be from 0.1').wait_for()
    tab.picture('console_parameters')
    assert period_s(robot) == 0.5


def period_s(robot: World) -> float:
    """Return how often the sensor processor reports, as it says itself."""
    return robot.ros.parameter('/sensor_processor', 'report_period_s').double_value


def test_a_recording_is_made_and_played(robot: World, tab: Tab) -> None:
    """What was recorded from the page moves the robot in the scene when all others are gone."""
    tab.wait_for_motion(FOREARM)
    tab.show('Recordings')
    tab.box('Name').fill('swing')
    tab.button('Record').click()
    tab.page.get_by_text('Recording swing').wait_for()
    wait_until(lambda: is_recorded(robot, '/tf'), 60.0, 'the recorder to find the robot')
    heard = len(commands(robot))
    wait_until(lambda: len(commands(robot)) > heard + 150, 30.0, 'something to record')
    tab.button('Stop recording').click()
    tab.page.get_by_text('Recorded swing').wait_for()
    recording = tab.box('Recording')
    wait_until(lambda: recording.input_value().startswith('swing ('), 30.0, 'it to be offered')
    end_robot(robot)
    tab.tick('Loop')
    tab.button('Play').click()
    tab.page.get_by_text('PLAYING swing', exact=True).wait_for()
    tab.wait_for_motion(FOREARM)
    tab.picture('console_playing')
    tab.button('Stop').click()
    tab.page.get_by_text('PLAYING swing', exact=True).wait_for(state='detached')


def is_recorded(robot: World, topic: str) -> bool:
    """Tell whether the recorder listens to a topic."""
    listening = robot.ros.node.get_subscriptions_info_by_topic(topic)
    return any(each.node_name == 'rosbag2_recorder' for each in listening)


def end_robot(robot: World) -> None:
    """End all but the console."""
    program = robot.programs[0]
    for name in ('joint_controller', 'mock_robot', 'robot_state_publisher'):
        os.kill(pid_of(program, name), signal.SIGINT)
    wait_until(lambda: program.output.count('has finished cleanly') == 3, 30.0, 'their end')


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
    assert STRAINED not in program.output
