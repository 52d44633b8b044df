# SPDX-License-Identifier: Apache-2.0
"""Check by its topics that the robot stands, walks and bears pushes; one simulator serves all."""

from __future__ import annotations

from collections.abc import Iterator
import math

from humanoid_control.walking.planar import PlanarPose
from humanoid_description.rotations import wrap_angle
from humanoid_simulation.examples.push_series import DIRECTIONS
from humanoid_simulation.testing.simulators import RobotClient, simulated_robot
import pytest

pytestmark = pytest.mark.timeout(600)
PUSHES = [
    pytest.param(each, marks=() if each == 'left' else pytest.mark.story) for each in DIRECTIONS
]


@pytest.fixture(scope='module')
def simulation() -> Iterator[RobotClient]:
    """Run a simulator."""
    with simulated_robot() as robot:
        yield robot


@pytest.fixture
def robot(simulation: RobotClient) -> RobotClient:
    """Give a robot that stands where it began."""
    simulation.reset()
    return simulation


@pytest.mark.story
def test_it_stands(robot: RobotClient) -> None:
    """Nobody drives it, and it stays where it is; `story_standing.py` waits for a minute."""
    begin = robot.pose
    robot.topics.drive(None)
    robot.wait(10.0)
    assert abs(robot.pose.position_m - begin.position_m) < 0.02
    assert abs(wrap_angle(robot.pose.yaw_rad - begin.yaw_rad)) < 0.02


def test_it_walks_straight(robot: RobotClient) -> None:
    """Three metres at 0.25 m/s, on a line."""
    begin = robot.pose
    robot.drive(0.25)
    assert robot.wait_until(lambda: begin.local(robot.pose.position_m).real > 3.0, 15.0)
    assert abs(begin.local(robot.pose.position_m).imag) < 0.15


def test_it_turns_by_its_odometry(robot: RobotClient) -> None:
    """A quarter turn, to which it needs no ground truth."""
    begin, believed = robot.pose, robot.topics.odometry

    def left_rad() -> float:
        """Return by how much more it believes that it has to turn."""
        return math.pi / 2 - wrap_angle(robot.topics.odometry.yaw_rad - believed.yaw_rad)

    robot.drive(turn=0.4)
    assert robot.wait_until(lambda: left_rad() < 0.4, 8.0)
    robot.drive(turn=0.15)
    assert robot.wait_until(lambda: left_rad() < 0.05, 8.0)
    robot.drive()
    robot.wait(3.0)
    assert wrap_angle(robot.pose.yaw_rad - begin.yaw_rad) == pytest.approx(math.pi / 2, abs=0.15)


def test_it_stands_and_walks_where_it_was_put(robot: RobotClient) -> None:
    """Turned round, too, while it walked; and it goes on from there."""
    robot.drive(0.25)
    robot.wait(1.5)
    there = PlanarPose(2.0 + 1.0j, robot.pose.yaw_rad + 2.5)
    robot.put(there)
    assert abs(robot.pose.position_m - there.position_m) < 0.1
    assert abs(wrap_angle(robot.pose.yaw_rad - there.yaw_rad)) < 0.1
    begin = robot.pose
    robot.drive(0.25)
    assert robot.wait_until(lambda: begin.local(robot.pose.position_m).real > 0.5, 8.0)


@pytest.mark.story
def test_it_steps_sideways(robot: RobotClient) -> None:
    """Half a metre to the left, without turning."""
    begin = robot.pose
    robot.drive(left=0.1)
    assert robot.wait_until(lambda: begin.local(robot.pose.position_m).imag > 0.45, 8.0)
    robot.drive()
    robot.wait(3.0)
    assert begin.local(robot.pose.position_m) == pytest.approx(0.5j, abs=0.1)
    assert abs(wrap_angle(robot.pose.yaw_rad - begin.yaw_rad)) < 0.1


@pytest.mark.story
def test_it_stops_within_three_seconds(robot: RobotClient) -> None:
    """From walking to standing still."""
    robot.drive(0.25)
    robot.wait(4.0)
    robot.drive()
    robot.wait(3.0)
    stopped = robot.pose
    robot.wait(2.0)
    assert abs(robot.pose.position_m - stopped.position_m) < 0.02


@pytest.mark.parametrize('direction', PUSHES)
def test_it_bears_a_push_standing(robot: RobotClient, direction: str) -> None:
    """15 N s at the base."""
    robot.push(direction, 15.0)
    robot.wait(4.0)


@pytest.mark.parametrize('direction', PUSHES)
def test_it_bears_a_push_walking(robot: RobotClient, direction: str) -> None:
    """10 N s at the base, whatever foot it is on; then it goes on walking."""
    robot.drive(0.2)
    robot.wait(3.0)
    robot.push(direction, 10.0)
    robot.wait(3.0)
    begin = robot.pose
    robot.wait(2.0)
    assert begin.local(robot.pose.position_m).real > 0.2


def test_a_reset_while_it_walks(robot: RobotClient) -> None:
    """It is back at the start, stands, time has gone on, and it walks again."""
    robot.drive(0.25)
    robot.wait(3.1)
    walked = abs(robot.pose.position_m)
    robot.reset()
    assert walked > 0.3
    assert abs(robot.pose.position_m) < 0.05
    assert not robot.topics.went_back
    robot.drive(0.25)
    robot.wait(4.0)
    assert abs(robot.pose.position_m) > 0.5


def test_a_paused_robot_walks_only_by_steps(robot: RobotClient) -> None:
    """Time passes as many steps as are asked for, and no more."""
    robot.pause()
    before_s = robot.topics.time_s
    robot.step(500)
    robot.pause(False)
    robot.wait(0.1)
    assert robot.topics.time_s >= before_s + 1.0
