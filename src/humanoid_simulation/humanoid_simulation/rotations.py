# SPDX-License-Identifier: Apache-2.0
"""Rotations as unit quaternions w, x, y, z."""

from __future__ import annotations

import math

from humanoid_control.backends import Array
import mujoco
import numpy as np

_UP: Array = np.array([0.0, 0.0, 1.0])


def from_rpy(roll_rad: float, pitch_rad: float, yaw_rad: float) -> Array:
    """
    Convert roll, pitch and yaw to a quaternion.

    Parameters
    ----------
    roll_rad, pitch_rad, yaw_rad
        Rotations about the fixed axes x, y and z, in this order, as in a URDF.

    Returns
    -------
    Array
        Unit quaternion (4,).

    """
    cr, sr = math.cos(roll_rad / 2), math.sin(roll_rad / 2)
    cp, sp = math.cos(pitch_rad / 2), math.sin(pitch_rad / 2)
    cy, sy = math.cos(yaw_rad / 2), math.sin(yaw_rad / 2)
    return np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )


def product(first: Array, second: Array) -> Array:
    """
    Compose two rotations, of which the second one is applied first.

    Parameters
    ----------
    first, second
        Unit quaternions (4,): the left and the right factor of the product.

    Returns
    -------
    Array
        Unit quaternion (4,).

    """
    result = np.empty(4)
    mujoco.mju_mulQuat(result, first, second)
    return result


def rotated(vector: Array, rotation: Array) -> Array:
    """
    Rotate a vector.

    Parameters
    ----------
    vector
        (3,) in any unit, in the axes of a frame.
    rotation
        Unit quaternion (4,): the orientation of that frame in its parent.

    Returns
    -------
    Array
        (3,) in the same unit, in the axes of the parent.

    """
    result = np.empty(3)
    mujoco.mju_rotVecQuat(result, vector, rotation)
    return result


def heading_rad(rotation: Array) -> float:
    """
    Compute the heading of a body, even if it has fallen onto its face or back.

    The heading of a robot that lies on its face or back is the one that it had when it stood.

    Parameters
    ----------
    rotation
        Unit quaternion (4,) from the axes of the body, x forward and z up, to the world.

    Returns
    -------
    float
        Angle in rad about the vertical, from x of the world.

    """
    forward, up = rotated(np.array([1.0, 0.0, 0.0]), rotation), rotated(_UP, rotation)
    ahead = forward if abs(forward[2]) < 0.7 else -up * np.sign(forward[2])
    return math.atan2(ahead[1], ahead[0])


def inverse(rotation: Array) -> Array:
    """
    Invert a rotation.

    Parameters
    ----------
    rotation
        Unit quaternion (4,).

    Returns
    -------
    Array
        Its conjugate (4,).

    """
    return rotation * (1.0, -1.0, -1.0, -1.0)


def from_vector(vector_rad: Array) -> Array:
    """
    Convert a rotation vector to a quaternion.

    Parameters
    ----------
    vector_rad
        Axis of the rotation (3,), whose length is the angle.

    Returns
    -------
    Array
        Unit quaternion (4,).

    """
    angle = math.sqrt(vector_rad @ vector_rad)
    result = np.empty(4)
    axis = vector_rad / angle if angle > 0.0 else np.array([1.0, 0.0, 0.0])
    mujoco.mju_axisAngle2Quat(result, axis, angle)
    return result
