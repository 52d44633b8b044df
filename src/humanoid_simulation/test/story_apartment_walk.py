# SPDX-License-Identifier: Apache-2.0
"""The robot walks through every door of the apartment: `make stories`."""

from __future__ import annotations

from humanoid_simulation.scene import load_scene
from humanoid_simulation.testing.lockstep_robot import FROM_HALL, LockstepRobot, ROUTES, walk
import pytest

pytestmark = pytest.mark.timeout(600)


@pytest.mark.parametrize('room', ROUTES)
def test_each_room_is_entered_by_its_door(room: str) -> None:
    """From the corridor, without touching a frame."""
    scene = load_scene('apartment')
    robot = LockstepRobot(scene=scene)
    assert robot.wait(1.0)
    walk(robot, ROUTES[room])
    position_m = robot.pose.position_m
    assert scene.room_at(position_m.real, position_m.imag).name == room


def test_the_hall_leads_to_the_living_room() -> None:
    """The other door of both makes a round possible."""
    scene = load_scene('apartment')
    robot = LockstepRobot(scene=scene)
    assert robot.wait(1.0)
    walk(robot, [*ROUTES['hall'], *FROM_HALL])
    position_m = robot.pose.position_m
    assert scene.room_at(position_m.real, position_m.imag).name == 'living_room'
