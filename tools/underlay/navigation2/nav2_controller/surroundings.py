# SPDX-License-Identifier: Apache-2.0
"""Collision checks of a robot footprint in a costmap, for many poses at once."""

from __future__ import annotations

from functools import cached_property

import cv2
from nav2_costmap_2d.costs import INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
import numpy as np
import numpy.typing as npt

__all__ = ['Surroundings']

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


class Surroundings:
    """
    Collision checker with the costmap around a robot, and its footprint.

    Parameters
    ----------
    grid
        The costmap, in the frame of the poses to check.
    footprint
        (N, 2) corners in m in the base frame; empty for a circular robot, of which the centre is
        checked.
    inscribed_radius_m
        The radius of a circular robot, or the inscribed radius of the footprint.

    """

    def __init__(self, grid: Costmap2D, footprint: FloatArray, inscribed_radius_m: float) -> None:
        self.grid, self.footprint = grid, footprint
        self.inscribed_radius_m = inscribed_radius_m
        self._checker = FootprintCollisionChecker(grid)

    @property
    def is_circular(self) -> bool:
        """Whether only the cost at the centre of the robot is checked."""
        return not len(self.footprint)

    @cached_property
    def clearance(self) -> npt.NDArray[np.float32]:
        """Distance in m from each cell to the nearest obstacle cell, in the shape of the grid."""
        free = (self.grid.cells != LETHAL_OBSTACLE).astype(np.uint8)
        if free.all():
            return np.full(free.shape, 1e3, np.float32)
        found = cv2.distanceTransform(free, cv2.DIST_L2, 5)
        return np.asarray(found * np.float32(self.grid.resolution), np.float32)

    def collisions(self, poses: FloatArray) -> BoolArray:
        """
        Find the poses at which the robot is in collision; off the costmap it never is.

        Parameters
        ----------
        poses
            (M, 3) array of x, y (m) and yaw (rad).

        Returns
        -------
        (M,) array.

        """
        poses = np.asarray(poses, float).reshape(-1, 3)
        costs = self.grid.costs_at(poses[:, :2], outside=NO_INFORMATION)
        hits: BoolArray = np.equal(costs, LETHAL_OBSTACLE)
        if self.is_circular:
            hits |= costs == INSCRIBED_INFLATED_OBSTACLE
        else:
            hits |= self._outline_collisions(poses, ~hits)
        return hits

    def _outline_collisions(self, poses: FloatArray, asked: BoolArray) -> BoolArray:
        """Check the outlines at poses close enough to an obstacle for a collision."""
        reach = float(np.hypot(*self.footprint.T).max()) + 1.5 * self.grid.resolution
        cells = self.grid.world_to_map_array(poses[:, :2])
        size = np.array([self.grid.size_x, self.grid.size_y])
        # The outline of a robot whose centre is off the costmap may reach into it.
        inside = ((cells >= 0) & (cells < size)).all(axis=1)
        clear = np.zeros(len(poses), bool)
        columns, rows = cells[inside].T
        clear[inside] = self.clearance[rows, columns] > reach
        found = np.zeros(len(poses), bool)
        near = np.flatnonzero(asked & ~clear & inside)
        if len(near):
            costs = self._checker.footprint_costs(poses[near], self.footprint)
            off = self._leaves_grid(poses[near])
            found[near] = (costs == LETHAL_OBSTACLE) & ~off
            for index in near[off]:
                found[index] = self._touches_inside(poses[index])
        return found

    def _leaves_grid(self, poses: FloatArray) -> BoolArray:
        reach = float(np.hypot(*self.footprint.T).max())
        low = np.array([self.grid.origin_x, self.grid.origin_y]) + reach
        high = low + (self.grid.size_x_m - 2 * reach, self.grid.size_y_m - 2 * reach)
        beyond: BoolArray = (poses[:, :2] < low) | (poses[:, :2] > high)
        return beyond[:, 0] | beyond[:, 1]

    def _touches_inside(self, pose: FloatArray) -> bool:
        cos, sin = np.cos(pose[2]), np.sin(pose[2])
        points = self.footprint @ np.array([[cos, sin], [-sin, cos]]) + pose[:2]
        ends = np.roll(points, -1, axis=0)
        parts = np.linspace(0.0, 1.0, 12)[:, None, None]
        outline = (points + parts * (ends - points)).reshape(-1, 2)
        return bool((self.grid.costs_at(outline, outside=NO_INFORMATION) == LETHAL_OBSTACLE).any())
