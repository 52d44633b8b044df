# SPDX-License-Identifier: Apache-2.0
"""
Rotation matrices (3, 3) and quaternions from a frame to its parent, and their conversions.

Quaternions are w, x, y, z; roll, pitch and yaw are about the fixed x, y and z, in this order.
"""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_description.robot import Array
import numpy as np


def from_quaternion(quaternion: Sequence[float] | Array) -> Array:
    """
    Convert a quaternion to a rotation matrix (3, 3).

    Parameters
    ----------
    quaternion
        w, x, y, z, of any norm but zero.

    Raises
    ------
    ValueError
        The norm is zero or not finite.

    """
    w, x, y, z = map(float, quaternion)
    square = w * w + x * x + y * y + z * z
    if not 0.0 < square < math.inf:
        raise ValueError(
            f'The quaternion w, x, y, z = {w}, {x}, {y}, {z} is not a rotation: its length must '
            'be finite and not zero. Give one of length 1.'
        )
    s = 2.0 / square
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
        ]
    )


def from_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """
    Convert roll, pitch and yaw to a rotation matrix (3, 3).

    Parameters
    ----------
    roll, pitch, yaw
        Angles in rad about the fixed x, y and z, in this order.

    """
    cr, sr = math.cos(roll), math.sin(roll)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def about_x(angle: float) -> Array:
    """
    Compute the rotation matrix (3, 3) about the x axis.

    Parameters
    ----------
    angle
        In rad, by the right-hand rule.

    """
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def about_y(angle: float) -> Array:
    """
    Compute the rotation matrix (3, 3) about the y axis.

    Parameters
    ----------
    angle
        In rad, by the right-hand rule.

    """
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def about_z(angle: float) -> Array:
    """
    Compute the rotation matrix (3, 3) about the z axis.

    Parameters
    ----------
    angle
        In rad, by the right-hand rule.

    """
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def about_axis(axis: Array, angle: float) -> Array:
    """
    Compute the rotation matrix (3, 3) about any axis by Rodrigues' formula.

    Parameters
    ----------
    axis
        Unit vector (3,).
    angle
        In rad, by the right-hand rule.

    """
    cross = skew(axis)
    rotation: Array = (
        np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
    )
    return rotation


def to_rpy(rotation: Array) -> tuple[float, float, float]:
    """
    Convert a rotation matrix to roll, pitch and yaw.

    Parameters
    ----------
    rotation
        The matrix (3, 3).

    Returns
    -------
    tuple[float, float, float]
        Angles in rad about the fixed x, y and z; the pitch is between -pi/2 and pi/2.

    """
    (r00, _, _), (r10, _, _), (r20, r21, r22) = rotation.tolist()
    return math.atan2(r21, r22), math.atan2(-r20, math.hypot(r21, r22)), math.atan2(r10, r00)


def yaw_of(rotation: Array) -> float:
    """
    Extract the yaw of a rotation in rad: the heading of its x axis, seen from above.

    Parameters
    ----------
    rotation
        The matrix (3, 3).

    """
    return math.atan2(rotation[1, 0], rotation[0, 0])


def exp(rotation_vector: Array) -> Array:
    """
    Convert a rotation vector to a rotation matrix (3, 3) by Rodrigues' formula.

    Parameters
    ----------
    rotation_vector
        The axis (3,); its length is the angle in rad.

    """
    angle = math.sqrt(rotation_vector @ rotation_vector)
    turn = skew(rotation_vector)
    # sin(a) / a and (1 - cos(a)) / a^2 by numpy's sinc, which is also defined at zero.
    sine = float(np.sinc(angle / np.pi))
    half = float(np.sinc(angle / 2.0 / np.pi))
    rotation: Array = np.eye(3) + sine * turn + 0.5 * half * half * (turn @ turn)
    return rotation


def log(rotation: Array) -> Array:
    """
    Convert a rotation matrix to a rotation vector.

    Parameters
    ----------
    rotation
        The matrix (3, 3).

    Returns
    -------
    Array
        The axis (3,); its length is the angle in rad, at most half a turn.

    """
    (a, b, c), (d, e, f), (g, h, i) = rotation.tolist()
    # The quaternion from its largest component, which is well conditioned for all rotations.
    candidates = (
        (1.0 + a + e + i, h - f, c - g, d - b),
        (h - f, 1.0 + a - e - i, b + d, c + g),
        (c - g, b + d, 1.0 - a + e - i, f + h),
        (d - b, c + g, f + h, 1.0 - a - e + i),
    )
    w, x, y, z = max(enumerate(candidates), key=lambda item: item[1][item[0]])[1]
    length = math.sqrt(x * x + y * y + z * z)
    if length == 0.0:
        return np.zeros(3)
    scale = 2.0 * math.atan2(math.copysign(length, w), abs(w)) / length
    return np.array([x * scale, y * scale, z * scale])


def quaternion_of(rotation: Array) -> tuple[float, float, float, float]:
    """
    Convert a rotation matrix to a unit quaternion.

    Parameters
    ----------
    rotation
        The rotation matrix (3, 3).

    Returns
    -------
    tuple of float
        The quaternion w, x, y, z, with w not negative.

    """
    turn = log(rotation)
    half_rad = math.sqrt(turn @ turn) / 2.0
    x, y, z = (turn * (float(np.sinc(half_rad / math.pi)) / 2.0)).tolist()
    return math.cos(half_rad), x, y, z


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """
    Convert roll, pitch and yaw to a quaternion.

    Parameters
    ----------
    roll, pitch, yaw
        Angles in rad about the fixed x, y and z, in this order, as in a URDF.

    Returns
    -------
    Array
        Unit quaternion (4,): w, x, y, z.

    """
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )


def quaternion_from_vector(rotation_vector: Array) -> Array:
    """
    Convert a rotation vector to a quaternion.

    Parameters
    ----------
    rotation_vector
        The axis (3,); its length is the angle in rad.

    Returns
    -------
    Array
        Unit quaternion (4,): w, x, y, z.

    """
    angle = math.sqrt(rotation_vector @ rotation_vector)
    if angle == 0.0:
        return np.array([1.0, 0.0, 0.0, 0.0])
    sine = math.sin(angle * 0.5)
    x, y, z = (rotation_vector / angle).tolist()
    return np.array([math.cos(angle * 0.5), x * sine, y * sine, z * sine])


def skew(vector: Array) -> Array:
    """
    Build the skew-symmetric matrix (3, 3) of the cross product with a vector.

    Parameters
    ----------
    vector
        The left factor (3,): `skew(a) @ b` is a x b.

    """
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def wrap_angle(angle: float) -> float:
    """
    Wrap an angle to the range from -pi (included) to pi (excluded).

    Parameters
    ----------
    angle
        In rad.

    """
    return (angle + math.pi) % (2.0 * math.pi) - math.pi
