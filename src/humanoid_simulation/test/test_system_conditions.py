# SPDX-License-Identifier: Apache-2.0
"""Check by its topics that the robot walks with late sensors, each time the same, and for two."""

from __future__ import annotations

from humanoid_control.walking import PlanarPose
from humanoid_simulation.testing.simulators import RobotClient, simulated_robot, simulation
import pytest

pytestmark = pytest.mark.timeout(600)

STEP_S = 0.002
STEPS = 200
"""In a call: within them no velocity times out."""
CALLS = 8


@pytest.mark.story
def test_ten_milliseconds_of_latency() -> None:
    """It walks, turns and stops."""
    with simulated_robot(latency_periods='1') as robot:
        begin = robot.pose
        robot.drive(0.25)
        assert robot.wait_until(lambda: begin.local(robot.pose.position_m).real > 0.8, 8.0)
        robot.drive(0.1, turn=0.4)
        robot.wait(3.0)
        robot.drive()
        robot.wait(3.0)
        stopped = robot.pose
        robot.wait(1.0)
        assert abs(robot.pose.position_m - stopped.position_m) < 0.02


def end_of_walk() -> PlanarPose:
    """Walk for some steps from the very beginning; return where that ended."""
    conditions = {'start_paused': 'true', 'sensor_noise': '1.0', 'seed': '7'}
    with simulated_robot(ground_truth_rate_hz='100.0', **conditions) as robot:
        robot.drive(0.25, turn=0.2)
        for _ in range(CALLS):
            robot.step_commanded(STEPS)
        robot.hear_of(CALLS * STEPS * STEP_S)
        return robot.pose


@pytest.mark.story
def test_the_same_seed_is_the_same_walk() -> None:
    """Two simulators that are stepped alike lead the robot to the same place, bit for bit."""
    first = end_of_walk()
    assert abs(first.position_m) > 0.2
    assert end_of_walk() == first


def test_two_robots_walk_each_for_itself() -> None:
    """What one of them is told is nothing to the other."""
    with simulation(robots='[robot1, robot2]') as ros:
        first, second = (RobotClient(ros, name) for name in ('robot1', 'robot2'))
        places = first.pose, second.pose
        first.drive()
        second.drive(0.25)
        assert second.wait_until(lambda: places[1].local(second.pose.position_m).real > 0.8, 8.0)
        assert first.stands
        assert abs(first.pose.position_m - places[0].position_m) < 0.05
        second.drive()
        first.push('forward', 10.0)
        first.wait(3.0)
