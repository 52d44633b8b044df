# SPDX-License-Identifier: Apache-2.0
"""Check the helper of the system tests, with a stand-in for the simulator."""

from __future__ import annotations

from collections.abc import Iterator

from humanoid_common.testing.ros import ros_sandbox
from humanoid_simulation.testing.fake_simulator import FakeSimulator, START
from humanoid_simulation.testing.simulators import FellError, RobotClient
import pytest


@pytest.fixture
def robot() -> Iterator[RobotClient]:
    """Give a robot that goes exactly as it is told."""
    with ros_sandbox() as ros:
        ros.start(FakeSimulator)
        yield RobotClient(ros)


def test_it_is_driven_in_simulated_time(robot: RobotClient) -> None:
    """A second of its time at 1 m/s is a metre, however fast that time runs."""
    begin = robot.pose
    robot.drive(1.0)
    assert robot.wait_until(lambda: abs(robot.pose.position_m - begin.position_m) > 1.0, 5.0)
    robot.drive()
    robot.wait(1.0)
    end = robot.pose
    robot.wait(1.0)
    assert robot.pose == end


def test_what_does_not_come_true_in_time_is_told(robot: RobotClient) -> None:
    """The answer is false, after the time that was given."""
    begin_s = robot.topics.time_s
    assert not robot.wait_until(lambda: False, 1.0)
    assert robot.topics.time_s - begin_s == pytest.approx(1.0, abs=0.2)


def test_a_fall_fails_the_test(robot: RobotClient) -> None:
    """Whatever one waits for, a fall ends it, and a reset makes it good again."""
    robot.drive(0.2)
    robot.push('left', 10.0)
    robot.wait(1.0)
    robot.push('left', 15.0)
    with pytest.raises(FellError, match=r'its base is at 0.10 m .* its state is .stand.'):
        robot.wait(1.0)
    robot.reset()
    assert robot.stands
    assert robot.pose == START


def test_steps_while_paused(robot: RobotClient) -> None:
    """Time stands still but for the steps."""
    robot.pause()
    robot.step(500)
    robot.pause(False)
    begin_s = robot.topics.time_s
    robot.wait(0.2)
    assert robot.topics.time_s > begin_s
