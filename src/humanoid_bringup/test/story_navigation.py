# SPDX-License-Identifier: Apache-2.0
"""The walking robot gets to places, and what stops it ends its goals: `make stories`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
from humanoid_navigation.testing import NavigatingRobot
import pytest
from std_msgs.msg import Bool

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'
KITCHEN = (0.7, 2.6, 1.57)
CORRIDOR = (0.8, 0.0, 0.0)
ACTIVE = 'lifecycle_manager_navigation]: Managed nodes are active'


@pytest.fixture(scope='module')
def robot() -> Iterator[NavigatingRobot]:
    """Give a robot at home, in a world that leaves a busy computer time."""
    arguments = ('scene:=apartment', 'navigation:=true', 'gui:=false', 'real_time_factor:=0.5')
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, *arguments) as program:
        program.wait_for_output(ACTIVE, 120.0)
        yield NavigatingRobot(ros)


def test_into_the_kitchen(robot: NavigatingRobot) -> None:
    """It walks through the door, touches nothing, and truly is where it was to go."""
    arrival = robot.go(*KITCHEN)
    assert arrival.is_reached, arrival
    assert arrival.distance_m < 0.3
    assert not arrival.touched


def test_cancel(robot: NavigatingRobot) -> None:
    """A goal that is canceled leaves the robot standing at once."""
    handle = robot.start(*CORRIDOR)
    assert robot.robot.wait_until(lambda: robot.is_moved, 20.0)
    assert robot.cancel(handle) < 0.2


def test_emergency_stop(robot: NavigatingRobot) -> None:
    """The stop ends the goal with that reason; after the release the next one works."""
    handle = robot.start(*CORRIDOR)
    assert robot.robot.wait_until(lambda: robot.is_moved, 20.0)
    stop = robot.robot.topics.emergency_stop
    stop.publish(Bool(data=True))
    arrival = robot.finish(handle, *CORRIDOR, 20.0)
    assert not arrival.is_reached and 'emergency stop' in arrival.error_msg
    stop.publish(Bool(data=False))
    robot.robot.wait(1.0)
    assert robot.go(*CORRIDOR).is_reached


def test_fall(robot: NavigatingRobot) -> None:
    """A fall ends the goal with that reason; when the robot stands again, the next one works."""
    handle = robot.start(*KITCHEN)
    assert robot.robot.wait_until(lambda: robot.is_moved, 20.0)
    robot.robot.push('back', 70.0)
    arrival = robot.ended(handle, *KITCHEN)
    assert not arrival.is_reached and 'fallen' in arrival.error_msg
    robot.robot.stand_up()
    arrival = robot.go(*CORRIDOR)
    assert arrival.is_reached, arrival
