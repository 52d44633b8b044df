# SPDX-License-Identifier: Apache-2.0
"""A grid of costs, and the conversion between cells and positions."""

from __future__ import annotations

import math
from typing import TypeVar

from nav2_costmap_2d.costs import FREE_SPACE, LETHAL_OBSTACLE
import numpy as np
import numpy.typing as npt

__all__ = ['CellArray', 'Costmap2D', 'FloatArray', 'shift_cells']

CellArray = npt.NDArray[np.uint8]
FloatArray = npt.NDArray[np.float64]
ScalarT = TypeVar('ScalarT', np.uint8, np.float64)


def shift_cells(
    cells: npt.NDArray[ScalarT], dx: int, dy: int, default: float
) -> npt.NDArray[ScalarT]:
    """
    Shift the cells of a grid after its origin has moved.

    Parameters
    ----------
    cells
        (rows, columns) values of the cells.
    dx, dy
        The motion of the origin in cells.
    default
        The value of cells that were outside.

    """
    moved = np.full_like(cells, default)
    rows, columns = cells.shape
    if abs(dx) < columns and abs(dy) < rows:
        into = slice(max(-dy, 0), rows - max(dy, 0)), slice(max(-dx, 0), columns - max(dx, 0))
        kept = slice(max(dy, 0), rows + min(dy, 0)), slice(max(dx, 0), columns + min(dx, 0))
        moved[into] = cells[kept]
    return moved


class Costmap2D:
    """
    Costmap: a grid of square cells, aligned with the axes of a frame.

    Parameters
    ----------
    size_x, size_y
        The number of columns (along x) and rows (along y).
    resolution
        The side of a cell in m.
    origin_x, origin_y
        The outer corner of cell [0, 0] in m.
    default_cost
        The initial cost of all cells.
    cells
        The costs, instead of `default_cost`: shape (size_y, size_x), not copied.

    """

    def __init__(
        self,
        size_x: int,
        size_y: int,
        resolution: float,
        origin_x: float,
        origin_y: float,
        default_cost: int = FREE_SPACE,
        cells: CellArray | None = None,
    ) -> None:
        self.resolution = float(resolution)
        self.origin_x, self.origin_y = float(origin_x), float(origin_y)
        if cells is None:
            cells = np.full((size_y, size_x), default_cost, dtype=np.uint8)
        elif cells.shape != (size_y, size_x):
            raise ValueError(f'{size_x} x {size_y} cells cannot be of shape {cells.shape}.')
        self.cells: CellArray = cells
        """The costs: row 0 is at `origin_y`, column 0 at `origin_x`."""

    @property
    def size_x(self) -> int:
        """Return the number of columns."""
        return int(self.cells.shape[1])

    @property
    def size_y(self) -> int:
        """Return the number of rows."""
        return int(self.cells.shape[0])

    @property
    def size_x_m(self) -> float:
        """Return the extent along x in m."""
        return self.size_x * self.resolution

    @property
    def size_y_m(self) -> float:
        """Return the extent along y in m."""
        return self.size_y * self.resolution

    def copy(self) -> Costmap2D:
        """Copy the grid, so that its costs can be modified."""
        return self.with_cells(self.cells.copy())

    def with_cells(self, cells: CellArray) -> Costmap2D:
        """
        Make a grid with the same size and origin, and other costs.

        Parameters
        ----------
        cells
            The costs (size_y, size_x), which are not copied.

        """
        return Costmap2D(
            self.size_x, self.size_y, self.resolution, self.origin_x, self.origin_y, cells=cells
        )

    def world_to_map(self, x: float, y: float) -> tuple[int, int] | None:
        """
        Convert a point to the cell that contains it.

        Parameters
        ----------
        x, y
            The point in m.

        Returns
        -------
        tuple of int or None
            Column and row; None outside of the grid.

        """
        u, v = (x - self.origin_x) / self.resolution, (y - self.origin_y) / self.resolution
        if 0.0 <= u < self.size_x and 0.0 <= v < self.size_y:
            return int(u), int(v)
        return None

    def map_to_world(self, mx: int, my: int) -> tuple[float, float]:
        """
        Convert a cell to its centre.

        Parameters
        ----------
        mx, my
            Column and row, also beyond the grid.

        Returns
        -------
        tuple of float
            x and y in m.

        """
        return (
            self.origin_x + (mx + 0.5) * self.resolution,
            self.origin_y + (my + 0.5) * self.resolution,
        )

    def world_to_map_array(self, xy: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """
        Convert points to the cells that contain them.

        Parameters
        ----------
        xy
            (..., 2) array of finite x and y in m.

        Returns
        -------
        (..., 2) array of columns and rows, also beyond the grid: negative, or `size_x` and more.

        """
        origin = (self.origin_x, self.origin_y)
        return np.floor((np.asarray(xy, float) - origin) / self.resolution).astype(np.int64)

    def map_to_world_array(self, cells: npt.ArrayLike) -> FloatArray:
        """
        Convert cells to their centres.

        Parameters
        ----------
        cells
            Columns and rows (..., 2), also beyond the grid.

        Returns
        -------
        numpy.ndarray
            Points (..., 2): x and y in m.

        """
        origin = (self.origin_x, self.origin_y)
        return (np.asarray(cells, float) + 0.5) * self.resolution + origin

    def cost_at(self, x: float, y: float) -> int:
        """
        Look up the cost at a point; LETHAL_OBSTACLE outside.

        Parameters
        ----------
        x, y
            The point in m.

        """
        cell = self.world_to_map(x, y)
        return LETHAL_OBSTACLE if cell is None else int(self.cells[cell[1], cell[0]])

    def costs_at(self, xy: npt.ArrayLike, outside: int = LETHAL_OBSTACLE) -> CellArray:
        """
        Look up the costs at points.

        Parameters
        ----------
        xy
            (..., 2) array of x and y in m.
        outside
            The cost of points outside of the grid.

        Returns
        -------
        (...) array of costs.

        """
        points = np.asarray(xy, float)
        u = (points[..., 0] - self.origin_x) * (1.0 / self.resolution)
        v = (points[..., 1] - self.origin_y) * (1.0 / self.resolution)
        inside = (u >= 0.0) & (u < self.size_x) & (v >= 0.0) & (v < self.size_y)
        is_all = bool(inside.all())
        if not is_all:
            u, v = np.where(inside, u, 0.0), np.where(inside, v, 0.0)
        found: CellArray = self.cells.take(v.astype(np.intp) * self.size_x + u.astype(np.intp))
        return found if is_all else np.where(inside, found, np.uint8(outside))

    def snapped(self, x: float, y: float) -> tuple[int, int]:
        """
        Compute the shift of the origin towards a point, in whole cells.

        Parameters
        ----------
        x, y
            The desired origin in m.

        Returns
        -------
        tuple of int
            Cells along x and y, rounded down.

        """
        return (
            math.floor((x - self.origin_x) / self.resolution),
            math.floor((y - self.origin_y) / self.resolution),
        )

    def shifted(self, dx: int, dy: int, default_cost: int) -> Costmap2D:
        """
        Make a grid of the same size shifted by whole cells, preserving the costs of the overlap.

        Parameters
        ----------
        dx, dy
            The motion of the origin in cells.
        default_cost
            The cost of cells that were outside.

        """
        moved = shift_cells(self.cells, dx, dy, default_cost)
        return Costmap2D(
            self.size_x,
            self.size_y,
            self.resolution,
            self.origin_x + dx * self.resolution,
            self.origin_y + dy * self.resolution,
            cells=moved,
        )
