# SPDX-License-Identifier: Apache-2.0
"""Occupancy grid map for localisation: its cells, and their distances to obstacles."""

from __future__ import annotations

from functools import cached_property
import math

import cv2
import numpy as np
import numpy.typing as npt

__all__ = ['FREE', 'OCCUPIED', 'UNKNOWN', 'FloatArray', 'OccupancyMap']

FloatArray = npt.NDArray[np.float64]
SingleArray = npt.NDArray[np.float32]
CellArray = npt.NDArray[np.int8]

FREE, OCCUPIED, UNKNOWN = 0, 100, -1
_OCCUPIED_FROM, _FREE_TO = 65, 25


class OccupancyMap:
    """
    Occupancy grid map of free, occupied and unknown cells.

    Parameters
    ----------
    occupancy
        (rows, columns) array of the values of a `nav_msgs/OccupancyGrid`: probabilities from 0 to
        100 that a cell is occupied, -1 for unknown. Row 0 is at the origin, rows go along y.
    resolution
        The side length of a cell in m.
    origin
        x, y (m) and yaw (rad) of the outer corner of cell [0, 0] in the frame of the map.

    """

    def __init__(
        self,
        occupancy: npt.NDArray[np.int8],
        resolution: float,
        origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        self.cells: CellArray = np.full(occupancy.shape, UNKNOWN, np.int8)
        """The same array with FREE, OCCUPIED and UNKNOWN only."""
        self.cells[(occupancy >= 0) & (occupancy <= _FREE_TO)] = FREE
        self.cells[occupancy >= _OCCUPIED_FROM] = OCCUPIED
        self.resolution = float(resolution)
        self.origin = origin
        self._cos, self._sin = math.cos(origin[2]), math.sin(origin[2])

    def to_grid(self, points: npt.NDArray[np.floating]) -> npt.NDArray[np.floating]:
        """
        Convert points in the frame of the map to fractional columns and rows.

        Parameters
        ----------
        points
            (..., 2) array of x and y in m.

        Returns
        -------
        (..., 2) array of column and row; the centre of cell [0, 0] is at 0.5, 0.5.

        """
        scale = 1.0 / self.resolution
        rotation = scale * np.array([[self._cos, -self._sin], [self._sin, self._cos]])
        offset = -np.array(self.origin[:2]) @ rotation
        grid: npt.NDArray[np.floating] = points @ rotation.astype(points.dtype)
        grid += offset.astype(points.dtype)
        return grid

    def to_map(self, grid: FloatArray) -> FloatArray:
        """
        Convert columns and rows to points in the frame of the map, as the inverse of `to_grid`.

        Parameters
        ----------
        grid
            Columns and rows (..., 2), with fractions; the centre of cell [0, 0] is at 0.5, 0.5.

        Returns
        -------
        numpy.ndarray
            Points (..., 2): x and y in m.

        """
        rotation = self.resolution * np.array([[self._cos, self._sin], [-self._sin, self._cos]])
        points: FloatArray = grid @ rotation + np.array(self.origin[:2])
        return points

    @cached_property
    def distances(self) -> SingleArray:
        """Compute the distance in m of each cell to the nearest occupied cell; inf without any."""
        if not (self.cells == OCCUPIED).any():
            return np.full(self.cells.shape, np.inf, np.float32)
        free = (self.cells != OCCUPIED).astype(np.uint8)
        pixels = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        distances: SingleArray = np.asarray(pixels, np.float32) * np.float32(self.resolution)
        return distances

    @cached_property
    def free_cells(self) -> npt.NDArray[np.intp]:
        """(N, 2) array of the columns and rows of all free cells."""
        return np.argwhere(self.cells == FREE)[:, ::-1]

    def sample_free_poses(
        self, count: int, random: np.random.Generator, every: int = 1
    ) -> FloatArray:
        """
        Draw poses uniformly from the free space.

        Parameters
        ----------
        count
            The number of poses.
        random
            The random number generator.
        every
            Draw only from every n-th free cell.

        Returns
        -------
        (count, 3) array of x, y (m) and yaw (rad). Without a free cell, from all cells.

        """
        cells = self.free_cells[::every]
        if not len(cells):
            cells = np.argwhere(self.cells != OCCUPIED)[:, ::-1]
        if not len(cells):
            cells = np.argwhere(self.cells == OCCUPIED)[:, ::-1]
        chosen = cells[random.integers(len(cells), size=count)]
        poses = np.empty((count, 3))
        poses[:, :2] = self.to_map(chosen + random.random((count, 2)))
        poses[:, 2] = random.uniform(-math.pi, math.pi, count)
        return poses
