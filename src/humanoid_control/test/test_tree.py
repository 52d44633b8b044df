# SPDX-License-Identifier: Apache-2.0
"""Check the tables of a robot's bodies and joints, and groups of joints."""

from __future__ import annotations

from dataclasses import replace

from humanoid_control.dynamics import BodyModel, DynamicsError
from humanoid_control.dynamics.tree import Tree
from humanoid_description.robot import Joint, Mimic, Robot
import numpy as np
import pytest

ARM = ('left_shoulder', 'left_elbow', 'left_shoulder_roll', 'left_shoulder_yaw')


def with_joint(robot: Robot, joint: Joint) -> Robot:
    """Return a robot in which a joint is another one."""
    return replace(robot, joints=tuple(joint if j.name == joint.name else j for j in robot.joints))


def test_order_is_the_callers(robot: Robot) -> None:
    """The bodies have the order of the joints that were given; what moves what follows it."""
    tree = Tree.of(robot, ARM)
    assert tree.parents.tolist() == [0, 0, 4, 1, 3]
    assert tree.moves.tolist() == [
        [0, 0, 0, 0],
        [1, 0, 0, 0],
        [1, 1, 1, 1],
        [1, 0, 1, 0],
        [1, 0, 1, 1],
    ]


def test_carries(robot: Robot) -> None:
    """The root carries all, and a body itself and what hangs from it."""
    assert Tree.of(robot, ARM).carries.tolist() == [
        [1, 1, 1, 1, 1],
        [0, 1, 1, 1, 1],
        [0, 0, 1, 0, 0],
        [0, 0, 1, 1, 1],
        [0, 0, 1, 0, 1],
    ]


def test_fixed_links_are_part_of_bodies(robot: Robot) -> None:
    """Frames belong to the body that carries them, and no mass is lost."""
    tree = Tree.of(robot, ('waist_yaw', 'left_knee'))
    body = {name: mount.body for name, mount in tree.mounts.items()}
    assert (body['imu_link'], body['head'], body['l_sole'], body['r_sole']) == (0, 1, 2, 0)
    assert set(body) == set(robot.link)
    assert tree.inertias[:, 3, 3].sum() == pytest.approx(robot.mass_kg)


def test_axis_is_z_of_the_body(robot: Robot) -> None:
    """The frame of a body has its z along the axis of the joint, however this is scaled."""
    joint = replace(robot.joint['left_elbow'], axis=np.array([1.0, 2.0, 2.0]))
    tree = Tree.of(with_joint(robot, joint), ('left_elbow',))
    assert tree.placements[0, :3, 2] == pytest.approx([1 / 3, 2 / 3, 2 / 3])
    assert np.linalg.det(tree.placements[0]) == pytest.approx(1.0)


def test_no_joints(robot: Robot) -> None:
    """A robot of which no joint turns is one body."""
    tree = Tree.of(robot, ())
    assert (tree.placements.shape, tree.moves.shape) == ((0, 4, 4), (1, 0))
    assert tree.inertias[0, 3, 3] == pytest.approx(robot.mass_kg)


def test_unknown_joint(robot: Robot) -> None:
    """The joint that was meant is named."""
    with pytest.raises(DynamicsError, match=r"no joint 'left_kne'. Did you mean 'left_knee'\?"):
        Tree.of(robot, ('left_kne',))


def test_joint_twice(robot: Robot) -> None:
    """A joint cannot be at two places."""
    with pytest.raises(DynamicsError, match="'left_knee' is named twice"):
        Tree.of(robot, ('left_knee', 'left_knee'))


@pytest.mark.parametrize('kind', ['prismatic', 'fixed', 'floating'])
def test_joint_that_does_not_turn(robot: Robot, kind: str) -> None:
    """Only joints that turn are computed with."""
    joint = replace(robot.joint['left_knee'], kind=kind)
    with pytest.raises(DynamicsError, match=f"'left_knee' is {kind}, but only rotating joints"):
        Tree.of(with_joint(robot, joint), ('left_knee',))


def test_joint_that_mimics(robot: Robot) -> None:
    """A joint that follows another one has no motion of its own."""
    joint = replace(robot.joint['left_knee'], mimics=Mimic('right_knee'))
    with pytest.raises(DynamicsError, match="mimics 'right_knee'"):
        Tree.of(with_joint(robot, joint), ('left_knee',))


def test_several_roots(robot: Robot) -> None:
    """What falls apart is no robot."""
    parts = replace(robot, joints=tuple(j for j in robot.joints if j.name != 'left_knee'))
    with pytest.raises(DynamicsError, match=r'2 links without a parent \(base_link, left'):
        Tree.of(parts, ())


def test_no_mass(robot: Robot) -> None:
    """Mere frames have no dynamics."""
    frames = replace(robot, links=tuple(replace(link, body=None) for link in robot.links))
    with pytest.raises(DynamicsError, match='has no mass'):
        Tree.of(frames, ())


def test_group(model: BodyModel) -> None:
    """A group knows the indices of its joints, which carries which, and their armature."""
    group = model.group(['left_knee', 'left_hip_roll', 'right_knee'])
    assert group.indices.tolist() == [model.index(joint) for joint in group.joints]
    assert group.carries.tolist() == [[1, 0, 0], [1, 1, 0], [0, 0, 1]]
    assert group.armature_kgm2.tolist() == np.diag([0.04, 0.04, 0.04]).tolist()


def test_symmetric(model: BodyModel) -> None:
    """What is right of a matrix is on both sides, the rest zero; the diagonal stays."""
    group = model.group(['left_knee', 'left_hip_roll', 'right_knee'])
    below = np.array([[1.0, 99.0, 99.0], [2.0, 3.0, 99.0], [99.0, 99.0, 4.0]])
    assert group.symmetric(below).tolist() == [[1, 2, 0], [2, 3, 0], [0, 0, 4]]
