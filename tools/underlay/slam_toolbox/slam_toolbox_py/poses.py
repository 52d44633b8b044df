# SPDX-License-Identifier: Apache-2.0
"""Poses in the plane as arrays: x, y in m and yaw in rad in the last axis."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ['FloatArray', 'compose', 'inverse', 'relative', 'rotation', 'transform', 'wrap']

FloatArray = npt.NDArray[np.float64]


def wrap(angle_rad: FloatArray | float) -> FloatArray:
    """
    Wrap angles to the range from -pi, inclusive, to pi, exclusive.

    Parameters
    ----------
    angle_rad
        Angles of any shape, in rad.

    """
    wrapped: FloatArray = (np.asarray(angle_rad) + np.pi) % (2.0 * np.pi) - np.pi
    return wrapped


def compose(first: FloatArray, second: FloatArray) -> FloatArray:
    """
    Compose poses: express the second ones, given in the first ones, in their parent frame.

    Parameters
    ----------
    first, second
        (..., 3) arrays that broadcast.

    Returns
    -------
    (..., 3) array.

    """
    first, second = np.broadcast_arrays(first, second)
    cos, sin = np.cos(first[..., 2]), np.sin(first[..., 2])
    composed = np.empty(first.shape)
    composed[..., 0] = first[..., 0] + cos * second[..., 0] - sin * second[..., 1]
    composed[..., 1] = first[..., 1] + sin * second[..., 0] + cos * second[..., 1]
    composed[..., 2] = wrap(first[..., 2] + second[..., 2])
    return composed


def inverse(pose: FloatArray) -> FloatArray:
    """
    Invert poses.

    Parameters
    ----------
    pose
        Poses (..., 3) of inner frames in an outer one.

    Returns
    -------
    FloatArray
        Poses (..., 3) of the outer frame in the inner ones.

    """
    cos, sin = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    inverted = np.empty(pose.shape)
    inverted[..., 0] = -cos * pose[..., 0] - sin * pose[..., 1]
    inverted[..., 1] = sin * pose[..., 0] - cos * pose[..., 1]
    inverted[..., 2] = wrap(-pose[..., 2])
    return inverted


def relative(first: FloatArray, second: FloatArray) -> FloatArray:
    """
    Express poses relative to other ones.

    Parameters
    ----------
    first, second
        Poses (..., 3) in the same frame, which broadcast.

    Returns
    -------
    FloatArray
        The second poses (..., 3) in the first ones.

    """
    return compose(inverse(first), second)


def transform(pose: FloatArray, points: FloatArray) -> FloatArray:
    """
    Transform points from the frame of a pose to its parent frame.

    Parameters
    ----------
    pose
        (3,) array.
    points
        (N, 2) array in m.

    """
    placed: FloatArray = points @ rotation(pose[2]).T + pose[:2]
    return placed


def rotation(yaw_rad: float) -> FloatArray:
    """
    Build the rotation matrix (2, 2) of an angle.

    Parameters
    ----------
    yaw_rad
        The angle in rad.

    """
    cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
    return np.array([[cos, -sin], [sin, cos]])
