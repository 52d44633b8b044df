# SPDX-License-Identifier: Apache-2.0
"""Ray casting in a map: many rays at once, by sphere tracing."""

from __future__ import annotations

from nav2_amcl.occupancy_map import FloatArray, OccupancyMap
import numpy as np
import numpy.typing as npt

__all__ = ['RayCaster']

_CLEARANCE = 0.75
"""The maximum error in cells of a cell's obstacle distance, for points within the cell."""

_MIN_STEP = 0.5
_MAX_STEPS = 2000


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
