# SPDX-License-Identifier: Apache-2.0
"""Algebra of unit quaternions w, x, y, z, by the functions of MuJoCo."""

from __future__ import annotations

import math

from humanoid_control.backends import Array
import mujoco
import numpy as np

_UP: Array = np.array([0.0, 0.0, 1.0])


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
