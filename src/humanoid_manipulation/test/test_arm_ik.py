# SPDX-License-Identifier: Apache-2.0
"""Check the arm's inverse kinematics against its forward kinematics and the model."""

from __future__ import annotations

import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import load_drives
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.loading import load_robot
from humanoid_description.robot import Robot
from humanoid_manipulation.arm_ik import Arm
from humanoid_manipulation.closed_form import Posture
from humanoid_manipulation.errors import ManipulationError
import numpy as np
import pytest

SIDES = ('left', 'right')
COUNT = 1000
STRETCHED = (0.3, 0.4, 0.2, 0.0, 0.5, -0.3)
"""An arm whose elbow is straight: wrist and shoulder turn about the same axis."""
SIDEWAYS = (0.3, math.pi / 2.0, 0.2, -0.9, 0.5, -0.3)
"""An arm along the axis of the shoulder's pitch."""


@pytest.fixture(name='robot', scope='module', params=[(1.0, ''), (0.65, 'r1_')])
def _robot(request: pytest.FixtureRequest) -> Robot:
    """Return a humanoid with hands, of either size."""
    scale, prefix = request.param
    return load_robot(humanoid_urdf(scale, prefix, hands=True), 'the humanoid')


@pytest.fixture(name='arm', scope='module', params=SIDES)
def _arm(request: pytest.FixtureRequest, robot: Robot) -> Arm:
    """Return either arm."""
    return Arm.of(robot, request.param)


def some_postures(arm: Arm, count: int = COUNT) -> list[Posture]:
    """Return postures within the limits, the same ones each time."""
    random = np.random.default_rng(3)
    return [
        tuple(each) for each in random.uniform(arm.lower_rad, arm.upper_rad, (count, 6)).tolist()
    ]


def error(one: Frame, other: Frame) -> tuple[float, float]:
    """Return how far two frames are apart, in m and in rad (a chord, as it is small)."""
    turned = float(np.linalg.norm(one.rotation - other.rotation)) / math.sqrt(2.0)
    return float(np.linalg.norm(one.position_m - other.position_m)), turned


def test_the_arm_is_that_of_the_model(robot: Robot, arm: Arm) -> None:
    """Its gripper is where the model has it, in the torso."""
    joints = chain(robot, arm.gripper, arm.base)
    for posture in some_postures(arm, 50):
        pose = pose_along(joints, dict(zip(arm.joints, posture)))
        assert error(arm.forward(posture), Frame(pose[:3, 3], pose[:3, :3])) < (1e-9, 1e-9)
        assert arm.points(posture)[3] == pytest.approx(pose[:3, 3])


def test_its_limits_are_those_of_the_drives() -> None:
    """Also on the right, where rolls and yaws are the other way round."""
    robot, drives = load_robot(humanoid_urdf(hands=True), 'it'), load_drives(hands=True)
    for side in SIDES:
        arm = Arm.of(robot, side)
        assert arm.lower_rad == tuple(drives[joint].lower for joint in arm.joints)
        assert arm.upper_rad == tuple(drives[joint].upper for joint in arm.joints)


def test_every_posture_is_found_again(arm: Arm) -> None:
    """Of the solutions for a pose one is the posture it came from, and all bring it about."""
    for posture in some_postures(arm):
        wanted = arm.forward(posture)
        found = arm.postures(wanted, posture)
        assert found, posture
        assert math.dist(found[0], posture) < 1e-6
        for each in found:
            assert arm.is_within_limits(each)
            assert error(arm.forward(each), wanted) < (1e-9, 1e-9)


def test_solutions_are_different_postures(arm: Arm) -> None:
    """There are up to eight, and no two are the same."""
    most = 0
    for posture in some_postures(arm, 200):
        found = list(arm.solutions(arm.forward(posture)))
        most = max(most, len(found))
        gaps = [math.dist(a, b) for i, a in enumerate(found) for b in found[:i]]
        assert not gaps or min(gaps) > 1e-6
    assert most == 8


@pytest.mark.parametrize('posture', [STRETCHED, SIDEWAYS, (0.0,) * 6])
def test_where_axes_coincide_the_arm_stays_as_it_is(posture: Posture) -> None:
    """At a singularity one joint is given, by where it is now."""
    arm = Arm.of(load_robot(humanoid_urdf(hands=True), 'the humanoid'), 'left')
    wanted = arm.forward(posture)
    found = arm.postures(wanted, posture)
    assert found and error(arm.forward(found[0]), wanted) < (1e-6, 1e-6)
    assert math.dist(found[0], posture) < 1e-3


def test_near_singularities_poses_are_still_exact(arm: Arm) -> None:
    """Elbows that are nearly straight, and arms that nearly point sideways."""
    random = np.random.default_rng(7)
    for base in (STRETCHED, SIDEWAYS):
        for _ in range(200):
            size = 10.0 ** random.uniform(-12.0, -2.0)
            posture = tuple((np.array(base) + size * random.standard_normal(6)).tolist())
            wanted = arm.forward(posture)
            found = list(arm.solutions(wanted, posture))
            assert found, posture
            assert min(error(arm.forward(each), wanted) for each in found) < (1e-6, 1e-5)


def test_out_of_reach_there_is_no_posture(arm: Arm) -> None:
    """Neither far away, nor beyond what the limits allow."""
    there = arm.forward((0.0,) * 6)
    far = Frame(there.position_m - [0.0, 0.0, 0.01], there.rotation)
    assert list(arm.solutions(far)) == []
    behind = arm.forward((1.9, 0.0, 0.0, 0.9, 0.0, 0.0))
    upside_down = Frame(behind.position_m, behind.rotation @ np.diag([-1.0, 1.0, -1.0]))
    assert arm.postures(upside_down) == []


def test_without_hands_there_is_no_arm_to_reach_with() -> None:
    """The sentence says how to get them."""
    bare = load_robot(humanoid_urdf(), 'the humanoid')
    with pytest.raises(ManipulationError, match='hands:=true'):
        Arm.of(bare, 'left')
    with pytest.raises(ManipulationError, match="not 'middle'"):
        Arm.of(bare, 'middle')
