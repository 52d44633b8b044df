# SPDX-License-Identifier: Apache-2.0
"""The robot stands for a minute: `make stories`."""

from __future__ import annotations

from humanoid_description.rotations import wrap_angle
from humanoid_simulation.testing.simulators import simulated_robot


def test_it_stands_for_a_minute() -> None:
    """Nobody drives it, and it stays where it is."""
    with simulated_robot() as robot:
        begin = robot.pose
        robot.topics.drive(None)
        robot.wait(60.0)
        assert abs(robot.pose.position_m - begin.position_m) < 0.02
        assert abs(wrap_angle(robot.pose.yaw_rad - begin.yaw_rad)) < 0.02
