# SPDX-License-Identifier: Apache-2.0
"""What one can do to the world, and what it tells."""

from __future__ import annotations

from humanoid_description.rotations import quaternion_from_rpy
from humanoid_simulation.backend import BackendSettings, EntityState, MujocoBackend
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model import Physics, Placement
from humanoid_simulation.scene import Scene, Thing
import numpy as np
import pytest

BALL = Thing('ball', 'sphere', (0.1,), (2.0, 0.0, 0.1), mass_kg=2.0)
WALL = Thing('wall', 'box', (0.1, 2.0, 1.0), (3.0, 0.0, 0.5))
SCENE = Scene('test', things=(BALL, WALL))
LEVEL = quaternion_from_rpy(0.0, 0.0, 0.0)


@pytest.fixture
def world(make_backend) -> MujocoBackend:
    """Return a world with a ball and a wall."""
    return make_backend(scene=SCENE)


def run(backend: MujocoBackend, seconds: float) -> None:
    """Let time pass."""
    for _ in range(round(seconds / backend.period_s)):
        backend.step({})


@pytest.mark.parametrize('duration_s', [0.1, 0.01, 0.003, 0.0251])
def test_a_wrench_has_the_impulse_that_was_asked_for(world, duration_s: float) -> None:
    """However long it lasts, even if that is no whole number of periods."""
    aloft = EntityState(np.array([0.0, 0.0, 50.0]), LEVEL)
    world.set_entity_state('ball', aloft)
    world.apply_wrench('ball', (3.0 / duration_s, 0.0, 0.0), duration_s=duration_s)
    run(world, 0.2)
    velocity = world.entity_state('ball').linear_velocity_m_s
    assert velocity[0] == pytest.approx(3.0 / 2.0, rel=1e-6)


def test_a_wrench_beside_the_centre_turns_the_body(world: MujocoBackend) -> None:
    """A force forwards on the left side turns to the right."""
    world.set_entity_state('ball', EntityState(np.array([0.0, 0.0, 50.0]), LEVEL))
    world.apply_wrench('ball', (10.0, 0.0, 0.0), duration_s=0.05, point_m=(0.0, 0.1, 0.0))
    run(world, 0.05)
    rate = world.entity_state('ball').angular_velocity_rad_s
    inertia = 0.4 * 2.0 * 0.1**2
    assert rate[2] == pytest.approx(-10.0 * 0.1 * 0.05 / inertia, rel=0.01)


def test_two_wrenches_add_up_and_a_reset_ends_them(world: MujocoBackend) -> None:
    """Both act at once; after a reset none does."""
    world.apply_wrench('ball', (10.0, 0.0, 0.0), duration_s=10.0)
    world.apply_wrench('ball', (-10.0, 0.0, 0.0), duration_s=10.0)
    run(world, 0.2)
    assert world.entity_state('ball').position_m[0] == pytest.approx(2.0, abs=1e-6)
    world.apply_wrench('ball', (10.0, 0.0, 0.0), duration_s=10.0)
    world.reset()
    run(world, 0.2)
    assert world.entity_state('ball').position_m[0] == pytest.approx(2.0, abs=1e-6)


@pytest.mark.parametrize(
    ('body', 'options', 'sentence'),
    [
        ('tors', {'force_n': (1.0, 0.0, 0.0)}, "Did you mean 'torso'"),
        ('torso', {'force_n': (float('nan'), 0.0, 0.0)}, 'three finite numbers'),
        ('torso', {'force_n': (1.0, 0.0)}, 'three finite numbers'),
        ('torso', {'force_n': (1.0, 0.0, 0.0), 'duration_s': 0.0}, 'above zero'),
    ],
)
def test_wrenches_that_are_refused(world, body: str, options, sentence: str) -> None:
    """The error says what to give, and nothing is pushed."""
    with pytest.raises(SimulationError) as caught:
        world.apply_wrench(body, **options)
    assert sentence in str(caught.value)


def test_an_entity_goes_where_it_is_put(world: MujocoBackend) -> None:
    """Position, orientation and velocities are those that were set, in the world."""
    wanted = EntityState(
        np.array([1.0, 2.0, 3.0]),
        quaternion_from_rpy(0.1, 0.2, 0.3),
        np.array([0.4, 0.5, 0.6]),
        np.array([0.7, 0.8, 0.9]),
    )
    for entity in ('ball', 'robot'):
        world.set_entity_state(entity, wanted)
        found = world.entity_state(entity)
        for part in ('position_m', 'orientation', 'linear_velocity_m_s', 'angular_velocity_rad_s'):
            assert getattr(found, part) == pytest.approx(getattr(wanted, part), abs=1e-9)
    assert world.entities == ('robot', 'ball', 'wall')


