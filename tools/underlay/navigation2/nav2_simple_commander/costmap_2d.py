# SPDX-License-Identifier: Apache-2.0
"""A costmap for lookups from Python."""

# ruff: noqa: N802
from __future__ import annotations

import math
from typing import Any

import numpy as np

__all__ = ['PyCostmap2D']


class PyCostmap2D:
    """
    Costmap, as returned by `BasicNavigator.getGlobalCostmap`.

    Parameters
    ----------
    occupancy_map
        A `nav_msgs/OccupancyGrid` or a `nav2_msgs/Costmap`.

    """

    def __init__(self, occupancy_map: Any) -> None:
        info = getattr(occupancy_map, 'info', None)
        if info is None:
            info = occupancy_map.metadata
            self.size_x, self.size_y = info.size_x, info.size_y
            self.costmap_timestamp = info.update_time
        else:
            self.size_x, self.size_y = info.width, info.height
            self.costmap_timestamp = info.map_load_time
        self.resolution = info.resolution
        self.origin_x = info.origin.position.x
        self.origin_y = info.origin.position.y
        self.global_frame_id = occupancy_map.header.frame_id
        self.costmap = np.asarray(occupancy_map.data).astype(np.uint8)

    def getSizeInCellsX(self) -> int:
        """Return the number of cells along x."""
        return int(self.size_x)

    def getSizeInCellsY(self) -> int:
        """Return the number of cells along y."""
        return int(self.size_y)

    def getSizeInMetersX(self) -> float:
        """Return the extent along x in m, from the origin to the centre of the last cell."""
        return float((self.size_x - 1 + 0.5) * self.resolution)

    def getSizeInMetersY(self) -> float:
        """Return the extent along y in m, from the origin to the centre of the last cell."""
        return float((self.size_y - 1 + 0.5) * self.resolution)

    def getOriginX(self) -> float:
        """Return the x coordinate of the origin in m."""
        return float(self.origin_x)

    def getOriginY(self) -> float:
        """Return the y coordinate of the origin in m."""
        return float(self.origin_y)

    def getResolution(self) -> float:
        """Return the side length of a cell in m."""
        return float(self.resolution)

    def getGlobalFrameID(self) -> str:
        """Return the name of the frame."""
        return str(self.global_frame_id)

    def getCostmapTimestamp(self) -> Any:
        """Return the stamp of the costmap."""
        return self.costmap_timestamp

    def getCostXY(self, mx: int, my: int) -> Any:
        """
        Look up the value of a cell by its column and row.

        Parameters
        ----------
        mx, my
            Column (along x) and row (along y).

        Returns
        -------
        numpy.uint8
            The cost from 0 to 255 of a `Costmap`, or the occupancy of an `OccupancyGrid`, where
            255 is unknown.

        """
        return np.uint8(self.costmap[self.getIndex(mx, my)])

    def getCostIdx(self, index: int) -> Any:
        """
        Look up the value of a cell by its index.

        Parameters
        ----------
        index
            The index, as from `getIndex`.

        Returns
        -------
        numpy.uint8
            As of `getCostXY`.

        """
        return np.uint8(self.costmap[index])

    def setCost(self, mx: int, my: int, cost: int) -> None:
        """
        Set the value of a cell in this copy of the costmap.

        Parameters
        ----------
        mx, my
            Column (along x) and row (along y).
        cost
            The cost, from 0 to 255.

        """
        self.costmap[self.getIndex(mx, my)] = np.uint8(cost)

    def mapToWorld(self, mx: int, my: int) -> tuple[float, float]:
        """
        Convert a cell to the position of its centre.

        Parameters
        ----------
        mx, my
            Column (along x) and row (along y).

        Returns
        -------
        tuple of float
            x and y in m, in the frame of the costmap.

        """
        return (
            self.origin_x + (mx + 0.5) * self.resolution,
            self.origin_y + (my + 0.5) * self.resolution,
        )

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

        """
        mx = math.floor((wx - self.origin_x) / self.resolution)
        my = math.floor((wy - self.origin_y) / self.resolution)
        if 0 <= mx < self.size_x and 0 <= my < self.size_y:
            return mx, my
        return None, None

    worldToMap = worldToMapValidated  # noqa: N815

    def getIndex(self, mx: int, my: int) -> int:
        """
        Compute the index of a cell in the row-major data.

        Parameters
        ----------
        mx, my
            Column (along x) and row (along y).

        """
        return int(my * self.size_x + mx)
