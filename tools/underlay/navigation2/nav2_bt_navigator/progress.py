# SPDX-License-Identifier: Apache-2.0
"""Progress of a navigation: the remaining path length and time."""

from __future__ import annotations

from typing import Any

from nav2_behavior_tree.geometry import distances_along_m, nearest_index
from nav2_util.geometry import path_poses, Pose2D

__all__ = ['PathProgress', 'time_left_s']

_LEAST_SPEED_M_S = 0.01
_LEAST_WAY_M = 0.1


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
