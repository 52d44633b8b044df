# SPDX-License-Identifier: Apache-2.0
"""Path tracking: progress along the path, and the part of it that the controller sees."""

from __future__ import annotations

import math

from nav2_costmap_2d.grid import Costmap2D
from nav2_util.geometry import Pose2D
import numpy as np
import numpy.typing as npt

__all__ = ['PlanTracker', 'densified', 'path_lengths', 'transform_poses']

FloatArray = npt.NDArray[np.float64]

_SPACING_M = 0.05


def path_lengths(poses: FloatArray) -> FloatArray:
    """
    Compute the cumulative length of a path at each pose.

    Parameters
    ----------
    poses
        Poses (N, 2 or more), x and y first, in m.

    Returns
    -------
    numpy.ndarray
        Lengths (N,) in m from the first pose on.

    """
    lengths = np.zeros(len(poses))
    if len(poses) > 1:
        np.cumsum(np.hypot(np.diff(poses[:, 0]), np.diff(poses[:, 1])), out=lengths[1:])
    return lengths


def densified(poses: FloatArray, spacing_m: float = _SPACING_M) -> FloatArray:
    """
    Densify a sparse path by linear interpolation.

    Parameters
    ----------
    poses
        (N, 3) array of x, y (m) and yaw (rad).
    spacing_m
        The maximum distance of neighbours afterwards.

    Returns
    -------
    (M, 3) poses, which include the given ones.

    """
    if len(poses) < 2:
        return np.array(poses)
    gaps = np.hypot(np.diff(poses[:, 0]), np.diff(poses[:, 1]))
    counts = np.maximum(np.ceil(gaps / spacing_m - 1e-6), 1.0)
    if (counts == 1.0).all():
        return np.array(poses)
    at = np.concatenate([[0.0], np.cumsum(counts)])
    every = np.arange(int(at[-1]) + 1)
    columns = [np.interp(every, at, column) for column in (*poses.T[:2], np.unwrap(poses[:, 2]))]
    return np.column_stack(columns)


def transform_poses(poses: FloatArray, frame: Pose2D) -> FloatArray:
    """
    Transform poses to the parent of their frame.

    Parameters
    ----------
    poses
        Poses (N, 3): x, y (m) and yaw (rad), in a frame.
    frame
        The pose of that frame in its parent.

    Returns
    -------
    numpy.ndarray
        New poses (N, 3) in the parent; their yaw is not wrapped.

    """
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    moved = np.empty_like(poses)
    moved[:, 0] = frame.x + cos * poses[:, 0] - sin * poses[:, 1]
    moved[:, 1] = frame.y + sin * poses[:, 0] + cos * poses[:, 1]
    moved[:, 2] = poses[:, 2] + frame.yaw
    return moved


class PlanTracker:
    """
    Tracker of the robot's progress along a path.

    Parameters
    ----------
    poses
        (N, 3) array of x, y (m) and yaw (rad), at least one, in the frame of the path.

    """

    def __init__(self, poses: FloatArray) -> None:
        self.poses = densified(poses)
        self.lengths = path_lengths(self.poses)
        self.index = 0
        """The index of the pose nearest to the robot."""

    @property
    def goal(self) -> Pose2D:
        """Return the last pose."""
        return Pose2D(*map(float, self.poses[-1]))

    @property
    def remaining_m(self) -> float:
        """Return the remaining length of the path from the nearest pose on."""
        return float(self.lengths[-1] - self.lengths[self.index])

    def advance(self, position: Pose2D, search_m: float = math.inf) -> None:
        """
        Find the pose nearest to the robot, starting from the last one found.

        Parameters
        ----------
        position
            The robot in the frame of the path.
        search_m
            The search distance along the path; shorter than any loop of it.

        """
        end = len(self.poses)
        if math.isfinite(search_m):
            end = int(np.searchsorted(self.lengths, self.lengths[self.index] + search_m, 'right'))
        part = self.poses[slice(self.index, max(end, self.index + 1))]
        squared = (part[:, 0] - position.x) ** 2 + (part[:, 1] - position.y) ** 2
        self.index += int(np.argmin(squared))

    def visible(self, frame: Pose2D, grid: Costmap2D) -> tuple[FloatArray, bool]:
        """
        Get the path from the nearest pose to where it leaves the costmap.

        Parameters
        ----------
        frame
            The frame of the path in that of the costmap.
        grid
            The costmap.

        Returns
        -------
        (N, 3) poses in the frame of the costmap, at least one, and whether the last one is the
        goal.

        """
        reach = self.lengths[self.index] + 2.0 * max(grid.size_x_m, grid.size_y_m)
        end = max(int(np.searchsorted(self.lengths, reach, 'right')), self.index + 1)
        part = transform_poses(self.poses[slice(self.index, end)], frame)
        u, v = part[:, 0] - grid.origin_x, part[:, 1] - grid.origin_y
        inside = (u >= 0.0) & (u < grid.size_x_m) & (v >= 0.0) & (v < grid.size_y_m)
        if not inside.all():
            part = part[: max(int(np.argmin(inside)), 1)]
        return part, self.index + len(part) == len(self.poses)
