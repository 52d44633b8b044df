# SPDX-License-Identifier: Apache-2.0
"""Check the posture in which the robot stands."""

from __future__ import annotations

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import outwards, SIDES
from humanoid_control.walking.walking_robot import HomePosture, WalkingRobot
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
import numpy as np
import pytest


def walking(robot: Robot, scale: float) -> WalkingRobot:
    """Return what walking knows of the robot."""
    drives = load_drives(scale)
    return WalkingRobot.of(robot, drives, tuple(drives))


@pytest.mark.parametrize('scale', [0.5, 1.0, 1.3], indirect=True)
def test_feet_are_flat_below_the_centre_of_mass(robot: Robot, scale: float) -> None:
    """Both soles are level on the ground, and their load points under the centre of mass."""
    body, parameters = walking(robot, scale), WalkParameters().scaled(scale)
    home = HomePosture.of(body, parameters)
    state = body.body.state(
        np.eye(3), np.zeros(3), home.positions_rad, np.zeros_like(home.positions_rad)
    )
    for side in SIDES:
        sole = state.pose(body.legs[side].sole)
        left_m = outwards(side) * parameters.footsteps.width_m / 2
        expected = [home.sole_forward_m, left_m, -home.base_height_m]
        assert sole[:3, 3] == pytest.approx(expected, abs=1e-9)
        assert sole[:3, :3] == pytest.approx(np.eye(3), abs=1e-9)
        forward_m = sole[0, 3] + parameters.posture.zmp_forward_m
        assert forward_m == pytest.approx(state.com_m[0], abs=1e-6)
    assert state.com_m[2] + home.base_height_m == pytest.approx(home.com_height_m)


def test_joints_are_within_their_ranges(robot: Robot) -> None:
    """The robot can stand so, with room to move."""
    drives = load_drives()
    home = HomePosture.of(walking(robot, 1.0), WalkParameters())
    for drive, position in zip(drives.values(), home.positions_rad):
        assert drive.lower + 0.05 < position < drive.upper - 0.05 or position == 0.0


def test_a_joint_without_a_drive_is_refused(robot: Robot) -> None:
    """A robot whose joint has no drive cannot walk, and is told which."""
    drives = load_drives()
    joints = tuple(drives)
    del drives['left_knee']
    with pytest.raises(WalkingError, match='no drive for left_knee'):
        WalkingRobot.of(robot, drives, joints)
