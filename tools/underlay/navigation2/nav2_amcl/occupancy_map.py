# SPDX-License-Identifier: Apache-2.0
"""Occupancy grid map for localisation: its cells, their distances to obstacles, and rays."""

from __future__ import annotations

from functools import cached_property
import math

import cv2
import numpy as np
import numpy.typing as npt

__all__ = ['FREE', 'OCCUPIED', 'UNKNOWN', 'FloatArray', 'OccupancyMap', 'RayCaster']

FloatArray = npt.NDArray[np.float64]
SingleArray = npt.NDArray[np.float32]
CellArray = npt.NDArray[np.int8]

FREE, OCCUPIED, UNKNOWN = 0, 100, -1
_OCCUPIED_FROM, _FREE_TO = 65, 25

_CLEARANCE = 0.75
"""The maximum error in cells of a cell's obstacle distance, for points within the cell."""

_MIN_STEP = 0.5
_MAX_STEPS = 2000


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


class RayCaster:
    """
    Ray caster in a map, up to the first occupied cell.

    A ray advances by the distance to the nearest obstacle from the distance transform (sphere
    tracing: J. C. Hart, The Visual Computer 12, 1996), and by half a cell near obstacles. It
    passes through unknown cells, and ends without a hit where the map ends.

    Parameters
    ----------
    grid
        The map.

    """

    def __init__(self, grid: OccupancyMap) -> None:
        self._grid = grid
        self._rows, self._columns = grid.cells.shape
        # A border of one cell, in which rays that leave the map are found.
        steps = np.full((self._rows + 2, self._columns + 2), -2.0, np.float32)
        inner = grid.distances / np.float32(grid.resolution)
        largest = np.float32(np.hypot(self._rows, self._columns))
        inside = np.clip(np.minimum(inner, largest) - _CLEARANCE, _MIN_STEP, None)
        steps[1:-1, 1:-1] = np.where(inner == 0.0, np.float32(-1.0), inside)
        self._steps = steps.ravel()
        self._width = self._columns + 2

    def cast(self, origins: FloatArray, angles: FloatArray, max_range: float) -> FloatArray:
        """
        Compute the distances at which rays hit an obstacle.

        Parameters
        ----------
        origins
            (..., 2) array of x and y in the frame of the map, in m.
        angles
            (...) array of directions in the frame of the map, in rad; the two are broadcast.
        max_range
            The maximum range, in m.

        Returns
        -------
        (...) array of distances in m; inf where nothing is hit.

        """
        shape = np.broadcast_shapes(origins.shape[:-1], angles.shape)
        start = self._grid.to_grid(np.asarray(origins, float)).astype(np.float32)
        turned = (angles - self._grid.origin[2]).astype(np.float32)
        x = np.broadcast_to(start[..., 0], shape).ravel() + np.float32(1.0)
        y = np.broadcast_to(start[..., 1], shape).ravel() + np.float32(1.0)
        dx = np.broadcast_to(np.cos(turned), shape).ravel()
        dy = np.broadcast_to(np.sin(turned), shape).ravel()
        found = self._march(x, y, dx, dy, max_range / self._grid.resolution)
        return (found * self._grid.resolution).reshape(shape)

    def _march(
        self,
        x: npt.NDArray[np.float32],
        y: npt.NDArray[np.float32],
        dx: npt.NDArray[np.float32],
        dy: npt.NDArray[np.float32],
        limit: float,
    ) -> FloatArray:
        """March the rays; return distances in cells. x and y count from the border's corner."""
        found = np.full(len(x), np.inf)
        length = np.zeros(len(x), np.float32)
        active = np.arange(len(x))
        for _ in range(_MAX_STEPS):
            column = np.clip(x, 0, self._columns + 1).astype(np.int32)
            row = np.clip(y, 0, self._rows + 1).astype(np.int32)
            step = self._steps[row * np.int32(self._width) + column]
            hit = step == -1.0
            found[active[hit]] = length[hit]
            goes_on = (step > 0.0) & (length < limit)
            if not goes_on.all():
                active, x, y = active[goes_on], x[goes_on], y[goes_on]
                dx, dy, length, step = dx[goes_on], dy[goes_on], length[goes_on], step[goes_on]
            if not len(active):
                break
            length = length + step
            x, y = x + dx * step, y + dy * step
        found[found > limit] = np.inf
        return found
