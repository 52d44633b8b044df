# SPDX-License-Identifier: Apache-2.0
"""Plan ways of an arm around a table, and look at every posture on them."""

from __future__ import annotations

import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.rotations import from_rpy
from humanoid_manipulation.arm_trajectory import timed
from humanoid_manipulation.arm_world import ArmWorld
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.motion_planning import approach, BlockedError, plan
from humanoid_manipulation.obstacle import Obstacle
from humanoid_manipulation.upper_body import OutOfReachError, Reach, UpperBody
import numpy as np
import pytest

URDF = humanoid_urdf(hands=True)
BODY = UpperBody.of(load_robot(URDF, 'the humanoid'))
LEVEL = from_rpy(0.0, -math.pi / 2.0, 0.0)
"""The hand points ahead, and its fingers close sideways."""
HOME = {'left_shoulder_roll': 0.15, 'right_shoulder_roll': -0.15, 'left_elbow': -0.5,
        'right_elbow': -0.5}  # fmt: skip
HANGING = Reach(0.0, (0.0, 0.15, 0.0, -0.5, 0.0, 0.0))
TABLE = Obstacle('table', Frame(np.array([0.55, 0.0, -0.33]), np.eye(3)), (0.70, 1.20, 0.70))
"""Its top is 2 cm above the pelvis, and its edge 0.2 m before it."""
ABOVE = Frame(np.array([0.33, 0.25, 0.12]), LEVEL)


def world(*obstacles: Obstacle, **options) -> ArmWorld:
    """Return a robot that stands among obstacles."""
    made = ArmWorld(URDF, BODY, obstacles, **options)
    made.stand(HOME)
    return made


def between(way: list[Reach], step_rad: float = 0.02) -> list[Reach]:
    """Return many postures on a way."""
    found = []
    for one, other in zip(way, way[1:]):
        a, b = (np.array([each.waist_rad, *each.posture]) for each in (one, other))
        for share in np.linspace(0.0, 1.0, math.ceil(np.abs(b - a).max() / step_rad) + 1):
            at = (a + share * (b - a)).tolist()
            found.append(Reach(at[0], tuple(at[1:])))
    return found


def test_a_robot_that_stands_touches_nothing() -> None:
    """Neither with hanging arms nor with the hands before the body."""
    free = world()
    for side in ('left', 'right'):
        sign = 1.0 if side == 'left' else -1.0
        hanging = Reach(0.0, (0.0, sign * 0.15, 0.0, -0.5, 0.0, 0.0))
        carrying = Reach(0.0, (0.2, sign * 0.15, 0.0, -1.77, 0.0, 0.0))
        assert free.contacts(side, hanging) == []
        assert free.contacts(side, carrying) == []


@pytest.mark.parametrize(
    ('posture', 'other'),
    [
        ((-0.3, -0.3, -1.5, -1.6, 0.0, 0.0), 'torso'),
        ((-1.2, -0.3, -1.2, -1.2, 0.0, 0.0), 'right'),
    ],
)
def test_arms_do_not_go_through_the_body(posture: tuple[float, ...], other: str) -> None:
    """A hand in the belly is told, and one in the other arm, if that is raised."""
    free = world()
    free.stand({'right_shoulder': -1.2, 'right_shoulder_roll': 0.2, 'right_elbow': -0.6})
    names = {name for each in free.contacts('left', Reach(0.0, posture)) for name in each.names}
    assert any(other in name for name in names), names


def test_what_is_held_touches_as_well() -> None:
    """A long thing in the hand reaches the table sooner than the hand."""
    reach = BODY.reach('left', ABOVE)
    bottle = Obstacle('bottle', Frame(np.zeros(3), np.eye(3)), (0.30, 0.06, 0.06))
    assert world(TABLE).contacts('left', reach) == []
    (contact, *_) = world(TABLE, held={'left': bottle}).contacts('left', reach)
    assert contact.names == {'bottle', 'table'}
    assert str(contact) == "'bottle' would touch 'table'" or 'table' in contact.one
    assert contact.distance_m < 0.0


def test_without_obstacles_the_way_is_straight() -> None:
    """There is nothing to plan."""
    goal = BODY.reach('left', ABOVE)
    assert plan(world(), 'left', HANGING, goal) == [HANGING, goal]


