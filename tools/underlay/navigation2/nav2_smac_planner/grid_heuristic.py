# SPDX-License-Identifier: Apache-2.0
"""Costs to the goal for a robot that moves in any direction: never more than those of a car."""

from __future__ import annotations

import math

from nav2_planner.grid_graph import cost_to_go, FloatGrid
import numpy as np
import numpy.typing as npt

__all__ = ['GridHeuristic']

FloatArray = npt.NDArray[np.float64]
_MOST_CELLS = 100_000
_BEYOND = 1e29


class GridHeuristic:
    """
    Costs from places to a goal, on a grid of at most about a hundred thousand cells.

    Parameters
    ----------
    weights
        (rows, columns) weights of cells.
    goal
        x and y of the goal in cells.
    tolerance_m
        The distance from the goal in which a free cell replaces it.
    cell_m
        The size of a cell.

    Attributes
    ----------
    has_goal
        Whether there is a free cell within the tolerance.

    """

    def __init__(
        self, weights: FloatGrid, goal: tuple[float, float], tolerance_m: float, cell_m: float
    ) -> None:
        factor = math.ceil(math.sqrt(weights.size / _MOST_CELLS))
        grid = _pooled(weights, factor)
        free = np.isfinite(grid)
        cell = int(goal[1]) // factor, int(goal[0]) // factor
        near = _nearest_free(free, cell, tolerance_m / cell_m / factor)
        self.has_goal = near is not None
        costs: FloatArray = np.full(grid.shape, np.inf)
        if near is not None:
            found = cost_to_go(grid, free, near)
            reached = found.costs < _BEYOND
            width = found.ids.shape[1] + 2
            row, column = np.divmod(found.places[reached], width)
            row, column = row + found.origin[0] - 1, column + found.origin[1] - 1
            costs[row, column] = found.costs[reached] * factor * cell_m
        self._costs: memoryview[float] = memoryview(costs.ravel())  # type: ignore[arg-type]
        self._factor, self._width = factor, grid.shape[1]

    def estimate(self, x: float, y: float) -> float:
        """
        Return the least cost from a place to the goal, in m times weights.

        Parameters
        ----------
        x, y
            The place in cells.

        """
        place = int(y) // self._factor * self._width + int(x) // self._factor
        remaining: float = self._costs[place]
        return remaining


def _pooled(grid: FloatGrid, factor: int) -> FloatGrid:
    """Downsample cells by the minimum of their weights, so that no way is closed."""
    if factor <= 1:
        return grid
    rows, columns = (-(-size // factor) for size in grid.shape)
    padded = np.full((rows * factor, columns * factor), np.inf, np.float32)
    padded[: grid.shape[0], : grid.shape[1]] = grid
    pooled: FloatGrid = padded.reshape(rows, factor, columns, factor).min(axis=(1, 3))
    return pooled


def _nearest_free(
    free: npt.NDArray[np.bool_], cell: tuple[int, int], radius: float
) -> tuple[int, int] | None:
    """Return the free cell that is nearest to another one, within a radius in cells."""
    places = np.argwhere(free)
    if not len(places):
        return None
    apart = np.hypot(*(places - np.array(cell)).T)
    best = int(np.argmin(apart))
    if apart[best] > max(radius, 0.5):
        return None
    return int(places[best, 0]), int(places[best, 1])
