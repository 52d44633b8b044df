# SPDX-License-Identifier: Apache-2.0
"""Where the robot has to be at a dock that a sensor has detected."""

from __future__ import annotations

import math

from geometry_msgs.msg import Pose, Transform
from nav2_util.geometry import angle_between, Pose2D, wrap_angle
import numpy as np
import numpy.typing as npt

__all__ = ['PoseFilter', 'docking_pose', 'quaternion_of_angles']

FloatArray = npt.NDArray[np.float64]


class PoseFilter:
    """
    Low-pass filter of poses in the plane.

    Parameters
    ----------
    coefficient
        The weight of a new pose, from 0 to 1.
    timeout_s
        After a gap of this duration, the filter starts anew.

    """

    def __init__(self, coefficient: float, timeout_s: float) -> None:
        self._coefficient, self._timeout_s = coefficient, timeout_s
        self._pose: Pose2D | None = None
        self._time_s = -math.inf

    def update(self, pose: Pose2D, time_s: float) -> Pose2D:
        """
        Filter a pose.

        Parameters
        ----------
        pose
            The measured pose.
        time_s
            Its time; a pose that is not newer than the last one changes nothing.

        Returns
        -------
        Pose2D
            The filtered pose.

        """
        old = self._pose
        if old is None or not 0.0 <= time_s - self._time_s <= self._timeout_s:
            self._pose, self._time_s = pose, time_s
            return pose
        if time_s > self._time_s:
            share = self._coefficient
            old = Pose2D(
                old.x + share * (pose.x - old.x),
                old.y + share * (pose.y - old.y),
                wrap_angle(old.yaw + share * angle_between(old.yaw, pose.yaw)),
            )
            self._pose, self._time_s = old, time_s
        return old


def quaternion_of_angles(roll_rad: float, pitch_rad: float, yaw_rad: float) -> FloatArray:
    """
    Compute the quaternion (x, y, z, w) of rotations about the fixed axes x, y and z in turn.

    Parameters
    ----------
    roll_rad, pitch_rad, yaw_rad
        The angles.

    """
    about = np.eye(3)
    found = np.array([0.0, 0.0, 0.0, 1.0])
    for axis, angle in zip(about, (roll_rad, pitch_rad, yaw_rad)):
        turn = np.append(math.sin(0.5 * angle) * axis, math.cos(0.5 * angle))
        found = _product(turn, found)
    return found


def docking_pose(
    detected: Pose, to_fixed: Transform, turn: FloatArray, x_m: float, y_m: float
) -> Pose2D:
    """
    Compute the pose of the docked robot from the pose of what was detected, such as a tag.

    Parameters
    ----------
    detected
        The detected pose in the frame of the sensor.
    to_fixed
        The transform from that frame to the fixed one.
    turn
        The quaternion (x, y, z, w) from the orientation of the dock to the detected one: the
        rotated x axis is the heading of the docked robot.
    x_m, y_m
        The docked robot relative to what was detected, along that heading and to its left.

    Returns
    -------
    Pose2D
        In the fixed frame.

    """
    frame = _array(to_fixed.rotation)
    place = _rotated(frame, _vector(detected.position)) + _vector(to_fixed.translation)
    heading = _rotated(
        _product(_product(frame, _array(detected.orientation)), turn), np.array([1.0, 0.0, 0.0])
    )
    dock = Pose2D(float(place[0]), float(place[1]), math.atan2(heading[1], heading[0]))
    return dock @ Pose2D(x_m, y_m, 0.0)


def _vector(value: object) -> FloatArray:
    return np.array([getattr(value, axis) for axis in 'xyz'])


def _array(value: object) -> FloatArray:
    return np.array([getattr(value, axis) for axis in 'xyzw'])


def _product(left: FloatArray, right: FloatArray) -> FloatArray:
    u, w = left[:3], left[3]
    v, r = right[:3], right[3]
    return np.append(w * v + r * u + np.cross(u, v), w * r - u @ v)


def _rotated(quaternion: FloatArray, vector: FloatArray) -> FloatArray:
    u, w = quaternion[:3], quaternion[3]
    across = 2.0 * np.cross(u, vector)
    return np.asarray(vector + w * across + np.cross(u, across))
