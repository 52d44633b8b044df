# SPDX-License-Identifier: Apache-2.0
"""Check whether a robot can still follow a path."""

from __future__ import annotations

from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_util.geometry import Pose2D
import numpy as np
import numpy.typing as npt

__all__ = ['invalid_poses']


def invalid_poses(
    costmap: Costmap2D,
    poses: npt.NDArray[np.float64],
    footprint: npt.NDArray[np.float64] | None,
    robot: Pose2D | None,
) -> npt.NDArray[np.intp]:
    """
    Find the poses of a path at which the robot is in collision.

    Parameters
    ----------
    costmap
        The costmap. Unknown space is free; space beyond the grid is an obstacle.
    poses
        (N, 3) x and y in m, yaw in rad.
    footprint
        (M, 2) corners of the robot in m; None for a circular one, of which the centre is checked.
    robot
        The pose of the robot: poses before the nearest one are behind it, and are ignored.

    Returns
    -------
    The indices of poses.

    """
    first = 0
    if robot is not None and len(poses):
        first = int(np.argmin(np.hypot(poses[:, 0] - robot.x, poses[:, 1] - robot.y)))
    costs = FootprintCollisionChecker(costmap).footprint_costs(poses[first:], footprint)
    limit = INSCRIBED_INFLATED_OBSTACLE if footprint is None else LETHAL_OBSTACLE
    return np.flatnonzero((costs >= limit) & (costs != NO_INFORMATION)) + first
