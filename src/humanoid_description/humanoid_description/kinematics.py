# SPDX-License-Identifier: Apache-2.0
"""
Forward kinematics, and the check of limbs whose inverse kinematics are solved in closed form.

Joint positions may be arrays; then so are the poses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from humanoid_description.errors import DescriptionError
from humanoid_description.robot import Array, Joint, named, Robot
import numpy as np

AT_ZERO: Mapping[str, float] = {}
_AXIS_TOLERANCE = 1e-9


def chain(robot: Robot, link: str, base: str | None = None) -> list[Joint]:
    """
    Return the joints of the kinematic chain from a base link to another link, in this order.

    Parameters
    ----------
    robot
        A model whose links and joints make a tree.
    link
        The link at the end of the chain.
    base
        The link at which it starts; the root if there is none, or if it is not above the link.

    """
    joints: list[Joint] = []
    while link != base and link in robot.joint_above:
        joints.append(robot.joint_above[link])
        link = joints[-1].parent
    return joints[::-1]


def pose_along(joints: list[Joint], positions: Mapping[str, Array | float]) -> Array:
    """
    Compute the forward kinematics of a chain.

    Parameters
    ----------
    joints
        The chain, from the base on.
    positions
        Joint positions by name, in rad or m, one or an array. Joints without one are at zero;
        those that mimic another follow that one's position, which may mimic a third one if it is
        in the chain.

    Returns
    -------
    Array
        The pose (4, 4) of the last link in the base; (..., 4, 4) for arrays of positions.

    """
    return _pose_along(joints, positions, {joint.name: joint for joint in joints})


def _pose_along(
    joints: list[Joint], positions: Mapping[str, Array | float], leaders: Mapping[str, Joint]
) -> Array:
    """Compute the forward kinematics of a chain whose joints mimic some of the leaders."""
    pose: Array = np.eye(4)
    for joint in joints:
        pose = pose @ joint.pose
        if joint.is_driven:
            pose = pose @ joint_motion(joint, _position(joint, positions, leaders))
    return pose


def poses(robot: Robot, positions: Mapping[str, Array | float] = AT_ZERO) -> dict[str, Array]:
    """
    Compute the forward kinematics of all links.

    Parameters
    ----------
    robot
        A model whose links and joints make a tree.
    positions
        Joint positions by name, as for `pose_along`; any joint of the model may be mimicked.

    Returns
    -------
    dict of Array
        The pose (4, 4) of each link in the root by its name; (..., 4, 4) for arrays of positions.

    """
    return {
        link.name: _pose_along(chain(robot, link.name), positions, robot.joint)
        for link in robot.links
    }


def joint_motion(joint: Joint, position: Array | float) -> Array:
    """
    Compute the motion of a joint: a rotation about its axis, or a translation along it.

    Parameters
    ----------
    joint
        A driven joint; its axis need not be a unit vector.
    position
        In rad, or m for a prismatic joint; one or an array (...).

    Returns
    -------
    Array
        The pose (..., 4, 4) of the child, relative to its pose at position zero.

    """
    position = np.asarray(position, dtype=np.float64)
    axis = joint.axis / np.linalg.norm(joint.axis)
    motion = np.zeros((*position.shape, 4, 4)) + np.eye(4)
    if joint.kind == 'prismatic':
        motion[..., :3, 3] = position[..., None] * axis
    else:
        motion[..., :3, :3] += _turn_less_identity(axis, position[..., None, None])
    return motion


def check_limb(
    limb: str, joints: Sequence[Joint], at_zero: Sequence[Array], axes: Mapping[str, str]
) -> None:
    """
    Check that a limb has the joints and axes that its inverse kinematics are made for.

    Parameters
    ----------
    limb
        What messages call it, such as `left leg`.
    joints
        Its joints, from the trunk on.
    at_zero
        The poses (4, 4) of their children in the root, at zero joint positions.
    axes
        The names that the joints must have, in this order, with the axis of the root about which
        each one must rotate at zero joint positions: `x`, `y` or `z`.

    Raises
    ------
    DescriptionError
        The joints or their axes differ.

    """
    found = [joint.name for joint in joints]
    if found != [*axes]:
        raise DescriptionError(
            f'The {limb} has the joints {", ".join(found) or "(none)"}, but needs '
            f'{", ".join(axes)}, in this order.'
        )
    for joint, pose, letter in zip(joints, at_zero, axes.values()):
        axis = np.eye(3)['xyz'.index(letter)]
        if not np.allclose(pose[:3, :3] @ joint.axis, axis, atol=_AXIS_TOLERANCE):
            raise DescriptionError(
                f'{named(joint)} must rotate about {letter} of the root link at the zero pose.'
            )


def _position(
    joint: Joint, positions: Mapping[str, Array | float], leaders: Mapping[str, Joint]
) -> Array | float:
    """Return the position of a joint; that of a mimic joint follows from the other joint."""
    name, mimics = joint.name, joint.mimics
    multiplier, offset = 1.0, 0.0
    for _ in range(len(leaders)):  # not for ever if they mimic each other in a circle
        if mimics is None or name in positions:
            break
        offset += multiplier * mimics.offset
        multiplier *= mimics.multiplier
        name = mimics.joint
        mimics = leaders[name].mimics if name in leaders else None
    return multiplier * positions.get(name, 0.0) + offset


def _turn_less_identity(axis: Array, angle: Array) -> Array:
    """Compute the rotation matrix about a unit axis minus the identity (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: Array = np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return turn
