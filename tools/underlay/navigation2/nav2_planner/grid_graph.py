# SPDX-License-Identifier: Apache-2.0
"""Compute the cost from every cell to the goal: Dijkstra's search on a part of a grid."""

from __future__ import annotations

from dataclasses import dataclass
import functools
import math
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

__all__ = ['Cell', 'CostToGo', 'FloatGrid', 'MaskGrid', 'cost_to_go', 'shortest_paths', 'way_cost']

FloatGrid = npt.NDArray[np.float32]
MaskGrid = npt.NDArray[np.bool_]
Cell = tuple[int, int]
"""Row (y) and column (x)."""

# The neighbours of a cell: rows down, columns right, and the two straight neighbours between
# which a diagonal step passes, as indices into this list.
_STEPS = (
    (-1, 0, None),
    (1, 0, None),
    (0, -1, None),
    (0, 1, None),
    (-1, -1, (0, 2)),
    (-1, 1, (0, 3)),
    (1, -1, (1, 2)),
    (1, 1, (1, 3)),
)
_BEYOND = 1e30
# Above this fraction, the whole window is searched: its other cells do no harm.
_DENSE_SHARE = 0.3
_INFINITE: dict[str, Any] = {'constant_values': np.inf}


@dataclass(frozen=True)
class CostToGo:
    """
    Cost-to-go: the cost of the cheapest path to a goal, from each cell of a part of a grid.

    Attributes
    ----------
    goal
        The cell of the goal.
    ids
        (h, w) index of each cell of a window of the grid in `costs`, -1 where it has none.
    origin
        The cell of the grid at which the window starts.
    places
        (N,) flat index of each cell in the window with a border of one cell.
    costs
        (N,) costs to the goal in cells, infinite if unreachable.
    successors
        (N,) index of the next cell on the path to the goal, negative at the goal.

    """

    goal: Cell
    ids: npt.NDArray[np.int32]
    origin: Cell
    places: npt.NDArray[np.intp]
    costs: npt.NDArray[np.float64]
    successors: npt.NDArray[np.int32]

    def index_of(self, cell: Cell) -> int:
        """
        Look up the index of a cell.

        Parameters
        ----------
        cell
            Row and column in the grid.

        Returns
        -------
        int
            The index in `costs`; -1 if the cell is not in the part that was searched.

        """
        row, column = cell[0] - self.origin[0], cell[1] - self.origin[1]
        rows, columns = self.ids.shape
        if not (0 <= row < rows and 0 <= column < columns):
            return -1
        return int(self.ids[row, column])

    def cost_from(self, cell: Cell) -> float:
        """
        Look up the cost of the cheapest path from a cell to the goal.

        Parameters
        ----------
        cell
            Row and column in the grid.

        Returns
        -------
        float
            The cost in cells times weights; infinite if no path is known.

        """
        index = self.index_of(cell)
        return math.inf if index < 0 else float(self.costs[index])

    def path_from(self, cell: Cell) -> npt.NDArray[np.int32]:
        """
        Follow the cheapest path from a cell to the goal.

        Parameters
        ----------
        cell
            Row and column in the grid, of finite cost; otherwise the result is not a path.

        Returns
        -------
        numpy.ndarray
            (M, 2) rows and columns from the cell to the goal, both inclusive.

        """
        index, way = self.index_of(cell), []
        while index >= 0:
            way.append(index)
            index = int(self.successors[index])
        row, column = np.divmod(self.places[way], self.ids.shape[1] + 2)
        cells = np.column_stack([row, column]) + (np.array(self.origin) - 1)
        way_cells: npt.NDArray[np.int32] = cells.astype(np.int32)
        return way_cells


def cost_to_go(
    weights: FloatGrid,
    mask: MaskGrid,
    goal: Cell,
    *,
    diagonal: bool = True,
    limit: float = math.inf,
) -> CostToGo:
    """
    Search for the cheapest paths to a goal from all cells of a mask.

    A step costs its length times the mean weight of its two cells. A diagonal step is taken only
    where both cells beside it are free, so that no path cuts the corner of an obstacle, and cells
    are connected exactly if they are 4-connected.

    Parameters
    ----------
    weights
        (rows, columns) cost of a metre in a cell relative to free space; infinite: blocked.
    mask
        (rows, columns) cells in which to search, all of finite weight; the goal among them.
    goal
        Row and column.
    diagonal
        Whether to take diagonal steps (8 neighbours), or only straight ones (4).
    limit
        The maximum cost of paths to search for.

    Notes
    -----
    Dijkstra, "A note on two problems in connexion with graphs", 1959; scipy's implementation.

    """
    window, origin = _bounds(mask)
    inside = mask[window]
    if np.count_nonzero(inside) > _DENSE_SHARE * inside.size:
        framed = np.pad(np.where(inside, weights[window], np.float32(np.inf)), 1, **_INFINITE)
        ids, places, neighbours, starts = _lattice(*inside.shape, diagonal)
        lengths = _dense_lengths(framed, diagonal)
    else:
        ids, places, lengths, neighbours, starts = _sparse_edges(weights[window], inside, diagonal)
    source = int(ids[goal[0] - origin[0], goal[1] - origin[1]])
    costs, successors = shortest_paths(lengths, neighbours, starts, source, limit)
    return CostToGo(goal, ids, origin, places, costs, successors)


