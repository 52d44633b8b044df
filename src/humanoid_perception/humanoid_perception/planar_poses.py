# SPDX-License-Identifier: Apache-2.0
"""Poses in a plane, such as that of `odom` in the map: how they compose, and what they move."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

__all__ = ['Pose2', 'composed', 'offset_m', 'placed', 'shift_between']

Array = npt.NDArray[np.float64]
Pose2 = tuple[float, float, float]
"""A pose in a plane: x (m), y (m), yaw (rad)."""


def shift_between(old: Pose2, new: Pose2) -> Pose2:
    """
    Compute the planar motion that takes a frame, and everything attached to it, to its new pose.

    Parameters
    ----------
    old, new
        The poses of the frame: x (m), y (m), yaw (rad).

    Returns
    -------
    Pose2
        The motion in the parent frame: rotate about its origin by yaw, then translate by x and y.

    """
    yaw = math.remainder(new[2] - old[2], math.tau)
    c, s = math.cos(yaw), math.sin(yaw)
    return new[0] - c * old[0] + s * old[1], new[1] - s * old[0] - c * old[1], yaw


def composed(outer: Pose2, inner: Pose2) -> Pose2:
    """
    Compose two planar poses.

    Parameters
    ----------
    outer
        The first pose.
    inner
        The second pose, relative to the first one.

    """
    c, s = math.cos(outer[2]), math.sin(outer[2])
    return (
        outer[0] + c * inner[0] - s * inner[1],
        outer[1] + s * inner[0] + c * inner[1],
        math.remainder(outer[2] + inner[2], math.tau),
    )


def offset_m(shift: Pose2, at_m: Array) -> tuple[float, float]:
    """
    Compute how far in x and y a motion of a frame takes a point.

    Parameters
    ----------
    shift
        The motion, as from `shift_between`.
    at_m
        The point (3,), in the parent frame.

    """
    x, y, yaw = shift
    c, s = math.cos(yaw), math.sin(yaw)
    dx = c * at_m[0] - s * at_m[1] + x - at_m[0]
    return float(dx), float(s * at_m[0] + c * at_m[1] + y - at_m[1])


def placed(anchor: Pose2, position: Array, rotation: Array) -> tuple[Array, Array]:
    """
    Transform a pose into the parent frame.

    Parameters
    ----------
    anchor
        The pose of its frame in the parent frame.
    position, rotation
        The pose: position (3,) and rotation matrix (3, 3).

    Returns
    -------
    Array, Array
        The position and the rotation matrix in the parent frame.

    """
    c, s = math.cos(anchor[2]), math.sin(anchor[2])
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return turn @ position + np.array([anchor[0], anchor[1], 0.0]), turn @ rotation
