# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics, compared with that of two libraries."""

from __future__ import annotations

import io
from pathlib import Path
import random
import re

import numpy as np
import pytest
from random_robots import random_urdf
from robot_state_publisher.moving_links import MovingLinks, UnusableStateError
from urdf import parse_urdf, RobotModel
from urdf.kinematics import joint_motion, Pose

TOLERANCE = 1e-9
HUMANOID = Path(__file__).parents[4] / 'src/humanoid_description/urdf/humanoid.urdf.xacro'


def humanoid() -> str:
    """Return the URDF of the humanoid."""
    xacro = pytest.importorskip('xacro')
    return str(xacro.process_file(str(HUMANOID)).toxml())


ROBOTS = [humanoid, *(lambda seed=seed: random_urdf(seed) for seed in range(8))]


def matrix(pose: Pose) -> np.ndarray:
    """Return a pose as a 4x4 matrix."""
    x, y, z, w = pose[3:]
    result = np.eye(4)
    result[:3, 3] = pose[:3]
    result[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return result


def link_frames(model: RobotModel, positions: dict[str, float]) -> dict[str, np.ndarray]:
    """Return where each link is in the frame of the root, composed from the local poses."""
    moving = MovingLinks(model, list(positions))
    local = {
        joint.child: (joint.parent, matrix(pose))
        for joint, pose in zip(moving.joints, moving.poses(list(positions.values())))
    }
    for joint in model.joints:
        if not joint.moves:
            local[joint.child] = joint.parent, matrix(joint_motion(joint)(0.0))
    frames = {model.root: np.eye(4)}
    while len(frames) < len(model.links):
        for child, (parent, transform) in local.items():
            if parent in frames:
                frames[child] = frames[parent] @ transform
    return frames


def random_positions(model: RobotModel, seed: int) -> dict[str, float]:
    """Return a position for each joint that follows no other."""
    chance = random.Random(seed)
    return {joint.name: chance.uniform(-4, 4) for joint in model.moving_joints if not joint.mimic}


def all_positions(model: RobotModel, positions: dict[str, float]) -> dict[str, float]:
    """Return the positions of all moving joints, those that follow others by recursion."""

    def position(name: str) -> float:
        mimic = model.mimics.get(name)
        if mimic is None:
            return positions[name]
        return mimic.multiplier * position(mimic.joint) + mimic.offset

    return {joint.name: position(joint.name) for joint in model.moving_joints}


@pytest.mark.parametrize('robot', ROBOTS)
def test_links_are_where_pinocchio_says(robot) -> None:
    """All frames agree with those of pin for random positions."""
    pin = pytest.importorskip('pinocchio')
    text = robot()
    model = parse_urdf(text)
    theirs = pin.buildModelFromXML(text)
    for seed in range(5):
        positions = random_positions(model, seed)
        q = pin.neutral(theirs)
        for name, value in all_positions(model, positions).items():
            joint = theirs.joints[theirs.getJointId(name)]
            ours = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]
            q[joint.idx_q + np.arange(joint.nq)] = ours
        data = theirs.createData()
        pin.framesForwardKinematics(theirs, data, q)
        for link, frame in link_frames(model, positions).items():
            expected = data.oMf[theirs.getFrameId(link, pin.FrameType.BODY)].homogeneous
            np.testing.assert_allclose(frame, expected, rtol=0, atol=TOLERANCE, err_msg=link)


@pytest.mark.parametrize('robot', ROBOTS)
def test_links_are_where_yourdfpy_says(robot) -> None:
    """All frames agree with those of yourdfpy for random positions."""
    yourdfpy = pytest.importorskip('yourdfpy')
    text = robot()
    model = parse_urdf(text)
    theirs = yourdfpy.URDF.load(
        # It follows no chains, so each joint gets its own position.
        io.BytesIO(re.sub('<mimic [^>]*>', '', text).encode()),
        load_meshes=False,
        build_scene_graph=True,
    )
    for seed in range(5):
        positions = random_positions(model, seed)
        frames = link_frames(model, positions)
        theirs.update_cfg(all_positions(model, positions))
        for link, frame in frames.items():
            expected = theirs.get_transform(link, model.root)
            np.testing.assert_allclose(frame, expected, rtol=0, atol=TOLERANCE, err_msg=link)


def test_a_position_of_a_follower_itself_counts_more() -> None:
    """What a joint state says of a mimicking joint is above what it would follow."""
    model = parse_urdf(CHAIN)
    moving = MovingLinks(model, ['a', 'b'])
    heights = {joint.name: pose[0] for joint, pose in zip(moving.joints, moving.poses([1.0, 5.0]))}
    assert heights == pytest.approx({'a': 1.0, 'b': 5.0, 'c': 3.0 * 5.0 - 1.0})


def test_followers_of_followers_move() -> None:
    """Multipliers and offsets of a chain of followers combine."""
    model = parse_urdf(CHAIN)
    moving = MovingLinks(model, ['other', 'a'])
    places = [pose[0] for pose in moving.poses([9.0, 1.0])]
    assert [joint.name for joint in moving.joints] == ['c', 'b', 'a']
    assert places == pytest.approx([3.0 * (2.0 * 1.0 + 0.5) - 1.0, 2.0 * 1.0 + 0.5, 1.0])


def test_joints_that_are_not_named_do_not_move() -> None:
    """Names that are no joints, or of which nothing follows, move nothing."""
    moving = MovingLinks(parse_urdf(CHAIN), ['other', 'c'])
    assert [joint.name for joint in moving.joints] == ['c']


@pytest.mark.parametrize('kind', ['prismatic', 'revolute'])
def test_followers_beyond_all_numbers_are_refused(kind: str) -> None:
    """A position that becomes infinite for a follower has no pose; large ones have."""
    moving = MovingLinks(parse_urdf(CHAIN.replace('prismatic', kind)), ['a', 'other'])
    assert len(moving.poses([1e300, 1.0])) == 3
    with pytest.raises(UnusableStateError, match="positions of 'c', 'b' would not be"):
        moving.poses([1.7e308, 1.0])


def slider(name: str, parent: str, mimic: str = '') -> str:
    """Return a joint that slides along x, and its child link of the same name."""
    return (
        f'<link name="{name}"/><joint name="{name}" type="prismatic"><parent link="{parent}"/>'
        f'<child link="{name}"/><limit lower="-9" upper="9"/>{mimic}</joint>'
    )


# In the order of the URDF, followers come before what they follow.
CHAIN = (
    '<robot name="chain"><link name="root"/>'
    + slider('c', 'root', '<mimic joint="b" multiplier="3" offset="-1"/>')
    + slider('b', 'root', '<mimic joint="a" multiplier="2" offset="0.5"/>')
    + slider('a', 'root')
    + '</robot>'
)
