# SPDX-License-Identifier: Apache-2.0
"""Search for the cheapest path to a goal, cached while the goal and the costs are unchanged."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, field
import math

import cv2
from nav2_planner.corridor import block_graph, BlockGraph, corridor
from nav2_planner.grid_graph import (
    Cell,
    cost_to_go,
    CostToGo,
    FloatGrid,
    MaskGrid,
    way_cost,
)
import numpy as np
import numpy.typing as npt

__all__ = ['GridSearch', 'SearchGrid']

_EXACT_CELLS = 200_000
_CORRIDOR_CELLS = 200_000
_BLOCK_SIDE = 10
# For a near goal, paths up to this factor longer than a straight line are searched for first.
_DETOUR = 1.6
_DETOUR_CELLS = 40.0
_NEAR_SHARE = 0.3
_ROUNDING = 1e-6


@dataclass
class SearchGrid:
    """
    Weights of cells, and quantities derived from them on demand.

    Parameters
    ----------
    weights
        (rows, columns) cost of a cell's length in a cell; infinite: blocked.

    """

    weights: FloatGrid
    _free: MaskGrid | None = None
    _least: float | None = None
    _regions: npt.NDArray[np.int32] | None = None
    _masks: dict[int, MaskGrid] = field(default_factory=dict)
    _blocks: BlockGraph | None = None

    @property
    def free(self) -> MaskGrid:
        """(rows, columns) cells that a path may pass."""
        if self._free is None:
            self._free = np.isfinite(self.weights)
        return self._free

    @property
    def least(self) -> float:
        """Return the minimum weight."""
        if self._least is None:
            self._least = float(self.weights.min())
        return self._least

    @property
    def regions(self) -> npt.NDArray[np.int32]:
        """(rows, columns) labels of 4-connected regions, 0 where not free."""
        if self._regions is None:
            _, regions = cv2.connectedComponents(
                self.free.view(np.uint8), connectivity=4, ltype=cv2.CV_32S
            )
            self._regions = np.asarray(regions, np.int32)
        return self._regions

    @property
    def blocks(self) -> BlockGraph:
        """Return the coarse graph of all free cells."""
        if self._blocks is None:
            self._blocks = block_graph(self.weights, self.free, _BLOCK_SIDE)
        return self._blocks

    def region_of(self, cell: Cell) -> MaskGrid:
        """
        Find the cells connected to a free cell.

        Parameters
        ----------
        cell
            Row and column of a free cell.

        Returns
        -------
        MaskGrid
            (rows, columns) mask, which is cached: do not modify it.

        """
        number = int(self.regions[cell])
        if number not in self._masks:
            self._masks[number] = self.regions == number
        return self._masks[number]

    def nearest(self, cell: Cell, among: MaskGrid, radius: float) -> Cell | None:
        """
        Find the cell of a mask that is nearest to another one.

        Parameters
        ----------
        cell
            Row and column.
        among
            (rows, columns) mask.
        radius
            The maximum distance of the centres in cells.

        Returns
        -------
        The cell, or None if there is none within that distance. Of several equally near ones, the
        cheapest.

        """
        reach = int(min(radius, max(among.shape))) + 1
        row, column = max(cell[0] - reach, 0), max(cell[1] - reach, 0)
        window = slice(row, cell[0] + reach + 1), slice(column, cell[1] + reach + 1)
        found = np.argwhere(among[window])
        if not len(found):
            return None
        found += (row, column)
        apart = np.hypot(*(found - np.array(cell)).T)
        rank = np.round(apart, 6) + 1e-9 * np.minimum(self.weights[found[:, 0], found[:, 1]], 1e3)
        best = int(np.argmin(rank))
        if apart[best] > radius + 1e-9:
            return None
        return int(found[best, 0]), int(found[best, 1])


class GridSearch:
    """
    Search for cheapest paths in grids: exact up to 200 000 connected cells, else in a corridor.

    For a near goal, only an ellipse around start and goal is searched first. A path found there is
    the cheapest if it is so short that none that leaves the ellipse can be shorter. When only the
    costs have changed, the search is limited to cells no farther from the goal than the previous
    path.

    Parameters
    ----------
    diagonal
        Whether to allow diagonal steps.

    """

    def __init__(self, diagonal: bool = True) -> None:
        self.diagonal = diagonal
        self._grid: SearchGrid | None = None
        self._kept: _Kept | None = None

    def grid_of(self, weights: FloatGrid) -> SearchGrid:
        """
        Prepare a grid of weights for `way`.

        Parameters
        ----------
        weights
            (rows, columns) cost of a cell's length in a cell; infinite: blocked.

        Returns
        -------
        SearchGrid
            The grid; that of the last call with its cached quantities if the weights are the same.

        """
        if self._grid is None or not np.array_equal(self._grid.weights, weights):
            if self._grid is not None and self._grid.weights.shape != weights.shape:
                self._kept = None
            self._grid = SearchGrid(weights)
        return self._grid

    def way(self, grid: SearchGrid, start: Cell, goal: Cell) -> Generator[None, None, CostToGo]:
        """
        Search a cost-to-go field that contains the path from the start, in several steps.

        Parameters
        ----------
        grid
            A grid of `grid_of`.
        start, goal
            Free cells of one region.

        """
        kept = self._kept if grid is self._grid else None
        if kept is not None and kept.grid is grid and kept.serves(start, goal):
            return kept.field
        limit = math.inf if kept is None else kept.cost_in(grid, start, goal)
        region = grid.region_of(goal)
        cells = int(np.count_nonzero(region))
        yield
        length = _DETOUR * math.dist(start, goal) + _DETOUR_CELLS
        bound = grid.least * length
        found: CostToGo | None = None
        if _area(math.dist(start, goal), length) < _NEAR_SHARE * min(cells, _EXACT_CELLS):
            near = _ellipse(region, start, goal, length)
            found = cost_to_go(grid.weights, near, goal, diagonal=self.diagonal)
        if found is None or found.cost_from(start) > bound:
            mask, bound = region, math.inf
            if cells > _EXACT_CELLS:
                blocks = grid.blocks
                yield
                mask = corridor(blocks, start, goal, _CORRIDOR_CELLS)
            yield
            limit *= 1.0 + _ROUNDING
            found = cost_to_go(grid.weights, mask, goal, diagonal=self.diagonal, limit=limit)
            if math.isinf(found.cost_from(start)):
                # The previous path is not in the corridor.
                found = cost_to_go(grid.weights, mask, goal, diagonal=self.diagonal)
        if grid is self._grid:
            self._kept = _Kept(found, grid, start, bound)
        return found


@dataclass(frozen=True)
class _Kept:
    """Cached cost-to-go field and its search area: no path below the bound leaves it."""

    field: CostToGo
    grid: SearchGrid
    start: Cell
    bound: float

    def serves(self, start: Cell, goal: Cell) -> bool:
        """Whether the field contains the cheapest path from another start."""
        cost = self.field.cost_from(start)
        if self.field.goal != goal or math.isinf(cost):
            return False
        return cost + self.grid.least * math.dist(self.start, start) <= self.bound

    def cost_in(self, grid: SearchGrid, start: Cell, goal: Cell) -> float:
        """Compute the cost of the cached path in another grid; infinite if there is none."""
        if self.field.goal != goal or math.isinf(self.field.cost_from(start)):
            return math.inf
        return way_cost(grid.weights, self.field.path_from(start))


def _area(apart: float, length: float) -> float:
    """Compute the area in cells of an ellipse from its focal distance and its path length."""
    return 0.25 * math.pi * length * math.sqrt(max(length**2 - apart**2, 0.0))


def _ellipse(region: MaskGrid, start: Cell, goal: Cell, length: float) -> MaskGrid:
    """Find the cells of a region on paths from start to goal up to a maximum length."""
    room = 0.5 * (length - math.dist(start, goal))
    row, column = (max(int(min(ends) - room), 0) for ends in zip(start, goal))
    down, right = (int(max(ends) + room) + 2 for ends in zip(start, goal))
    window = slice(row, down), slice(column, right)
    inside = region[window]
    rows = np.arange(row, row + inside.shape[0], dtype=np.float32)[:, None]
    columns = np.arange(column, column + inside.shape[1], dtype=np.float32)
    ways = sum(np.hypot(rows - end[0], columns - end[1]) for end in (start, goal))
    mask = np.zeros_like(region)
    mask[window] = inside & (ways <= length)
    return mask
