# SPDX-License-Identifier: Apache-2.0
"""Check the motion of base and joints for that of the centre of mass and the soles."""

from __future__ import annotations

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.leg_ik import leg_posture, LegGeometry
from humanoid_control.walking.footing import Foothold, Footing
from humanoid_control.walking.odometry import BaseEstimate, BaseMotion
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.planar import GroundPlane, LEFT, PlanarPose, RIGHT, SIDES, Turning
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.swing_foot import SoleMotion, Swing
from humanoid_control.walking.terrain import footing_below, soles_below
from humanoid_control.walking.walking_robot import Attitude, HomePosture, RobotState, WalkingRobot
from humanoid_control.walking.whole_body import (
    base_below,
    JointMotion,
    reachable_height_m,
    WholeBody,
    within_reach,
)
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import about_z, from_rpy
import numpy as np
import pytest

P = WalkParameters()
FEET = (PlanarPose(0.05 + 0.09j, 0.1), PlanarPose(-0.04 - 0.09j, -0.1))
BASE = Frame(np.array([0.01, 0.005, 0.68]), from_rpy(0.02, -0.03, 0.1))
TWIST = Twist(np.array([0.2, -0.05, 0.02]), np.array([0.1, -0.2, 0.3]))
MOTION = BaseMotion(BASE, TWIST)
UNDRAGGED = (0j, 0j)
LEAN = from_rpy(0.1, -0.05, 0.6)
TURNING = Turning(0.5, 0.3)
WANTED = Motion(0.2 + 0.1j, 0.3 - 0.05j)
HEIGHT_M = 0.66
ESTIMATE = BaseEstimate(np.array([0.15, 0.08, 0.68]), np.array([0.3, 0.0, 0.0]))
REACH = 0.97


@pytest.fixture(name='body', scope='module')
def _body(robot: Robot) -> tuple[WalkingRobot, WholeBody, Footing]:
    """Return the robot, what moves it, and where it stands."""
    drives = load_drives()
    walking = WalkingRobot.of(robot, drives, tuple(drives))
    whole = WholeBody(walking, HomePosture.of(walking, P), P)
    return (
        walking,
        whole,
        Footing(FootShape.of(robot, P.posture), [Foothold(pose) for pose in FEET]),
    )


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


@pytest.fixture(name='walking', scope='module')
def _walking(robot: Robot) -> WalkingRobot:
    """Return the robot."""
    drives = load_drives()
    return WalkingRobot.of(robot, drives, tuple(drives))


@pytest.fixture(name='state', scope='module')
def _state(walking: WalkingRobot) -> BodyState:
    """Return the robot as it leans, turns and moves its joints."""
    return walking.body.state(LEAN, np.array([0.2, -0.1, 0.4]), *joints(walking))


def joints(walking: WalkingRobot) -> tuple[np.ndarray, np.ndarray]:
    """Return positions and velocities (n,) of the joints."""
    home = HomePosture.of(walking, P).positions_rad
    return home, np.linspace(-0.5, 0.5, len(home))


def test_centre_of_mass_is_where_it_is_wanted(walking: WalkingRobot, state: BodyState) -> None:
    """With the base where it is wanted and the joints as they are, so is the centre of mass."""
    com = ESTIMATE.com_motion(state)
    base = base_below(WANTED, HEIGHT_M, TURNING, com, ESTIMATE, state)
    assert base.frame.rotation == pytest.approx(about_z(TURNING.heading_rad))
    upright = walking.body.state(base.frame.rotation, base.twist.angular_rad_s, *joints(walking))
    place = base.frame.position_m + upright.com_m
    goal = [WANTED.position_m.real, WANTED.position_m.imag, HEIGHT_M]
    assert place == pytest.approx(goal, abs=1e-9)
    speed = base.twist.linear_m_s + upright.com_velocity_m_s
    assert speed[:2] == pytest.approx([WANTED.velocity_m_s.real, WANTED.velocity_m_s.imag])


