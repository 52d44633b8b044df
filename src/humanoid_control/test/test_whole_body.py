# SPDX-License-Identifier: Apache-2.0
"""Check the motion of the joints for that of pelvis and soles."""

from __future__ import annotations

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.rotations import about_z, from_rpy
from humanoid_control.walking.base_motion import BaseMotion
from humanoid_control.walking.foot_shape import FootShape
from humanoid_control.walking.footing import Foothold, Footing
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.sides import LEFT, RIGHT
from humanoid_control.walking.swing_foot import SoleMotion, Swing
from humanoid_control.walking.terrain import GroundPlane
from humanoid_control.walking.walking_robot import WalkingRobot
from humanoid_control.walking.whole_body import JointMotion, WholeBody
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
import numpy as np
import pytest

P = WalkParameters()
FEET = (PlanarPose(0.05 + 0.09j, 0.1), PlanarPose(-0.04 - 0.09j, -0.1))
BASE = Frame(np.array([0.01, 0.005, 0.68]), from_rpy(0.02, -0.03, 0.1))
TWIST = Twist(np.array([0.2, -0.05, 0.02]), np.array([0.1, -0.2, 0.3]))
MOTION = BaseMotion(BASE, TWIST)


@pytest.fixture(name='body', scope='module')
def _body(robot: Robot) -> tuple[WalkingRobot, WholeBody, Footing]:
    """Return the robot, what moves it, and where it stands."""
    drives = load_drives()
    walking = WalkingRobot.of(robot, drives, tuple(drives))
    whole = WholeBody(walking, HomePosture.of(walking, P), P)
    return walking, whole, Footing(FootShape.of(robot, P), [Foothold(pose) for pose in FEET])


def state_of(walking: WalkingRobot, joints: JointMotion) -> BodyState:
    """Return the robot in the motion, with its base in that of the tests."""
    rates = BASE.rotation.T @ TWIST.angular_rad_s
    return walking.body.state(BASE.rotation, rates, joints.positions_rad, joints.velocities_rad_s)


def test_feet_on_the_ground_stay(body: tuple[WalkingRobot, WholeBody, Footing]) -> None:
    """Where the joints are as told and the base moves as wanted, the soles stand still."""
    walking, whole, footing = body
    joints = whole.motion(MOTION, MOTION, footing, None)
    state = state_of(walking, joints)
    for leg, pose in zip(walking.legs, FEET):
        place = [pose.position_m.real, pose.position_m.imag, 0.0]
        assert state.position_m(leg.sole) + BASE.position_m == pytest.approx(place, abs=1e-9)
        assert state.rotation(leg.sole) == pytest.approx(about_z(pose.yaw_rad), abs=1e-9)
        velocity = state.velocity_m_s(leg.sole) + TWIST.linear_m_s
        assert velocity == pytest.approx(np.zeros(3), abs=1e-9)
        assert state.angular_velocity_rad_s(leg.sole) == pytest.approx(np.zeros(3), abs=1e-9)


def test_a_foot_in_the_air_moves_as_planned(
    body: tuple[WalkingRobot, WholeBody, Footing],
) -> None:
    """The sole in the air is where it is planned from where the base is, and moves as planned."""
    walking, whole, footing = body
    sole = SoleMotion(PlanarPose(0.1 - 0.12j, 0.2), GroundPlane(0.03), 0.4 - 0.1j, 0.05, 0.3)
    elsewhere = Frame(BASE.position_m + 0.02, np.eye(3))
    joints = whole.motion(BaseMotion(elsewhere, TWIST), MOTION, footing, Swing(RIGHT, sole))
    state, leg = state_of(walking, joints), walking.legs[RIGHT]
    assert state.position_m(leg.sole) + BASE.position_m == pytest.approx([0.1, -0.12, 0.03])
    velocity = state.velocity_m_s(leg.sole) + TWIST.linear_m_s
    assert velocity == pytest.approx([0.4, -0.1, 0.05], abs=1e-9)
    assert state.angular_velocity_rad_s(leg.sole) == pytest.approx([0.0, 0.0, 0.3], abs=1e-9)


def test_arms_go_with_the_opposite_foot(body: tuple[WalkingRobot, WholeBody, Footing]) -> None:
    """While the left foot is ahead, the right arm is, and the left one is behind."""
    walking, whole, footing = body
    joints = whole.motion(MOTION, MOTION, footing, None)
    left, right = (walking.index(f'{side}_shoulder') for side in ('left', 'right'))
    assert joints.positions_rad[left] > 0.0 > joints.positions_rad[right]
    ahead = SoleMotion(FEET[LEFT], GroundPlane(0.02), 0.5 + 0j)
    moving = whole.motion(MOTION, MOTION, footing, Swing(LEFT, ahead))
    assert moving.velocities_rad_s[left] > 0.0 > moving.velocities_rad_s[right]
