# SPDX-License-Identifier: Apache-2.0
"""Check what is read of a leg, and which legs are refused."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from humanoid_control.dynamics import DynamicsError, LegGeometry
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.robot import Robot
import numpy as np
import pytest

KINDS = ['hip_yaw', 'hip_roll', 'hip_pitch', 'knee', 'ankle_pitch', 'ankle_roll']


def changed(robot: Robot, name: str, **changes: Any) -> Robot:
    """Return a robot in which something of a joint is different."""
    joints = (replace(j, **changes) if j.name == name else j for j in robot.joints)
    return replace(robot, joints=tuple(joints))


def shifted(robot: Robot, name: str, *shift_m: float) -> Robot:
    """Return a robot in which a joint is elsewhere."""
    pose = robot.joint[name].pose.copy()
    pose[:3, 3] += shift_m
    return changed(robot, name, pose=pose)


@pytest.mark.parametrize(('side', 'sole', 'y'), [('left', 'l_sole', 1.0), ('right', 'r_sole', -1)])
@pytest.mark.parametrize('scale', [1.0, 1.3], indirect=True)
def test_geometry(robot: Robot, scale: float, side: str, sole: str, y: float) -> None:
    """The lengths of both legs are those of the model."""
    leg = LegGeometry.of(robot, side)
    assert leg.joints == tuple(f'{side}_{kind}' for kind in KINDS)
    assert leg.sole == sole
    assert leg.hip_m == pytest.approx(np.array([0, y * 0.085, -0.06]) * scale)
    assert leg.ankle_m == pytest.approx(np.array([0, 0, 0.07]) * scale)
    assert (leg.thigh_m, leg.shank_m) == pytest.approx((0.3 * scale, 0.3 * scale))
    assert leg.length_m == pytest.approx(0.6 * scale)


def test_prefix() -> None:
    """The names of a robot with a prefix have it."""
    robot = load_robot(humanoid_urdf(prefix='r1_'), 'the humanoid')
    leg = LegGeometry.of(robot, 'left')
    assert (leg.joints[0], leg.sole) == ('r1_left_hip_yaw', 'r1_l_sole')


def test_no_side(robot: Robot) -> None:
    """There are two sides."""
    with pytest.raises(DynamicsError, match="left or right, not 'middle'"):
        LegGeometry.of(robot, 'middle')


def test_no_leg() -> None:
    """A robot of an upper body has no legs, and this is said."""
    robot = load_robot(humanoid_urdf(upper_body_only=True), 'the upper body')
    with pytest.raises(DynamicsError, match="no left leg: there is no link 'l_sole'"):
        LegGeometry.of(robot, 'left')


def test_fewer_joints(robot: Robot) -> None:
    """A leg with other joints has no such solution."""
    with pytest.raises(DynamicsError, match='hip_yaw, left_hip_pitch.*, but needs left_hip_yaw'):
        LegGeometry.of(changed(robot, 'left_hip_roll', kind='fixed'), 'left')


def test_other_axis(robot: Robot) -> None:
    """A joint that turns about another axis is named."""
    bent = changed(robot, 'left_knee', axis=np.array([0.0, -1.0, 0.0]))
    with pytest.raises(DynamicsError, match="'left_knee' must rotate about y"):
        LegGeometry.of(bent, 'left')
    assert LegGeometry.of(bent, 'right').joints[3] == 'right_knee'


@pytest.mark.parametrize(
    ('joint', 'shift_m'),
    [
        ('left_hip_roll', (0.0, 0.0, 0.01)),
        ('left_hip_pitch', (0.02, 0.0, 0.0)),
        ('left_knee', (0.01, 0.0, 0.0)),
        ('left_ankle_pitch', (0.0, 0.0, 0.4)),
        ('left_ankle_roll', (0.0, 0.0, -0.02)),
    ],
)
def test_other_build(robot: Robot, joint: str, shift_m: tuple[float, ...]) -> None:
    """A leg whose axes do not meet has no such solution."""
    with pytest.raises(DynamicsError, match='kinematics of the left leg are not supported'):
        LegGeometry.of(shifted(robot, joint, *shift_m), 'left')
