# SPDX-License-Identifier: Apache-2.0
"""Rotations as unit quaternions w, x, y, z."""

from __future__ import annotations

import math

from humanoid_control.backends import Array
import mujoco
import numpy as np

_UP: Array = np.array([0.0, 0.0, 1.0])


def from_rpy(roll_rad: float, pitch_rad: float, yaw_rad: float) -> Array:
    """Return the rotation that rolls, then pitches, then yaws, about fixed axes, as in a URDF."""
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
    """Return the rotation that does the second one, and then the first."""
    result = np.empty(4)
    mujoco.mju_mulQuat(result, first, second)
    return result


def rotated(vector: Array, rotation: Array) -> Array:
    """Return a vector (3,), rotated."""
    result = np.empty(3)
    mujoco.mju_rotVecQuat(result, vector, rotation)
    return result


def heading_rad(rotation: Array) -> float:
    """Return where a body looks along the ground, or where its top points if it lies."""
    forward, up = rotated(np.array([1.0, 0.0, 0.0]), rotation), rotated(_UP, rotation)
    ahead = forward if abs(forward[2]) < 0.7 else -up * np.sign(forward[2])
    return math.atan2(ahead[1], ahead[0])


def inverse(rotation: Array) -> Array:
    """Return the rotation back."""
    return rotation * (1.0, -1.0, -1.0, -1.0)


def from_vector(vector_rad: Array) -> Array:
    """Return the rotation about a vector (3,) by its length."""
    angle = math.sqrt(vector_rad @ vector_rad)
    result = np.empty(4)
    axis = vector_rad / angle if angle > 0.0 else np.array([1.0, 0.0, 0.0])
    mujoco.mju_axisAngle2Quat(result, axis, angle)
    return result
