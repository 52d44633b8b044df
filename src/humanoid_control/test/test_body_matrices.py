# SPDX-License-Identifier: Apache-2.0
"""Check the matrices and the poses of bodies against sums and chains."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from humanoid_control.dynamics import BodyModel
from humanoid_control.dynamics.body_matrices import axial, BodyMatrices
from humanoid_control.dynamics.tree import ForwardKinematics
from humanoid_description.kinematics import poses
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy
import numpy as np
import pytest

Array = np.ndarray[Any, Any]


@pytest.fixture(name='matrices', scope='module')
def _matrices(model: BodyModel) -> BodyMatrices:
    """Return the humanoid in a random motion."""
    generator = np.random.default_rng(8)
    positions, velocities = generator.normal(size=(2, len(model.joints)))
    rotation = from_rpy(0.3, -0.4, 2.0)
    return model.state(rotation, generator.normal(size=3), positions, velocities).matrices


def test_screws_leave_their_axis_in_place(matrices: BodyMatrices) -> None:
    """A joint moves no point of its axis, and turns about it at unit rate."""
    for screw, pose in zip(matrices.screws, matrices.poses[1:]):
        axis, origin = pose[:, 2], pose[:, 3]
        assert screw @ (origin + 0.7 * axis) == pytest.approx(np.zeros(4), abs=1e-12)
        assert axial(screw) / 2 == pytest.approx(axis[:3])


def test_twist_of_a_child(matrices: BodyMatrices) -> None:
    """A body moves as its parent does, and by its own joint."""
    tree = matrices.tree
    for joint, rate in enumerate(matrices.velocities_rad_s):
        parent = matrices.twists[tree.parents[joint + 1]]
        expected = parent + matrices.screws[joint] * rate
        assert matrices.twists[joint + 1] == pytest.approx(expected)


def test_root_carries_all(matrices: BodyMatrices) -> None:
    """Mass and forces at the root are those of all bodies together; a hand has only its own."""
    whole = matrices.inertias.sum(axis=0)
    assert matrices.composites[0] == pytest.approx(whole)
    assert whole[3, 3] == pytest.approx(matrices.tree.mass_kg)
    forces = matrices.accelerations @ matrices.inertias
    assert matrices.forces[0] == pytest.approx(forces.sum(axis=0))
    last = 1 + matrices.tree.joints.index('left_elbow')
    assert matrices.forces[last] == pytest.approx(forces[last])


def test_axial() -> None:
    """A force at a point has the torque of the cross product."""
    point, force = np.array([1.0, 2.0, 3.0]), np.array([-4.0, 5.0, 7.0])
    assert axial(np.outer(force, point)) == pytest.approx(np.cross(point, force))


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
