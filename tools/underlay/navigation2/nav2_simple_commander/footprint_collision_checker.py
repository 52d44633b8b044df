# SPDX-License-Identifier: Apache-2.0
"""Collision checker for the robot's footprint in a costmap."""

# ruff: noqa: N802
from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Point32, Polygon
from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.line_iterator import LineIterator

__all__ = [
    'FREE_SPACE',
    'INSCRIBED_INFLATED_OBSTACLE',
    'LETHAL_OBSTACLE',
    'MAX_NON_OBSTACLE',
    'NO_INFORMATION',
    'FootprintCollisionChecker',
]

NO_INFORMATION = 255
LETHAL_OBSTACLE = 254
INSCRIBED_INFLATED_OBSTACLE = 253
MAX_NON_OBSTACLE = 252
FREE_SPACE = 0


class FootprintCollisionChecker:
    """Checker that finds the maximum cost on the outline of a footprint; set a costmap first."""

    def __init__(self) -> None:
        self.costmap_: PyCostmap2D | None = None

    def setCostmap(self, costmap: PyCostmap2D) -> None:
        """
        Set the costmap in which costs are looked up.

        Parameters
        ----------
        costmap
            A costmap with costs from 0 to 255.

        """
        self.costmap_ = costmap

    def footprintCostAtPose(self, x: float, y: float, theta: float, footprint: Polygon) -> Any:
        """
        Compute the maximum cost on the outline of a footprint at a pose.

        Parameters
        ----------
        x, y, theta
            The pose in m and rad, in the frame of the costmap.
        footprint
            The corners of the footprint in the robot's frame.

        """
        cos, sin = math.cos(theta), math.sin(theta)
        moved = Polygon()
        for corner in footprint.points:
            moved.points.append(
                Point32(
                    x=x + corner.x * cos - corner.y * sin, y=y + corner.x * sin + corner.y * cos
                )
            )
        return self.footprintCost(moved)

    def footprintCost(self, footprint: Polygon) -> Any:
        """
        Find the maximum cost on the outline of a footprint.

        Parameters
        ----------
        footprint
            The corners of the footprint in m, in the frame of the costmap.

        Returns
        -------
        float
            The cost; LETHAL_OBSTACLE where a corner is outside of the costmap.

        Raises
        ------
        ValueError
            No costmap was set.

        """
        cells = [self.worldToMapValidated(corner.x, corner.y) for corner in footprint.points]
        if any(cell[0] is None for cell in cells):
            return float(LETHAL_OBSTACLE)
        cost = 0.0
        for (x0, y0), (x1, y1) in zip(cells, cells[1:] + cells[:1]):
            cost = max(float(self.lineCost(x0, x1, y0, y1)), cost)
            if cost == LETHAL_OBSTACLE:
                break
        return cost

    def lineCost(self, x0: Any, x1: Any, y0: Any, y1: Any, step_size: float = 0.5) -> Any:
        """
        Find the maximum cost on a line between two cells.

        The search ends at the first cell of LETHAL_OBSTACLE; NO_INFORMATION before it is higher.

        Parameters
        ----------
        x0, x1, y0, y1
            The columns of both cells, then their rows.
        step_size
            The step between points of the line, as for `LineIterator`.

        Returns
        -------
        float
            The cost.

        Raises
        ------
        ValueError
            No costmap was set.

        """
        cost = 0.0
        line = LineIterator(x0, y0, x1, y1, step_size)
        while line.isValid():
            cost = max(float(self.pointCost(int(line.getX()), int(line.getY()))), cost)
            if cost == LETHAL_OBSTACLE:
                break
            line.advance()
        return cost

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:
        """
        Find the cell at a position.

        Parameters
        ----------
        wx, wy
            x and y in m, in the frame of the costmap.

        Returns
        -------
        tuple
            Column and row; (None, None) outside of the costmap.

        Raises
        ------
        ValueError
            No costmap was set.

        """
        return self._costmap().worldToMapValidated(wx, wy)

    def pointCost(self, x: int, y: int) -> Any:
        """
        Look up the cost of a cell by its column and row.

        Parameters
        ----------
        x, y
            Column and row.

        Raises
        ------
        ValueError
            No costmap was set.

        """
        return self._costmap().getCostXY(x, y)

    def _costmap(self) -> PyCostmap2D:
        if self.costmap_ is None:
            raise ValueError('There is no costmap. Give one to setCostmap first.')
        return self.costmap_
