# SPDX-License-Identifier: Apache-2.0
"""Check what others rely on in the humanoid's model; test_check_model.py checks its soundness."""

from __future__ import annotations

import math
import os
from xml.etree import ElementTree

from humanoid_description.errors import DescriptionError
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.geometry import outline
from humanoid_description.kinematics import poses
from humanoid_description.loading import load_robot
import numpy as np
import pytest

ARM = ('shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow')
LEG = ('hip_yaw', 'hip_roll', 'hip_pitch', 'knee', 'ankle_pitch', 'ankle_roll')
TRUNK = ('waist_yaw', 'head_yaw', 'head_pitch')
UPPER_BODY = {*TRUNK, *(f'{side}_{joint}' for side in ('left', 'right') for joint in ARM)}
DRIVEN = UPPER_BODY | {f'{side}_{joint}' for side in ('left', 'right') for joint in LEG}
SENSORS = {
    'imu_link',
    'camera_link',
    'camera_optical_frame',
    'laser',
    'l_foot_contact',
    'r_foot_contact',
}


def names(robot: ElementTree.Element, path: str) -> list[str]:
    """Return the names of all elements on a path."""
    return [element.attrib['name'] for element in robot.findall(path)]


def test_driven_joints(robot: ElementTree.Element) -> None:
    """The joints have the names that controllers use."""
    assert set(names(robot, "joint[@type='revolute']")) == DRIVEN


def test_sensors(robot: ElementTree.Element) -> None:
    """The frames of the sensors are there."""
    assert set(names(robot, 'link')) >= SENSORS


def test_optical_frame(robot: ElementTree.Element) -> None:
    """The camera looks along z of its optical frame, with x to the right (REP 103)."""
    origin = robot.find("joint[@name='camera_optical_frame_fixed']/origin")
    assert origin is not None
    rpy = [float(angle) for angle in origin.attrib['rpy'].split()]
    assert rpy == pytest.approx([-math.pi / 2, 0.0, -math.pi / 2])


def test_shapes_have_their_own_names(robot: ElementTree.Element) -> None:
    """No two shapes share a name, which MuJoCo would drop."""
    shapes = names(robot, 'link/visual') + names(robot, 'link/collision')
    assert len(shapes) == len(set(shapes)) > 0


def test_axes(robot: ElementTree.Element) -> None:
    """Yaw turns about z, roll about x, all else about y."""
    for joint in robot.findall("joint[@type='revolute']"):
        name = joint.attrib['name']
        kind = name.rsplit('_', 1)[-1]
        axis = joint.find('axis')
        assert axis is not None
        assert axis.attrib['xyz'] == {'yaw': '0 0 1', 'roll': '1 0 0'}.get(kind, '0 1 0'), name


def test_left_is_left(robot: ElementTree.Element) -> None:
    """The left limbs are on the side of positive y."""
    for name in ('left_shoulder', 'left_hip_yaw'):
        origin = robot.find(f"joint[@name='{name}']/origin")
        assert origin is not None
        assert float(origin.attrib['xyz'].split()[1]) > 0


def test_upper_body_only() -> None:
    """Without legs there are the trunk, the head and the arms on the pelvis."""
    robot = ElementTree.fromstring(humanoid_urdf(upper_body_only=True))
    assert set(names(robot, "joint[@type='revolute']")) == UPPER_BODY
    assert not {'left_thigh', 'l_sole', 'l_foot_contact'} & set(names(robot, 'link'))


def test_hands() -> None:
    """Each arm gets a wrist of two joints and a gripper, whose thumb follows the finger."""
    robot = ElementTree.fromstring(humanoid_urdf(hands=True))
    for side in ('left', 'right'):
        assert {f'{side}_wrist_yaw', f'{side}_wrist_pitch'} <= set(
            names(robot, "joint[@type='revolute']")
        )
        thumb = robot.find(f"joint[@name='{side}_gripper_thumb']/mimic")
        assert thumb is not None
        assert thumb.attrib == {'joint': f'{side}_gripper'}


@pytest.mark.parametrize('gap_m', [0.0, 0.06, 0.1])
def test_what_is_gripped_is_in_the_middle_of_the_hand(gap_m: float) -> None:
    """The inner sides of finger and thumb are as far apart as the gap, about the gripper frame."""
    robot = load_robot(humanoid_urdf(hands=True), 'the humanoid')
    at = poses(robot, {'left_gripper': gap_m / 2, 'right_gripper': gap_m / 2})
    for side, frame in (('left', 'l_gripper'), ('right', 'r_gripper')):
        inverse = np.linalg.inv(at[frame])
        edges_m = []
        for part in ('finger', 'thumb'):
            link = f'{side}_{part}'
            corners = outline(robot.link[link].collisions, inverse @ at[link])
            assert corners[:, 2].min() < -0.03 < 0.03 < corners[:, 2].max()
            edges_m.append((corners[:, 1].min(), corners[:, 1].max()))
        inner, outer = sorted(edges_m)
        assert outer[0] - inner[1] == pytest.approx(gap_m, abs=1e-9)
        assert outer[0] + inner[1] == pytest.approx(0.0, abs=1e-9)


def test_prefix(robot: ElementTree.Element) -> None:
    """A prefix stands before every name of a link, joint and shape, and changes nothing else."""
    other = ElementTree.fromstring(humanoid_urdf(prefix='r1_'))
    for path in ('link', 'joint', 'link/visual', 'link/collision'):
        assert names(other, path) == [f'r1_{name}' for name in names(robot, path)]


@pytest.mark.parametrize('scale', [0.49, 1.31, -1.0, float('nan')])
def test_scale_out_of_range(scale: float) -> None:
    """The model itself refuses a scale that is out of range, and names the range."""
    with pytest.raises(DescriptionError, match=r'is out of range\. Give one from 0\.5 to 1\.3'):
        humanoid_urdf(scale)


def test_expansion_is_quick() -> None:
    """To expand the model takes a fifth of a second, from start to end of xacro: never a whole."""
    spent_s = []
    for _ in range(3):
        start = os.times()
        humanoid_urdf()
        spent = (b - a for a, b in zip(start[:4], os.times()[:4]))
        spent_s.append(sum(spent))
    assert min(spent_s) < 1.0
