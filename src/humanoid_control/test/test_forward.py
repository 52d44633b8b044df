# SPDX-License-Identifier: Apache-2.0
"""Check the poses of all bodies against those along each chain."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from humanoid_control.dynamics import BodyModel
from humanoid_control.dynamics.forward import ForwardKinematics
from humanoid_control.dynamics.rotations import from_rpy
from humanoid_description.kinematics import poses
from humanoid_description.robot import Robot
import numpy as np
import pytest

Array = np.ndarray[Any, Any]


def posed(model: BodyModel, positions: Array) -> dict[str, Array]:
    """Return the poses of all links in the root."""
    bodies = model.forward.poses(np.eye(3), positions)
    return {name: bodies[mount.body] @ mount.pose for name, mount in model.links.items()}


@pytest.mark.parametrize('reverse', [False, True])
def test_poses(robot: Robot, model: BodyModel, reverse: bool) -> None:
    """In every order of the joints each link is where its own chain of joints leads."""
    joints = model.joints[::-1] if reverse else model.joints
    positions = np.random.default_rng(2).uniform(-3.0, 3.0, len(joints))
    found = posed(BodyModel.of(robot, joints), positions)
    for link, pose in poses(robot, dict(zip(joints, positions))).items():
        assert found[link] == pytest.approx(pose, abs=1e-12), link


def test_skew_axes_and_turned_origins(robot: Robot) -> None:
    """Axes and origins may point anywhere."""
    generator = np.random.default_rng(3)

    def turned(pose: Array) -> Array:
        tilt = np.eye(4)
        tilt[:3, :3] = from_rpy(*generator.uniform(-1, 1, 3))
        return pose @ tilt

    joints = tuple(
        replace(j, pose=turned(j.pose), axis=generator.normal(size=3)) for j in robot.joints
    )
    bent = replace(robot, joints=joints)
    names = tuple(joint.name for joint in bent.joints if joint.is_driven)
    positions = generator.uniform(-3.0, 3.0, len(names))
    found = posed(BodyModel.of(bent, names), positions)
    for link, pose in poses(bent, dict(zip(names, positions))).items():
        assert found[link] == pytest.approx(pose, abs=1e-12), link


def test_rotation_of_the_root(model: BodyModel) -> None:
    """A rotation of the root turns all bodies about its origin."""
    rotation, positions = from_rpy(0.3, -0.4, 2.0), np.linspace(-1.0, 1.0, len(model.joints))
    turn = np.eye(4)
    turn[:3, :3] = rotation
    upright = model.forward.poses(np.eye(3), positions)
    assert model.forward.poses(rotation, positions) == pytest.approx(turn @ upright, abs=1e-14)


def test_few_rounds(model: BodyModel) -> None:
    """Seven bodies in a row need three rounds."""
    assert len(ForwardKinematics.of(model.tree).jumps) == 3


def test_no_joints(robot: Robot) -> None:
    """A single body is where the root is."""
    assert posed(BodyModel.of(robot, ()), np.zeros(0))['base_link'].tolist() == np.eye(4).tolist()