@pytest.mark.parametrize('seed', range(5))
def test_a_hand_goes_round_the_edge_of_a_table(seed: int) -> None:
    """From beside the hip to above the top; no posture on the way touches anything."""
    free = world(TABLE)
    start = Reach(0.0, (-0.1, 0.12, 0.0, -0.2, 0.0, 0.0))
    goal = BODY.reach('left', ABOVE, start)
    way = plan(free, 'left', start, goal, seed=seed)
    assert way[0] == start and way[-1] == goal
    touching = [each for at in between(way) for each in free.contacts('left', at)]
    assert [each for each in touching if each.distance_m < 0.0] == []
    assert way == plan(free, 'left', start, goal, seed=seed)


def test_a_goal_in_the_table_is_blocked() -> None:
    """The sentence names what is in the way."""
    goal = BODY.reach('left', Frame(ABOVE.position_m - [0.0, 0.0, 0.10], LEVEL))
    with pytest.raises(BlockedError, match="would touch 'table'|'table' would touch"):
        plan(world(TABLE), 'left', HANGING, goal)


def test_a_hand_between_walls_finds_no_way() -> None:
    """It says so, instead of looking for ever."""
    goal = BODY.reach('left', ABOVE)
    x, y, z = ABOVE.position_m
    walls = [
        Obstacle('wall', Frame(np.array([x - 0.10, y, z]), np.eye(3)), (0.01, 0.8, 0.9)),
    ]
    start = Reach(0.0, (0.3, 0.15, 0.0, -0.9, 0.0, 0.0))
    with pytest.raises(BlockedError):
        plan(world(*walls), 'left', start, goal)


def test_what_touches_at_the_start_may_do_so_on_the_way() -> None:
    """A hand that lies on a table can be lifted."""
    low = BODY.reach('left', Frame(ABOVE.position_m - [0.0, 0.0, 0.10], LEVEL))
    high = BODY.reach('left', ABOVE, low)
    assert plan(world(TABLE), 'left', low, high)[-1] == high


def test_an_approach_is_straight() -> None:
    """The gripper keeps its heading, and the waist stays."""
    start = BODY.reach('left', ABOVE)
    way = approach(BODY, 'left', start, np.array([0.08, 0.0, -0.02]))
    for number, each in enumerate(way):
        at = BODY.forward('left', each)
        share = number / (len(way) - 1)
        assert at.position_m == pytest.approx(
            ABOVE.position_m + share * np.array([0.08, 0, -0.02])
        )
        assert np.allclose(at.rotation, LEVEL, atol=1e-6)
        assert each.waist_rad == start.waist_rad
    with pytest.raises(OutOfReachError):
        approach(BODY, 'left', start, np.array([0.5, 0.0, 0.0]))


def test_a_motion_is_gentle() -> None:
    """It begins and ends at rest, keeps to its speed, and stays near the way."""
    corners = [HANGING, Reach(0.3, (-1.0, 0.5, 0.0, -1.0, 0.4, 0.2)), BODY.reach('left', ABOVE)]
    motion = timed(corners, 1.0)
    assert motion.positions_rad[0].tolist() == [HANGING.waist_rad, *HANGING.posture]
    assert motion.positions_rad[-1].tolist() == [corners[-1].waist_rad, *corners[-1].posture]
    assert not motion.velocities_rad_s[[0, -1]].any()
    assert np.abs(motion.velocities_rad_s).max() <= 1.0 + 1e-9
    steps = np.abs(np.diff(motion.velocities_rad_s, axis=0)).max() / 0.05
    assert steps < 9.0
    on_way = np.array([[each.waist_rad, *each.posture] for each in between(corners)])
    off = [np.abs(on_way - at).max(axis=1).min() for at in motion.positions_rad]
    assert max(off) < 0.1
    assert motion.duration_s == pytest.approx(motion.times_s[-1])


def test_a_motion_to_where_the_arm_is() -> None:
    """Takes no way."""
    motion = timed([HANGING, HANGING], 1.0)
    assert np.ptp(motion.positions_rad, axis=0).max() == 0.0


def test_a_box_that_cannot_be() -> None:
    """Without a size, or nowhere."""
    with pytest.raises(ManipulationError, match="'thing' is not a box"):
        Obstacle('thing', Frame(np.zeros(3), np.eye(3)), (0.1, 0.0, 0.1))
    with pytest.raises(ManipulationError, match="'thing' is not a box"):
        Obstacle('thing', Frame(np.full(3, math.nan), np.eye(3)), (0.1, 0.1, 0.1))
