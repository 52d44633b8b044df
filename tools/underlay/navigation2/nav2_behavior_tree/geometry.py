# SPDX-License-Identifier: Apache-2.0
"""Measure and cut paths, arrays (N, 3) of x, y (m) and yaw (rad); what is left of them."""

from __future__ import annotations

from typing import Any

from nav2_util.geometry import path_poses, Pose2D
import numpy as np
import numpy.typing as npt

__all__ = [
    'PathProgress',
    'distances_along_m',
    'nearest_index',
    'path_length_m',
    'remaining_m',
    'time_left_s',
    'within',
]

FloatArray = npt.NDArray[np.float64]

_LEAST_SPEED_M_S = 0.01
_LEAST_WAY_M = 0.1


def distances_along_m(poses: FloatArray) -> FloatArray:
    """
    Compute the cumulative length of a path at each pose.

    Parameters
    ----------
    poses
        Poses (N, 3): x, y (m) and yaw (rad); may be empty.

    Returns
    -------
    numpy.ndarray
        Lengths (N,) in m from the first pose on.

    """
    if not len(poses):
        return np.zeros(0)
    steps = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    return np.concatenate(([0.0], np.cumsum(steps)))


def path_length_m(poses: FloatArray) -> float:
    """
    Compute the length of a path.

    Parameters
    ----------
    poses
        Poses (N, 3): x, y (m) and yaw (rad); may be empty.

    Returns
    -------
    float
        The length in m; 0 for an empty path.

    """
    return float(distances_along_m(poses)[-1]) if len(poses) else 0.0


def nearest_index(
    poses: FloatArray, robot: Pose2D, angular_weight: float = 0.0, start: int = 0
) -> int:
    """
    Find the pose of a path that is nearest to the robot.

    Parameters
    ----------
    poses
        (N, 3) array, not empty.
    robot
        The pose of the robot in the frame of the path.
    angular_weight
        The weight of the heading difference in m/rad.
    start
        The index of the first pose to consider.

    """
    rest = poses[start:]
    distances = np.hypot(rest[:, 0] - robot.x, rest[:, 1] - robot.y)
    if angular_weight:
        turn = np.abs((rest[:, 2] - robot.yaw + np.pi) % (2.0 * np.pi) - np.pi)
        distances = distances + angular_weight * turn
    return start + int(np.argmin(distances))


def remaining_m(poses: FloatArray, robot: Pose2D) -> float:
    """
    Compute the remaining length of a path from the pose nearest to the robot.

    Parameters
    ----------
    poses
        Poses (N, 3): x, y (m) and yaw (rad); may be empty.
    robot
        The pose of the robot in the frame of the path.

    Returns
    -------
    float
        The length in m; 0 for an empty path.

    """
    if not len(poses):
        return 0.0
    along = distances_along_m(poses)
    return float(along[-1] - along[nearest_index(poses, robot)])


def within(poses: FloatArray, at: int, forward_m: float, backward_m: float) -> tuple[int, int]:
    """
    Find the range of poses near a pose along the path: the first, and one past the last.

    Parameters
    ----------
    poses
        (N, 3) array, not empty.
    at
        The index of the pose from which distances are measured.
    forward_m, backward_m
        The distances in m; a negative forward distance means no limit.

    """
    along = distances_along_m(poses)
    first = int(np.searchsorted(along, along[at] - backward_m, 'left'))
    if forward_m < 0.0:
        return first, len(poses)
    return first, int(np.searchsorted(along, along[at] + forward_m, 'right'))


class PathProgress:
    """Tracker of the remaining path length; it converts each path once."""

    def __init__(self) -> None:
        self._path: Any = None

    def remaining_m(self, path: Any, robot: Pose2D) -> float:
        """
        Compute the length of the path from the robot on, in m.

        Parameters
        ----------
        path
            A `nav_msgs/Path`, or None if there is none yet.
        robot
            The robot's pose in the frame of the path.

        """
        if path is None or not path.poses:
            return 0.0
        if path is not self._path:
            self._path, self._poses = path, path_poses(path)
            self._along = distances_along_m(self._poses)
        near = nearest_index(self._poses, robot)
        return float(self._along[-1] - self._along[near])


def time_left_s(way_m: float, speed_m_s: float) -> float:
    """
    Estimate the time to travel the remaining path.

    Parameters
    ----------
    way_m
        The remaining length in m.
    speed_m_s
        The speed in m/s; its sign is ignored.

    Returns
    -------
    float
        The time in s; 0 if the robot is stationary, or almost at the goal.

    """
    if abs(speed_m_s) < _LEAST_SPEED_M_S or way_m < _LEAST_WAY_M:
        return 0.0
    return way_m / abs(speed_m_s)
