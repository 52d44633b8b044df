# SPDX-License-Identifier: Apache-2.0
"""Reach with an arm and the waist, and hear why not."""

from __future__ import annotations

import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.loading import load_robot
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy, log
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.upper_body import OutOfReachError, Reach, UpperBody
import numpy as np
import pytest

SIDES = ('left', 'right')
LEVEL = from_rpy(0.0, -math.pi / 2.0, 0.0)
"""The hand points ahead, and its fingers close sideways."""


@pytest.fixture(name='robot', scope='module')
def _robot() -> Robot:
    """Return the humanoid with hands."""
    return load_robot(humanoid_urdf(prefix='r1_', hands=True), 'the humanoid')


@pytest.fixture(name='body', scope='module')
def _body(robot: Robot) -> UpperBody:
    """Return its upper body."""
    return UpperBody.of(robot)


def some_reaches(body: UpperBody, side: str, count: int) -> list[Reach]:
    """Return random reaches within the limits, the same ones each time."""
    arm, random = body.arms[side], np.random.default_rng(5)
    lower, upper = (body.lower_rad, *arm.lower_rad), (body.upper_rad, *arm.upper_rad)
    values = random.uniform(lower, upper, (count, len(lower))).tolist()
    return [Reach(waist, tuple(posture)) for waist, *posture in values]


def error(one: Frame, other: Frame) -> tuple[float, float]:
    """Return how far two frames are apart, in m and in rad."""
    turned = float(np.linalg.norm(log(one.rotation.T @ other.rotation)))
    return float(np.linalg.norm(one.position_m - other.position_m)), turned


def is_within_limits(body: UpperBody, side: str, reach: Reach) -> bool:
    """Return whether waist and arm are within their limits, but for rounding."""
    is_turned = body.lower_rad - 1e-9 <= reach.waist_rad <= body.upper_rad + 1e-9
    return is_turned and body.arms[side].excess_rad(reach.posture) <= 1e-9


@pytest.mark.parametrize('side', SIDES)
def test_it_is_that_of_the_model(robot: Robot, body: UpperBody, side: str) -> None:
    """The gripper is where the model has it, in the pelvis."""
    arm = body.arms[side]
    joints = chain(robot, arm.gripper, body.base)
    for reach in some_reaches(body, side, 50):
        positions = {body.waist: reach.waist_rad, **dict(zip(arm.joints, reach.posture))}
        pose = pose_along(joints, positions)
        assert error(body.forward(side, reach), Frame(pose[:3, 3], pose[:3, :3])) < (1e-9, 1e-6)


@pytest.mark.parametrize('side', SIDES)
def test_poses_that_can_be_reached_are(body: UpperBody, side: str) -> None:
    """At least 99 of 100, exactly, and within the limits."""
    solved = 0
    reaches = some_reaches(body, side, 600)
    for reach in reaches:
        wanted = body.forward(side, reach)
        try:
            found = body.reach(side, wanted)
        except OutOfReachError:
            continue
        solved += 1
        assert is_within_limits(body, side, found)
        assert error(body.forward(side, found), wanted) < (1e-6, 1e-5)
    assert solved >= 0.99 * len(reaches)


@pytest.mark.parametrize('side', SIDES)
def test_who_is_there_stays(body: UpperBody, side: str) -> None:
    """From where the arm is, the way to the same pose is none at all."""
    for reach in some_reaches(body, side, 100):
        found = body.reach(side, body.forward(side, reach), reach)
        assert found.waist_rad == reach.waist_rad
        assert math.dist(found.posture, reach.posture) < 1e-5


def test_the_waist_turns_only_if_it_must(body: UpperBody) -> None:
    """What is ahead of the shoulder, the arm reaches alone; what is far aside, it does not."""
    ahead = body.reach('left', Frame(np.array([0.32, 0.17, 0.15]), LEVEL))
    assert ahead.waist_rad == 0.0
    wanted = body.forward('left', Reach(-1.1, (-0.6, 0.1, 0.0, -0.9, 0.0, -0.1)))
    assert wanted.position_m[1] < -0.1
    assert body.reach('left', wanted).waist_rad < -0.1


@pytest.mark.parametrize('side', SIDES)
@pytest.mark.parametrize(
    ('position_m', 'part'),
    [
        ((1.0, 0.2, 0.2), 'cannot get closer than'),
        ((0.2, 0.2, 1.5), 'cannot get closer than'),
        ((-0.4, 0.0, 0.2), 'out of reach'),
    ],
)
def test_out_of_reach_it_says_why_and_what_is_nearest(
    body: UpperBody, side: str, position_m: tuple[float, float, float], part: str
) -> None:
    """The nearest pose is reached, and nearer than that of an arm that just hangs."""
    wanted = Frame(np.array(position_m), LEVEL)
    with pytest.raises(OutOfReachError, match=part) as raised:
        body.reach(side, wanted)
    nearest = raised.value.nearest
    assert is_within_limits(body, side, nearest)
    assert error(body.forward(side, nearest), raised.value.pose) < (1e-9, 1e-6)
    hanging = body.forward(side, Reach(0.0, (0.0,) * 6))
    assert error(raised.value.pose, wanted)[0] < error(hanging, wanted)[0]
    assert side in str(raised.value)


def test_a_hand_that_cannot_be_turned_so(body: UpperBody) -> None:
    """The place is near enough, but the fingers cannot point up there."""
    upwards = from_rpy(math.pi, 0.0, 0.0)
    with pytest.raises(OutOfReachError, match='is [0-9]+ degrees short'):
        body.reach('left', Frame(np.array([0.25, 0.25, 0.10]), upwards))


def test_without_hands_nothing_reaches() -> None:
    """The sentence says how to get them."""
    with pytest.raises(ManipulationError, match='hands:=true'):
        UpperBody.of(load_robot(humanoid_urdf(), 'the humanoid'))