def test_a_robot_that_is_put_somewhere_moves_as_one_body(world: MujocoBackend) -> None:
    """Its joints rest, whatever they did before, and keep their positions."""
    world.apply_wrench('torso', (300.0, 100.0, 0.0), duration_s=0.2)
    run(world, 0.2)
    before = world.observe()['']
    assert np.abs(before.velocities_rad_s).max() > 0.1
    world.set_entity_state('robot', EntityState(np.array([1.0, 2.0, 3.0]), LEVEL))
    after = world.observe()['']
    assert after.velocities_rad_s == pytest.approx(np.zeros(len(after.velocities_rad_s)), abs=1e-2)
    assert after.positions_rad == pytest.approx(before.positions_rad, abs=1e-2)


@pytest.mark.parametrize(
    ('entity', 'position', 'orientation', 'sentence'),
    [
        ('bal', (0, 0, 1), LEVEL, "Did you mean 'ball'"),
        ('wall', (0, 0, 1), LEVEL, "no movable entity 'wall'"),
        ('ball', (0, 0, float('nan')), LEVEL, 'must be 3 finite numbers'),
        ('ball', (0, 0, 1), np.zeros(4), 'is not a rotation'),
    ],
)
def test_states_that_are_refused(world, entity: str, position, orientation, sentence) -> None:
    """The error says what is wrong, and nothing is moved."""
    with pytest.raises(SimulationError) as caught:
        state = EntityState(np.array(position, dtype=float), orientation)
        world.set_entity_state(entity, state)
    assert sentence in str(caught.value)
    assert world.entity_state('ball').position_m == pytest.approx(BALL.position_m)


def test_contacts_say_who_carries_whom(make_backend) -> None:
    """The floor carries the robot and the ball: normals point up, forces are their weights."""
    settings = BackendSettings(Physics(sleep=False))
    world = make_backend(scene=SCENE, settings=settings)
    run(world, 2.0)
    carried: dict[str, float] = {}
    for contact in world.contacts():
        assert contact.body1 == 'floor'
        assert contact.normal == pytest.approx([0.0, 0.0, 1.0])
        assert abs(contact.position_m[2]) < 1e-3
        carried[contact.body2] = carried.get(contact.body2, 0.0) + contact.force_n[2]
    assert set(carried) == {'left_foot', 'right_foot', 'ball'}
    assert carried['ball'] == pytest.approx(2.0 * 9.81, rel=0.01)
    assert carried['left_foot'] + carried['right_foot'] == pytest.approx(42.8 * 9.81, rel=0.01)


def test_a_ball_that_is_thrown_hits_the_robot(world: MujocoBackend) -> None:
    """Things and robots collide, and the robot is pushed."""
    thrown = EntityState(np.array([0.8, 0.0, 0.9]), LEVEL, np.array([-4.0, 0.0, 0.5]))
    world.set_entity_state('ball', thrown)
    hits = set()
    for _ in range(40):
        world.step({})
        hits |= {c.body2 for c in world.contacts() if c.body1 == 'ball'}
        hits |= {c.body1 for c in world.contacts() if c.body2 == 'ball'}
    assert 'torso' in hits
    assert world.ground_truth().linear_velocity_m_s[0] < -0.01


def test_a_snapshot_is_a_copy(world: MujocoBackend) -> None:
    """It tells of its moment, even when time has gone on."""
    before = world.snapshot()
    copy = before.qpos.copy()
    world.apply_wrench('ball', (0.0, 20.0, 0.0))
    run(world, 0.5)
    assert (before.qpos == copy).all()
    assert before.time_s == 0.0
    assert not (world.snapshot().qpos == copy).all()


def test_the_camera_of_a_robot_is_in_the_model(world: MujocoBackend) -> None:
    """Its name leads to it."""
    assert world.model.camera(world.camera()).fovy[0] == 60.0


def test_bodies_are_found_by_entity_and_link(world: MujocoBackend) -> None:
    """An empty entity is the robot alone, an empty link its base; a thing is its own body."""
    assert world.body('') == world.body('robot') == 'base_link'
    assert world.body('', 'torso') == 'torso'
    assert world.body('ball') == 'ball'
    with pytest.raises(SimulationError, match="Did you mean 'ball'"):
        world.body('bal')


def test_the_links_of_a_robot_are_its_own(make_backend) -> None:
    """Those of the other robot and things are not among them."""
    backend = make_backend(scene=SCENE, placements=[Placement('a'), Placement('b', y_m=1.0)])
    links = backend.links('b')
    assert 'b/base_link' in links
    assert 'b/left_foot' in links
    assert all(link.startswith('b/') for link in links)
    assert backend.body('b', 'torso') == 'b/torso'
    assert backend.body('b') == 'b/base_link'
