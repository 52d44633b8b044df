# SPDX-License-Identifier: Apache-2.0
"""A world whose things come and go while the robot walks."""

from __future__ import annotations

from dataclasses import replace

from humanoid_description.rotations import quaternion_from_rpy
from humanoid_simulation.backend import EntityState, MujocoBackend
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene import load_scene, Scene, Thing
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np
import pytest

BALL = Thing('ball', 'sphere', (0.1,), (2.0, 0.0, 0.1), mass_kg=2.0)
WALL = Thing('wall', 'box', (0.1, 2.0, 1.0), (3.0, 0.0, 0.5))
BOX = Thing('box', 'box', (0.2, 0.2, 0.2), (0.0, 2.0, 0.1), mass_kg=1.0)
SCENE = Scene('test', things=(BALL, WALL))
LEVEL = quaternion_from_rpy(0.0, 0.0, 0.0)


@pytest.fixture(name='world')
def _world(make_backend) -> MujocoBackend:
    """Return a world with a ball and a wall."""
    return make_backend(scene=SCENE)


def test_what_stays_goes_on_as_it_was(world: MujocoBackend) -> None:
    """A new thing is at home; positions and velocities of all others are what they were."""
    thrown = EntityState(np.array([0.0, 1.0, 5.0]), LEVEL, np.array([0.0, 0.0, 2.0]))
    world.set_entity_state('ball', thrown)
    for _ in range(5):
        world.step({})
    before = {name: world.entity_state(name) for name in ('robot', 'ball')}
    world.change_scene(replace(SCENE, things=(BOX, WALL, BALL)))
    for name, state in before.items():
        now = world.entity_state(name)
        assert np.array_equal(now.position_m, state.position_m)
        assert np.array_equal(now.linear_velocity_m_s, state.linear_velocity_m_s)
        assert np.array_equal(now.angular_velocity_rad_s, state.angular_velocity_rad_s)
    assert world.entity_state('box').position_m == pytest.approx(BOX.position_m)
    assert set(world.entities) == {'robot', 'box', 'wall', 'ball'}
    world.change_scene(replace(SCENE, things=(BALL,)))
    assert set(world.entities) == {'robot', 'ball'}


def test_pushes_go_on_with_what_they_push(world: MujocoBackend) -> None:
    """The numbers of bodies change; the impulse that a body gets does not."""
    world.set_entity_state('ball', EntityState(np.array([0.0, 1.0, 50.0]), LEVEL))
    world.apply_wrench('ball', (30.0, 0.0, 0.0), duration_s=0.1)
    world.step({})
    world.change_scene(replace(SCENE, things=(BOX, BALL)))
    for _ in range(20):
        world.step({})
    assert world.entity_state('ball').linear_velocity_m_s[0] == pytest.approx(1.5, rel=1e-6)
    world.apply_wrench('ball', (30.0, 0.0, 0.0), duration_s=0.1)
    world.change_scene(replace(SCENE, things=(BOX,)))
    world.step({})
    assert np.abs(world.data.xfrc_applied).max() == 0.0


def test_a_scene_that_cannot_be_changes_nothing(world: MujocoBackend) -> None:
    """A name that is taken is refused, and the world goes on."""
    with pytest.raises(SimulationError, match="an object named 'robot'"):
        world.change_scene(Scene('bad', things=(replace(BOX, name='robot'),)))
    assert world.scene is SCENE
    world.step({})


def test_a_robot_walks_through_changes() -> None:
    """Things come and go around it; it does not notice."""
    robot = LockstepRobot()
    assert robot.stands
    robot.drive(0.3)
    for name in ('apartment', 'flat', 'room', 'flat'):
        assert robot.wait(1.0)
        robot.backend.change_scene(load_scene(name))
    assert robot.wait(1.0)
    assert robot.truth.position_m[0] > 0.5