def way_cost(weights: FloatGrid, way: npt.NDArray[np.int32]) -> float:
    """
    Compute the cost of a path from cell to cell, as in `cost_to_go`.

    Parameters
    ----------
    weights
        As for `cost_to_go`.
    way
        (N, 2) rows and columns, each a neighbour of the next.

    Returns
    -------
    float
        The cost in cells times weights; infinite if the path passes a cell of infinite weight, or
        cuts its corner.

    """
    begin, end = way[:-1], way[1:]
    passed = [
        weights[begin[:, 0], begin[:, 1]],
        weights[end[:, 0], end[:, 1]],
        weights[begin[:, 0], end[:, 1]],
        weights[end[:, 0], begin[:, 1]],
    ]
    lengths = np.hypot(*(end - begin).T)
    is_blocked = bool(np.isinf(passed).any())
    return math.inf if is_blocked else float(lengths @ (passed[0] + passed[1])) * 0.5


@functools.lru_cache(maxsize=4)
def _lattice(rows: int, columns: int, diagonal: bool) -> tuple[Any, Any, Any, Any]:
    """Make the indices of all cells of a window, with the other arrays of `CostToGo` and edges."""
    width = columns + 2
    count = (rows + 2) * width
    ids = np.arange(count, dtype=np.int32)
    steps = _STEPS if diagonal else _STEPS[:4]
    shifts = np.array([down * width + right for down, right, _ in steps], np.int32)
    # The border has no edges; its references are never used.
    neighbours = np.clip(ids[:, None] + shifts, 0, count - 1).ravel()
    starts = np.arange(0, count * len(steps) + 1, len(steps), dtype=np.int32)
    return ids.reshape(rows + 2, width)[1:-1, 1:-1], ids, neighbours, starts


def _dense_lengths(framed: FloatGrid, diagonal: bool) -> npt.NDArray[np.float64]:
    """Compute the lengths of the steps from all cells of a window with a blocked border."""
    halves = framed.astype(np.float64) * 0.5
    lengths = np.full((*framed.shape, 8 if diagonal else 4), np.inf)
    inner = lengths[1:-1, 1:-1]
    down = halves[:-1] + halves[1:]
    right = halves[:, :-1] + halves[:, 1:]
    inner[..., 0], inner[..., 1] = down[:-1, 1:-1], down[1:, 1:-1]
    inner[..., 2], inner[..., 3] = right[1:-1, :-1], right[1:-1, 1:]
    if diagonal:
        # A diagonal step needs all four cells at the corner to be free.
        closed = np.where(down[:, :-1] + down[:, 1:] < np.inf, 0.0, np.inf)
        halves *= math.sqrt(2.0)
        falling = halves[:-1, :-1] + halves[1:, 1:] + closed
        rising = halves[:-1, 1:] + halves[1:, :-1] + closed
        inner[..., 4], inner[..., 5] = falling[:-1, :-1], rising[:-1, 1:]
        inner[..., 6], inner[..., 7] = rising[1:, :-1], falling[1:, 1:]
    return lengths.ravel()


def _sparse_edges(
    weights: FloatGrid, inside: MaskGrid, diagonal: bool
) -> tuple[Any, Any, Any, Any, Any]:
    """Compute the indices of the cells of a mask, their places, and the steps between them."""
    rows, columns = inside.shape
    # A border of one cell allows for neighbour lookups without bounds checks.
    width = columns + 2
    places = np.flatnonzero(inside)
    places += 2 * (places // columns) + width + 1
    count = len(places)
    ids = np.full((rows + 2) * width, -1, np.int32)
    ids[places] = np.arange(count, dtype=np.int32)
    framed = np.full(ids.shape, np.inf, np.float32)
    framed[places] = weights[inside]

    steps = _STEPS if diagonal else _STEPS[:4]
    neighbours = np.empty((len(steps), count), np.int32)
    lengths = np.empty((len(steps), count), np.float32)
    own = framed[places]
    for k, (down, right, between) in enumerate(steps):
        there = places + (down * width + right)
        np.take(ids, there, out=neighbours[k], mode='clip')
        np.take(framed, there, out=lengths[k], mode='clip')
        lengths[k] += own
        lengths[k] *= 0.5 if between is None else 0.5 * math.sqrt(2.0)
        if between is not None:
            first, second = between
            lengths[k][(neighbours[first] < 0) | (neighbours[second] < 0)] = np.inf
    np.maximum(neighbours, 0, out=neighbours)
    starts = np.arange(0, count * len(steps) + 1, len(steps), dtype=np.int32)
    window_ids = ids.reshape(rows + 2, width)[1:-1, 1:-1]
    in_rows = lengths.T.astype(np.float64, order='C').ravel()
    return window_ids, places, in_rows, neighbours.T.ravel(), starts


def shortest_paths(
    lengths: npt.NDArray[np.float64],
    neighbours: npt.NDArray[np.int32],
    starts: npt.NDArray[np.int32],
    source: int,
    limit: float = math.inf,
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]:
    """
    Compute the costs from a node to all nodes, and their predecessors.

    Parameters
    ----------
    lengths, neighbours, starts
        The edges as compressed sparse rows; infinite lengths mean no edge.
    source
        The index of the node.
    limit
        The maximum cost; nodes beyond it keep an infinite cost.

    """
    count = len(starts) - 1
    graph = csr_array((lengths, neighbours, starts), shape=(count, count))
    costs, before = dijkstra(
        graph, indices=source, return_predecessors=True, limit=min(limit, _BEYOND)
    )
    return costs, before


def _bounds(mask: MaskGrid) -> tuple[tuple[slice, slice], Cell]:
    """Find the bounding window of a mask, and its origin."""
    rows = np.flatnonzero(mask.any(axis=1))
    columns = np.flatnonzero(mask.any(axis=0))
    window = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    return window, (int(rows[0]), int(columns[0]))
