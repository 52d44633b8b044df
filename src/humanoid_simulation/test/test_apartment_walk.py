# SPDX-License-Identifier: Apache-2.0
"""The robot walks through a door of the apartment; `story_apartment_walk.py` has the others."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_simulation.scene import load_scene
from humanoid_simulation.testing.lockstep_robot import (
    distance_m,
    LockstepRobot,
    NEAR_M,
    ROUTES,
    steer,
    walk,
)
from humanoid_simulation.testing.simulators import simulated_robot
import pytest

pytestmark = pytest.mark.timeout(600)


def test_the_hall_is_entered_by_its_door() -> None:
    """From the corridor, without touching a frame."""
    scene = load_scene('apartment')
    robot = LockstepRobot(scene=scene)
    assert robot.wait(1.0)
    walk(robot, ROUTES['hall'])
    position_m = robot.pose.position_m
    assert scene.room_at(position_m.real, position_m.imag).name == 'hall'


def test_it_walks_into_the_kitchen_by_cmd_vel() -> None:
    """Driven over ROS, as anybody would drive it."""
    with simulated_robot(scene='apartment') as robot:

        def follows(goal_m: tuple[float, float]) -> Callable[[], bool]:
            def there() -> bool:
                forward, turn = steer(robot.pose, goal_m)
                robot.drive(forward, turn=turn)
                return distance_m(robot.pose, goal_m) < NEAR_M

            return there

        for goal_m in ROUTES['kitchen']:
            assert robot.wait_until(follows(goal_m), 40.0), f'it is at {robot.pose}'
        robot.drive()
        assert robot.wait_until(lambda: robot.topics.walking_state == 'stand', 10.0)
        position_m = robot.pose.position_m
        room = load_scene('apartment').room_at(position_m.real, position_m.imag)
        assert room is not None and room.name == 'kitchen'
