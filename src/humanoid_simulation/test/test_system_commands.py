# SPDX-License-Identifier: Apache-2.0
"""Check by its topics what the robot does with commands, good and bad, and with none."""

from __future__ import annotations

from collections.abc import Iterator
import math

from humanoid_simulation.testing.simulators import FellError, RobotClient, simulated_robot
import pytest
from std_msgs.msg import Bool

pytestmark = pytest.mark.timeout(600)

STANDS = 'stand'


@pytest.fixture(scope='module')
def simulation() -> Iterator[RobotClient]:
    """Run a simulator."""
    with simulated_robot() as robot:
        yield robot


@pytest.fixture
def robot(simulation: RobotClient) -> Iterator[RobotClient]:
    """Give a robot that stands where it began, and that nobody commands."""
    simulation.reset()
    simulation.topics.drive(None)
    yield simulation
    simulation.topics.joint_commands = {}


def comes_to_rest(robot: RobotClient) -> bool:
    """Tell whether it stands within a few seconds."""
    return robot.wait_until(lambda: robot.topics.walking_state == STANDS, 10.0)


def test_without_a_velocity_it_stops(robot: RobotClient) -> None:
    """Whoever drives and falls silent does not let it walk on."""
    robot.drive(0.25)
    robot.wait(3.0)
    assert robot.topics.walking_state == 'walk'
    robot.topics.drive(None)
    assert comes_to_rest(robot)


def test_a_stop_ends_the_walk(robot: RobotClient) -> None:
    """The velocity goes on to come, but it stands until it is released."""
    robot.drive(0.25)
    robot.wait(3.0)
    robot.topics.emergency_stop.publish(Bool(data=True))
    assert comes_to_rest(robot)
    robot.wait(1.0)
    assert robot.topics.walking_state == STANDS
    robot.topics.emergency_stop.publish(Bool(data=False))
    assert robot.wait_until(lambda: robot.topics.walking_state == 'walk', 10.0)


def test_arms_move_while_it_walks(robot: RobotClient) -> None:
    """The walk leaves them to it, and goes on."""
    begin = robot.pose
    robot.topics.joint_commands = {'left_elbow': -1.2, 'right_elbow': -0.9}
    robot.drive(0.2)
    assert robot.wait_until(lambda: begin.local(robot.pose.position_m).real > 0.3, 20.0)
    assert robot.topics.positions_rad['left_elbow'] == pytest.approx(-1.2, abs=0.1)
    assert robot.topics.positions_rad['right_elbow'] == pytest.approx(-0.9, abs=0.1)


@pytest.mark.parametrize('command', [{'left_knee': 1.5}, {'left_elbow': math.nan}, {'wing': 1.0}])
def test_bad_joint_commands_harm_nothing(robot: RobotClient, command: dict[str, float]) -> None:
    """Joints of the walk, numbers that are none, and joints that are none."""
    before = robot.topics.positions_rad
    robot.topics.joint_commands = command
    robot.wait(2.0)
    after = robot.topics.positions_rad
    assert after.keys() == before.keys()
    assert max(abs(after[name] - before[name]) for name in before) < 0.05


def test_a_robot_that_fell_is_helped_up(robot: RobotClient) -> None:
    """It stands again, and walks."""
    with pytest.raises(FellError):
        robot.push('left', 60.0)
        robot.wait(5.0)
    robot.stand_up()
    begin = robot.pose
    robot.drive(0.2)
    robot.wait(4.0)
    assert abs(robot.pose.position_m - begin.position_m) > 0.3
