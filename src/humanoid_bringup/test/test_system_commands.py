# SPDX-License-Identifier: Apache-2.0
"""Check that the whole robot does what it is told, in its home, and tells the truth."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from humanoid_bringup.testing import ToldRobot
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
from humanoid_simulation.scene import load_scene
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'full_system.launch.py'
STORY = 'go to the kitchen, find the red mug and tell me what stands beside it'

pytestmark = pytest.mark.timeout(600)


@pytest.fixture(scope='module')
def told() -> Iterator[ToldRobot]:
    arguments = ('gui:=false', 'real_time_factor:=0.7')
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, *arguments):
        yield ToldRobot(ros)


def test_it_is_ready_once(told: ToldRobot):
    assert told.said == ['I am ready.']


def test_it_says_what_it_did_not_understand(told: ToldRobot):
    told.tell('fly to the moon')
    told.wait_for('I did not understand "fly to the moon".')


def test_it_goes_looks_and_tells(told: ToldRobot):
    told.tell(STORY)
    told.wait_for('I see the red mug on the kitchen table.')
    told.wait_for('beside the red mug.')
    assert told.room == 'kitchen'
    said = next(each for each in told.said if 'beside the red mug.' in each)
    things = {each.name: each for each in load_scene('apartment').objects}
    mug, neighbour = things['red_mug'], things['blue_mug']
    assert abs(complex(*mug.position_m[:2]) - complex(*neighbour.position_m[:2])) < 0.5
    assert 'blue mug' in said
    told.wait_for_the_end()
    assert told.has_succeeded, told.said


def test_it_stops_at_once(told: ToldRobot):
    robot = told.robot
    begin = robot.pose.position_m
    told.tell('go to the hall')
    assert robot.wait_until(lambda: abs(robot.pose.position_m - begin) > 0.3, 60.0)
    told.tell('stop')
    told.wait_for('I have stopped.')
    robot.wait(2.0)
    place = robot.pose.position_m
    robot.wait(2.0)
    assert abs(robot.pose.position_m - place) < 0.05
    assert robot.stands
