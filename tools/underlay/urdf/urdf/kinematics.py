# SPDX-License-Identifier: Apache-2.0
"""
Forward kinematics of single joints: the pose of the child link in the parent link.

Transforms are composed along the tree by tf, not here. Most of the work is done once per joint, as
rotations about its axis are linear in the sine and cosine of half the angle.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, pi, sin

from urdf.robot_model import Joint, Vector

__all__ = ['Pose', 'joint_motion', 'joint_position', 'rotate', 'rotation_of']

Quaternion = tuple[float, float, float, float]
"""x, y, z, w."""
Pose = tuple[float, float, float, float, float, float, float]
"""Translation x, y, z in metres and rotation x, y, z, w."""

ROUNDING_RAD = 1e-6
"""How far an angle may be beyond a limit, since transforms are rounded."""


def joint_motion(joint: Joint) -> Callable[[float], Pose]:
    """
    Create the forward kinematics of one joint.

    Parameters
    ----------
    joint
        A joint of any type; fixed, floating and planar joints stay at their origin.

    Returns
    -------
    Callable
        Maps the position (rad or m) to the pose of the child link in the frame of the parent
        link: translation in m, quaternion x, y, z, w.

    """
    rotation = rotation_of(joint.origin.rpy)
    if joint.kind in ('revolute', 'continuous'):
        return _turning(joint.origin.xyz, rotation, joint.axis)
    if joint.kind == 'prismatic':
        return _sliding(joint.origin.xyz, rotation, joint.axis)
    pose = (*joint.origin.xyz, *rotation)
    return lambda position: pose


def joint_position(joint: Joint, pose: Pose) -> float:
    """
    Compute the position of a joint from the pose of its child link: the inverse of `joint_motion`.

    Parameters
    ----------
    joint
        A joint with a scalar position.
    pose
        The pose of the child link in the frame of the parent link: translation in m, quaternion
        x, y, z, w.

    Returns
    -------
    float
        The position, in rad or m. An angle is within the limits of the joint if one of its full
        turns is, otherwise from -pi to pi.

    """
    x, y, z, w = rotation_of(joint.origin.rpy)
    back = (-x, -y, -z, w)
    if joint.kind == 'prismatic':
        px, py, pz = (there - here for there, here in zip(pose[:3], joint.origin.xyz))
        return _dot(joint.axis, rotate(back, (px, py, pz)))
    tx, ty, tz, tw = product(back, pose[3:])
    angle = 2.0 * atan2(_dot(joint.axis, (tx, ty, tz)), tw)
    turns = (angle, angle - 2.0 * pi, angle + 2.0 * pi)
    limits = joint.limits
    if limits is not None:
        for each in turns:
            if limits.lower - ROUNDING_RAD <= each <= limits.upper + ROUNDING_RAD:
                return each
    return min(turns, key=abs)


def _dot(left: Vector, right: Vector) -> float:
    return sum(a * b for a, b in zip(left, right))


def _turning(at: Vector, rotation: Quaternion, axis: Vector) -> Callable[[float], Pose]:
    """Return the motion of a revolute or continuous joint."""
    px, py, pz = at
    ax, ay, az, aw = rotation
    bx, by, bz, bw = product(rotation, (*axis, 0.0))

    def pose(position: float) -> Pose:
        s, c = sin(position / 2.0), cos(position / 2.0)
        return px, py, pz, c * ax + s * bx, c * ay + s * by, c * az + s * bz, c * aw + s * bw

    return pose


def _sliding(at: Vector, rotation: Quaternion, axis: Vector) -> Callable[[float], Pose]:
    """Return the motion of a prismatic joint."""
    px, py, pz = at
    dx, dy, dz = rotate(rotation, axis)

    def pose(position: float) -> Pose:
        return px + position * dx, py + position * dy, pz + position * dz, *rotation

    return pose


def rotation_of(rpy: Vector) -> Quaternion:
    """
    Convert roll, pitch and yaw to a quaternion.

    Parameters
    ----------
    rpy
        Rotations about the fixed axes x, then y, then z, in rad.

    Returns
    -------
    Quaternion
        x, y, z, w.

    """
    turns: list[Quaternion] = [
        (sin(rpy[0] / 2.0), 0.0, 0.0, cos(rpy[0] / 2.0)),
        (0.0, sin(rpy[1] / 2.0), 0.0, cos(rpy[1] / 2.0)),
        (0.0, 0.0, sin(rpy[2] / 2.0), cos(rpy[2] / 2.0)),
    ]
    return product(turns[2], product(turns[1], turns[0]))


def rotate(rotation: Quaternion, vector: Vector) -> Vector:
    """
    Rotate a vector by a quaternion.

    Parameters
    ----------
    rotation
        Quaternion x, y, z, w of length 1.
    vector
        x, y, z.

    """
    x, y, z, w = rotation
    turned = product(product(rotation, (*vector, 0.0)), (-x, -y, -z, w))
    return turned[0], turned[1], turned[2]


def product(left: Quaternion, right: Quaternion) -> Quaternion:
    """
    Multiply two quaternions: rotate by `right`, then by `left`, about fixed axes.

    Parameters
    ----------
    left, right
        Quaternions x, y, z, w.

    """
    ax, ay, az, aw = left
    bx, by, bz, bw = right
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )
