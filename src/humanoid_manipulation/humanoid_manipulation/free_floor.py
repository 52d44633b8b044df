# SPDX-License-Identifier: Apache-2.0
"""Free space on the floor: the distance to obstacles, and the paths that they leave open."""

from __future__ import annotations

from collections.abc import Iterable
import math

from humanoid_description.robot import Array
from nav_msgs.msg import OccupancyGrid
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, label

__all__ = ['NAVIGABLE_M', 'FreeFloor']

NAVIGABLE_M = 0.33
"""Smallest distance from mapped obstacles to which navigation goes."""
_WIDE_M = 0.42
"""Distance from obstacles from which the robot walks well: a passage as wide as a door."""
_BESIDE_M = 0.8
"""How far a robot that stands at furniture may be from a wide region of the floor."""
_OCCUPIED = 50
"""Map cells with at least this probability (percent) count as occupied."""
_STEP_M = 0.05

Point = tuple[float, float]


class FreeFloor:
    """
    The free space on the floor, outside mapped obstacles and what stands on it.

    Parameters
    ----------
    grid
        The map, with an unrotated origin; without cells, the floor is free everywhere.
    standing
        Further obstacles on the floor, such as people: x, y and radius of each, in m.

    """

    def __init__(
        self, grid: OccupancyGrid, standing: Iterable[tuple[float, float, float]]
    ) -> None:
        info = grid.info
        self._resolution_m = float(info.resolution)
        self._origin_m = np.array([info.origin.position.x, info.origin.position.y])
        cells = np.asarray(grid.data, dtype=np.int8).reshape(info.height, info.width)
        free = (cells >= 0) & (cells < _OCCUPIED)
        rows, columns = np.indices(free.shape)
        xs = self._origin_m[0] + (columns + 0.5) * self._resolution_m
        ys = self._origin_m[1] + (rows + 0.5) * self._resolution_m
        for x_m, y_m, radius_m in standing:
            free &= np.hypot(xs - x_m, ys - y_m) > radius_m
        self._is_mapped = free.size > 0
        if not self._is_mapped:
            return
        self._room_m: Array = self._resolution_m * distance_transform_edt(free)
        self._regions = _regions(self._room_m >= _WIDE_M, _BESIDE_M / self._resolution_m)

    def room_m(self, at_m: Point) -> float:
        """
        Compute the distance of a point from the nearest obstacle on the floor.

        Parameters
        ----------
        at_m
            x and y of the point, in the frame of the map.

        Returns
        -------
        float
            The distance in m from mapped and standing obstacles; infinite without a map, and zero
            in unknown cells and outside the map.

        """
        if not self._is_mapped:
            return math.inf
        row, column = self._cell(at_m)
        rows, columns = self._room_m.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return float(self._room_m[row, column]) if inside else 0.0

    def is_clear_way(self, begin_m: Point, end_m: Point) -> bool:
        """
        Check whether the straight line between two points is clear for stepping at any heading.

        Parameters
        ----------
        begin_m, end_m
            The start and the end of the line: x and y in m.

        """
        count = max(1, math.ceil(math.dist(begin_m, end_m) / _STEP_M))
        return all(
            self.room_m(
                (
                    begin_m[0] + share * (end_m[0] - begin_m[0]),
                    begin_m[1] + share * (end_m[1] - begin_m[1]),
                )
            )
            >= NAVIGABLE_M
            for share in np.linspace(0.0, 1.0, count + 1).tolist()
        )

    def is_wide_way(self, begin_m: Point, end_m: Point) -> bool:
        """
        Check whether a path of any length that is wide throughout connects two points.

        A point in a narrow place, such as in front of furniture, counts as in the nearest wide
        region within 0.8 m.

        Parameters
        ----------
        begin_m, end_m
            The start and the end of the path: x and y in m.

        """
        if not self._is_mapped:
            return True
        begin, end = self._region(begin_m), self._region(end_m)
        return 0 < begin == end

    def _region(self, at_m: Point) -> int:
        """Return the label of the wide region at or near a point; 0 if none is near."""
        row, column = self._cell(at_m)
        rows, columns = self._regions.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return int(self._regions[row, column]) if inside else 0

    def _cell(self, at_m: Point) -> tuple[int, int]:
        """Return the row and the column of the grid cell of a point."""
        column, row = np.floor((np.array(at_m) - self._origin_m) / self._resolution_m).tolist()
        return int(row), int(column)


def _regions(wide: NDArray[np.bool_], reach: float) -> Array:
    """Label each cell with its connected wide region, or the nearest one within reach."""
    numbers, count = label(wide)
    if not count:
        return np.asarray(numbers)
    away, nearest = distance_transform_edt(~wide, return_indices=True)
    return np.where(away <= reach, numbers[tuple(nearest)], 0)
