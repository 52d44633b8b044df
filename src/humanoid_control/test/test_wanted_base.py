# SPDX-License-Identifier: Apache-2.0
"""Check where the pelvis is wanted for a centre of mass, and what the soles say."""

from __future__ import annotations

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.rotations import about_z, from_rpy
from humanoid_control.walking.attitude import Attitude
from humanoid_control.walking.base_estimate import BaseEstimate
from humanoid_control.walking.foot_shape import FootShape
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.soles import footing_below, soles_below
from humanoid_control.walking.state_estimator import RobotState
from humanoid_control.walking.turning import Turning
from humanoid_control.walking.walking_robot import WalkingRobot
from humanoid_control.walking.wanted_base import base_below, within_reach
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
import numpy as np
import pytest

P = WalkParameters()
UNDRAGGED = (0j, 0j)
LEAN = from_rpy(0.1, -0.05, 0.6)
TURNING = Turning(0.5, 0.3)
WANTED = Motion(0.2 + 0.1j, 0.3 - 0.05j)
HEIGHT_M = 0.66
BASE = BaseEstimate(np.array([0.15, 0.08, 0.68]), np.array([0.3, 0.0, 0.0]))


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
    com = BASE.com_motion(state)
    base = base_below(WANTED, HEIGHT_M, TURNING, com, BASE, state)
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
    footing = footing_below(0j, walking, FootShape.of(robot, P), P, sensed)
    com = BASE.com_motion(state)
    wanted = base_below(Motion(), 0.8, TURNING, com, BASE, state)
    sunk = within_reach(wanted, walking, footing, SIDES, P.posture.leg_reach)
    assert sunk.frame.position_m[:2] == pytest.approx(wanted.frame.position_m[:2])
    assert sunk.frame.position_m[2] < wanted.frame.position_m[2]
    again = within_reach(sunk, walking, footing, SIDES, P.posture.leg_reach)
    assert again.frame.position_m == pytest.approx(sunk.frame.position_m)


def test_soles_are_seen_from_the_base(walking: WalkingRobot, state: BodyState) -> None:
    """The soles are where the base and the joints put them, with the load that they carry."""
    level = Attitude(0.0, 0.0, 0.0, (0.0, 0.0, 0.0))
    sensed = RobotState(0.0, state, level, (0.7, 0.2), UNDRAGGED, state.bias_nm, np.zeros(3))
    soles = soles_below(BASE.position_m, walking, sensed, P)
    for side, sole in zip(SIDES, soles):
        place = BASE.position_m + state.position_m(walking.legs[side].sole)
        found = [sole.pose.position_m.real, sole.pose.position_m.imag, sole.plane.height_m]
        assert found == pytest.approx(place)
        assert sole.load == sensed.loads[side]
