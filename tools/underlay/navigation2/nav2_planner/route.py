# SPDX-License-Identifier: Apache-2.0
"""What a search is asked for, and what it answers: a route, or why there is none."""

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
        Why, as a sentence.

    """

    def __init__(self, reason: str, message: str) -> None:
        super().__init__(message)
        self.reason = reason


def weight_table(
    traversal: float, *, neutral: float = 1.0, power: float = 1.0, allow_unknown: bool = True
) -> npt.NDArray[np.float32]:
    """
    Return the (256,) weights of the costs of cells: neutral + traversal (cost / 252) ^ power.

    Parameters
    ----------
    traversal
        How much more a metre costs in a cell of the highest cost than in free space.
    neutral
        What a metre costs in free space.
    power
        Above 1 the weight rises late and steeply.
    allow_unknown
        Whether cells without information may be passed. They count as cells of the highest cost,
        so that known ways are preferred.

    """
    shares = np.arange(256) / MAX_NON_OBSTACLE
    # A search needs a price on each step.
    table = np.maximum(neutral + traversal * shares**power, 1e-3).astype(np.float32)
    table[INSCRIBED_INFLATED_OBSTACLE:] = np.inf
    if allow_unknown:
        table[NO_INFORMATION] = table[MAX_NON_OBSTACLE]
    return table


@dataclass(frozen=True)
class SearchOptions:
    """
    What a planner wants of a search.

    Attributes
    ----------
    table
        (256,) weights of costs, as of `weight_table`.
    tolerance_m
        How far from a goal that cannot be reached a path may end.
    factor
        How many cells become one along each axis, at the highest weight.
    max_cells
        Give up when more cells than that are to be expanded; 0 for no limit.
    max_time_s
        Give up after this time; 0 for no limit.

    """

    table: npt.NDArray[np.float32]
    tolerance_m: float
    factor: int = 1
    max_cells: int = 0
    max_time_s: float = 0.0


@dataclass(frozen=True)
class Route:
    """
    A path of straight lines, in the grid that it was planned in.

    Attributes
    ----------
    corners
        (N, 2) rows and columns; the centres of cells are whole numbers.
    weights
        (rows, columns) weights of the cells.
    cost
        Length in m times weights, of the cheapest way from cell to cell.
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
            (N, 2) rows and columns of the grid; the centres of cells are whole numbers.

        Returns
        -------
        FloatArray
            (N, 2) x and y in m.

        """
        return np.array(self.origin) + (points[:, ::-1] + 0.5) * self.cell_m