def test_base_sinks_to_reach(robot: Robot, walking: WalkingRobot, state: BodyState) -> None:
    """A base that is too high for its legs is lowered, and otherwise stays as it is."""
    level = Attitude(0.0, 0.0, 0.0, (0.0, 0.0, 0.0))
    sensed = RobotState(0.0, state, level, (0.5, 0.5), UNDRAGGED, state.bias_nm, np.zeros(3))
    footing = footing_below(0j, walking, FootShape.of(robot, P.posture), P, sensed)
    com = ESTIMATE.com_motion(state)
    wanted = base_below(Motion(), 0.8, TURNING, com, ESTIMATE, state)
    sunk = within_reach(wanted, walking, footing, SIDES, P.posture.leg_reach)
    assert sunk.frame.position_m[:2] == pytest.approx(wanted.frame.position_m[:2])
    assert sunk.frame.position_m[2] < wanted.frame.position_m[2]
    again = within_reach(sunk, walking, footing, SIDES, P.posture.leg_reach)
    assert again.frame.position_m == pytest.approx(sunk.frame.position_m)


def test_soles_are_seen_from_the_base(walking: WalkingRobot, state: BodyState) -> None:
    """The soles are where the base and the joints put them, with the load that they carry."""
    level = Attitude(0.0, 0.0, 0.0, (0.0, 0.0, 0.0))
    sensed = RobotState(0.0, state, level, (0.7, 0.2), UNDRAGGED, state.bias_nm, np.zeros(3))
    soles = soles_below(ESTIMATE.position_m, walking, sensed, P)
    for side, sole in zip(SIDES, soles):
        place = ESTIMATE.position_m + state.position_m(walking.legs[side].sole)
        found = [sole.pose.position_m.real, sole.pose.position_m.imag, sole.plane.height_m]
        assert found == pytest.approx(place)
        assert sole.load == sensed.loads[side]


@pytest.fixture(name='legs', scope='module')
def _legs(robot: Robot) -> list[LegGeometry]:
    """Return both legs."""
    return [LegGeometry.of(robot, side) for side in ('left', 'right')]


def base_at(height_m: float) -> Frame:
    """Return an upright base."""
    return Frame(np.array([0.0, 0.0, height_m]), np.eye(3))


def test_legs_below_the_hips_change_nothing(legs: list[LegGeometry]) -> None:
    """A robot that stands with bent knees keeps its height."""
    soles = [np.array([0.0, 0.09, 0.0]), np.array([0.0, -0.09, 0.0])]
    assert reachable_height_m(base_at(0.68), legs, soles, REACH) == 0.68


@pytest.mark.parametrize('far', [[0.3, -0.1, 0.0], [-0.25, -0.25, 0.02], [0.0, -0.4, 0.0]])
def test_a_far_foot_lowers_the_pelvis(legs: list[LegGeometry], far: list[float]) -> None:
    """The pelvis sinks until the leg that has to reach far is stretched so much, not more."""
    soles = [np.array([0.0, 0.09, 0.0]), np.array(far)]
    height_m = reachable_height_m(base_at(0.72), legs, soles, REACH)
    assert height_m < 0.7
    sole = Frame(soles[1], np.eye(3)).seen_from(base_at(height_m))
    posture = leg_posture(legs[1], sole)
    assert posture.beyond_m == 0.0
    ankle = soles[1] + legs[1].ankle_m - [0.0, 0.0, height_m]
    assert np.linalg.norm(ankle - legs[1].hip_m) == pytest.approx(REACH * legs[1].length_m)


def test_what_no_leg_reaches(legs: list[LegGeometry]) -> None:
    """A foot farther away than a leg is long brings the hip down to the ankle, not to nonsense."""
    soles = [np.array([0.0, 0.09, 0.0]), np.array([2.0, 0.0, 0.0])]
    height_m = reachable_height_m(base_at(0.7), legs, soles, REACH)
    assert height_m == pytest.approx(0.07 + 0.06)
