# SPDX-License-Identifier: Apache-2.0
"""Search options and results: a route, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    MAX_NON_OBSTACLE,
    NO_INFORMATION,
)
from nav2_planner.grid_graph import FloatGrid
from nav2_util.errors import NavigationError
import numpy as np
import numpy.typing as npt

__all__ = ['PlanningError', 'Route', 'SearchOptions', 'weight_table']

FloatArray = npt.NDArray[np.float64]


class PlanningError(NavigationError):
    """
    There is no path.

    Parameters
    ----------
    reason
        The name of the error code in the actions' results, such as `NO_VALID_PATH`.
    message
        The error message, a full sentence.

    """

    def __init__(self, reason: str, message: str) -> None:
        super().__init__(message)
        self.reason = reason


def weight_table(
    traversal: float, *, neutral: float = 1.0, power: float = 1.0, allow_unknown: bool = True
) -> npt.NDArray[np.float32]:
    """
    Compute the (256,) weights of costs: neutral + traversal (cost / 252) ^ power.

    Parameters
    ----------
    traversal
        The additional cost of a metre in a cell of the maximum cost, compared to free space.
    neutral
        The cost of a metre in free space.
    power
        The exponent; above 1 the weight rises late and steeply.
    allow_unknown
        Whether unknown cells may be passed. They have the weight of cells of the maximum cost, so
        that known paths are preferred.

    """
    shares = np.arange(256) / MAX_NON_OBSTACLE
    # A search needs a positive cost for each step.
    table = np.maximum(neutral + traversal * shares**power, 1e-3).astype(np.float32)
    table[INSCRIBED_INFLATED_OBSTACLE:] = np.inf
    if allow_unknown:
        table[NO_INFORMATION] = table[MAX_NON_OBSTACLE]
    return table


@dataclass(frozen=True)
class SearchOptions:
    """
    Options of a search.

    Attributes
    ----------
    table
        (256,) weights of costs, as of `weight_table`.
    tolerance_m
        The distance from an unreachable goal at which a path may end.
    factor
        The downsampling factor along each axis; cells are pooled by their maximum weight.
    max_cells
        The maximum number of cells to expand; 0 for no limit.
    max_time_s
        The maximum time; 0 for no limit.

    """

    table: npt.NDArray[np.float32]
    tolerance_m: float
    factor: int = 1
    max_cells: int = 0
    max_time_s: float = 0.0


@dataclass(frozen=True)
class Route:
    """
    Route: a path of straight lines in its grid.

    Attributes
    ----------
    corners
        (N, 2) rows and columns; the centres of cells are integers.
    weights
        (rows, columns) weights of the cells.
    cost
        Length in m times weights, of the cheapest path from cell to cell.
    cell_m
        The side of a cell in m.
    origin
        x and y of the outer corner of cell (0, 0) in m.
    is_exact
        Whether it ends at the goal itself.

    """

    corners: FloatArray
    weights: FloatGrid
    cost: float
    cell_m: float
    origin: tuple[float, float]
    is_exact: bool

    def to_world(self, points: FloatArray) -> FloatArray:
        """
        Convert rows and columns to positions in the frame of the costmap.

        Parameters
        ----------
        points
            (N, 2) rows and columns of the grid; the centres of cells are integers.

        Returns
        -------
        FloatArray
            (N, 2) x and y in m.

        """
        return np.array(self.origin) + (points[:, ::-1] + 0.5) * self.cell_m
